import { build } from 'vite';
import { glanzPackage } from '../../tsup.base';

/** `glanz serve` brings the playground along. */
async function bundlePlayground(): Promise<void> {
  await build({
    root: '../../apps/playground',
    configFile: '../../apps/playground/vite.config.ts',
    logLevel: 'warn',
    build: { outDir: '../../packages/cli/dist/playground', emptyOutDir: true },
  });
}

export default {
  ...glanzPackage(
    { index: 'src/index.ts', glanz: 'src/glanz.ts', 'png-worker': 'src/output/png-worker.ts' },
    { platform: 'node' },
  ),
  onSuccess: bundlePlayground,
};
