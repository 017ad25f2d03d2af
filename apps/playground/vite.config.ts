import { defineConfig } from 'vite';
import { basisModule } from '../../tools/pipeline/basis-module.mjs';
import { publishedModules } from '../../tools/pipeline/published-source.mjs';
import { weslModules } from '../../tools/pipeline/wesl.mjs';

/** Where a browser window can open: not on servers, not in automated runs. */
const hasScreen =
  !process.env['CI'] && (process.platform !== 'linux' || !!(process.env['DISPLAY'] ?? process.env['WAYLAND_DISPLAY']));

// The workspace's packages are read from their sources (condition "@glanz/source"): the playground needs no build of
// them.
export default defineConfig({
  root: import.meta.dirname,
  base: './',
  resolve: { conditions: ['@glanz/source', 'module', 'browser', 'import', 'default'] },
  server: { port: 5173, open: hasScreen },
  preview: { port: 4173 },
  // Found here rather than when a model is first opened, which would reload the page while it is used.
  optimizeDeps: {
    include: [
      '@glanz/image > fflate',
      'meshoptimizer/decoder',
      '@glanz/element > draco3dgltf/draco_decoder_gltf_nodejs.js',
    ],
  },
  build: {
    target: 'es2022',
    chunkSizeWarningLimit: 900,
    rolldownOptions: {
      input: ['index.html', 'configurator.html'].map((page) => `${import.meta.dirname}/${page}`),
      output: {
        // What the denoiser shares with the renderer is one file, not four.
        codeSplitting: {
          groups: [
            {
              name: 'shared',
              test: /packages\/(wgsl\/src\/(?!error)|viewer\/src\/visibility|scene\/src\/until-aborted)/,
            },
            // What the first image needs of the page and its panels, links and recordings too: one file, not fifteen.
            {
              name: 'page',
              test: /packages\/viewer\/src\/orbit|apps\/playground\/src\/(viewer\/(camera-rig|placement|assigned-material|compose|effects|lens)|output\/layers|state\/(state|limits|store)|selection)/,
            },
          ],
        },
      },
    },
  },
  plugins: [weslModules(), publishedModules(), basisModule()],
  worker: { format: 'es', plugins: () => [weslModules(), publishedModules(), basisModule()] },
});
