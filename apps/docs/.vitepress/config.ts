import { existsSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig, type MarkdownEnv } from 'vitepress';
import { basisModule } from '../../../tools/pipeline/basis-module.mjs';
import { publishedModules } from '../../../tools/pipeline/published-source.mjs';
import { weslModules } from '../../../tools/pipeline/wesl.mjs';
import { apiReference } from './api';
import { emptyHeaders } from './empty-headers';
import { foldTables } from './fold-tables';
import { buildGalleryModels } from './gallery-models';
import { packageFacts, packageLine } from './package-facts';
import { buildPlayground } from './playground';
import { readmeLinks } from './readme-links';
import { sourceWorkers } from './source-workers';

// VitePress expands what data loaders watch from the working directory. Below apps/docs the patterns begin with `../..`,
// which its `**/node_modules/**` does not match, and it would scan each node_modules of the repository, links included.
process.chdir(fileURLToPath(new URL('../../..', import.meta.url)));

const packages = [
  'viewer',
  'element',
  'react',
  'three',
  'renderer',
  'gltf',
  'formats',
  'cad',
  'scene',
  'openpbr',
  'bvh',
  'tonemap',
  'denoise',
  'image',
  'denoise-weights',
  'wgsl',
  'farm',
  'cli',
  'create-glanz',
];
const api = await apiReference(packages);
/** Pages that benchmarks and tests fill: shown once there is something on them. */
const results = [
  ['Results', '/results/'],
  ['Speed and memory', '/results/speed'],
  ['Truth', '/results/truth'],
  ['Reliability', '/results/reliability'],
  ['Error at equal time', '/results/equal-time'],
  ['Products', '/results/products'],
  ['Hierarchies', '/results/bvh'],
  ['OpenPBR', '/results/openpbr'],
  ['Loading', '/results/loading'],
  ['Test models', '/results/assets'],
]
  .map(([text, link]) => ({ text: text as string, link: link as string }))
  .filter(({ link }) => existsSync(new URL(`..${link.endsWith('/') ? `${link}index` : link}.md`, import.meta.url)));

/**
 * Words of a text or a query for the search: also those with a dot as one, so that "nextjs" finds "Next.js". It is sent
 * to the browser as text, and so uses nothing from outside.
 */
const searchWords = (text: string): string[] => {
  const dotted = text.match(/[\p{L}\p{N}]+(?:\.[\p{L}\p{N}]+)+/gu) ?? [];
  return [...text.split(/[\n\r\p{Z}\p{P}]+/u), ...dotted.map((word) => word.replaceAll('.', ''))];
};

interface Markdown {
  readonly options: { highlight?: ((code: string, language: string, attributes: string) => string) | null | undefined };
  render(text: string, env: MarkdownEnv): string;
}

/** A page for the index of the search, which reads no colours: to highlight code took a seventh of the build. */
const renderForSearch = (text: string, env: MarkdownEnv, md: Markdown): string => {
  const { options } = md;
  const { highlight } = options;
  options.highlight = null;
  try {
    const html = md.render(text, env);
    return env.frontmatter?.['search'] === false ? '' : html;
  } finally {
    options.highlight = highlight;
  }
};

/** A page of its own, not one of VitePress's: links to it load it. `npm run docs` has it not; `npm start` does. */
const PLAYGROUND = '/playground/index.html';

export default defineConfig({
  title: 'Glanz',
  description: 'A physically based path tracer for the web: glTF in, OpenPBR materials, WebGPU, photoreal image out.',
  lang: 'en',
  cleanUrls: true,
  lastUpdated: false,
  srcExclude: ['**/README.md'],
  head: [
    ['link', { rel: 'icon', href: '/mark.svg', type: 'image/svg+xml' }],
    ['meta', { name: 'theme-color', content: '#e2631e' }],
  ],
  markdown: {
    // As the API reference writes its links: underscores stay.
    anchor: {
      slugify: (text) =>
        text
          .trim()
          .toLowerCase()
          .replace(/[^\p{L}\p{N}\s_-]+/gu, '')
          .replace(/\s+/g, '-'),
    },
    config: (md) => void md.use(readmeLinks).use(packageLine).use(emptyHeaders).use(foldTables),
    // The usual ones have comments and keywords too faint for the ground of code blocks.
    theme: { light: 'github-light-high-contrast', dark: 'github-dark-high-contrast' },
  },
  buildEnd: async ({ outDir }) => {
    await buildPlayground(join(outDir, 'playground'));
    await buildGalleryModels(join(outDir, 'images/models'));
  },
  // The theme's home page has no main landmark; its other pages have.
  transformHtml: (html) => html.replace(/(<div class="VPContent is-home"[^>]*)>/, '$1 role="main">'),
  vite: {
    // Examples and demos run from the packages' sources; the pages need no build of them.
    resolve: { conditions: ['@glanz/source'] },
    ssr: { noExternal: [/^@glanz\//], resolve: { conditions: ['@glanz/source'] } },
    plugins: [weslModules(), publishedModules(), basisModule()],
    worker: {
      format: 'es',
      plugins: () => [sourceWorkers(), weslModules(), publishedModules(), basisModule()],
    },
    build: { target: 'es2022', chunkSizeWarningLimit: 700 },
    server: { fs: { allow: [dirname(fileURLToPath(new URL('../../..', import.meta.url)))] } },
  },
  themeConfig: {
    logo: '/mark.svg',
    // Packages have versions of their own, on their pages; most pages come here for the viewer.
    siteTitle: `Glanz <small class="site-version" title="Version of @glanz/viewer">${packageFacts('viewer').version}</small>`,
    search: {
      provider: 'local',
      options: { detailedView: true, miniSearch: { options: { tokenize: searchWords } }, _render: renderForSearch },
    },
    outline: [2, 3],
    nav: [
      { text: 'Start', link: '/guide/getting-started' },
      { text: 'Gallery', link: '/gallery' },
      { text: 'Live', link: '/live' },
      { text: 'OpenPBR', link: '/openpbr/parameters', activeMatch: '^/openpbr/' },
      { text: 'Packages', link: '/packages/', activeMatch: '^/packages/' },
      { text: 'API', link: '/api/', activeMatch: '^/api/' },
      { text: 'How it works', link: '/how/', activeMatch: '^/how/' },
      { text: 'Results', link: '/results/', activeMatch: '^/results/' },
    ],
    sidebar: [
      {
        text: 'Start',
        items: [
          { text: 'Getting started', link: '/guide/getting-started' },
          { text: 'Gallery', link: '/gallery' },
          { text: 'A live image', link: '/live' },
          { text: 'Playground', link: PLAYGROUND, target: '_self' },
          { text: 'Where it stands', link: '/guide/status' },
          { text: 'Release 0.1.0', link: '/releases/0.1.0' },
          { text: 'Conventions', link: '/guide/conventions' },
          { text: 'Names and units', link: '/guide/names' },
          { text: 'Render options', link: '/guide/options' },
        ],
      },
      {
        text: 'Guides',
        items: [
          { text: 'A viewer on a page', link: '/guide/viewer' },
          { text: 'The element', link: '/guide/element' },
          { text: 'React', link: '/guide/react' },
          { text: 'three.js', link: '/guide/three' },
          { text: 'Coming from three-gpu-pathtracer', link: '/guide/three-gpu-pathtracer' },
          { text: 'Beside other viewers', link: '/guide/viewers' },
          { text: 'Coming from model-viewer', link: '/guide/from-model-viewer' },
          { text: 'Coming from Cycles', link: '/guide/from-cycles' },
          { text: 'Loading glTF', link: '/guide/gltf' },
          { text: 'Cameras and framing', link: '/guide/cameras' },
          { text: 'Environment and lights', link: '/guide/lighting' },
          { text: 'Materials', link: '/guide/materials' },
          { text: 'Tone mapping', link: '/guide/tone-mapping' },
          { text: 'Feature layers', link: '/guide/layers' },
          { text: 'Progress, abort, lost devices', link: '/guide/progressive' },
          { text: 'Node and GPUs', link: '/guide/node' },
          { text: 'Command line', link: '/guide/command-line' },
          { text: 'CAD to web', link: '/guide/cad' },
          { text: 'Errors', link: '/guide/errors' },
          { text: 'All configurations of a product', link: '/guide/configurations' },
          { text: 'A product shot', link: '/guide/product-shot' },
          { text: 'A configurator', link: '/guide/configurator' },
          { text: 'Performance', link: '/guide/performance' },
          { text: 'Denoising', link: '/guide/denoising' },
          { text: 'Video', link: '/guide/video' },
          { text: 'Browsers and GPUs', link: '/guide/browsers' },
          { text: 'Troubleshooting', link: '/guide/troubleshooting' },
          { text: 'Questions', link: '/guide/faq' },
        ],
      },
      {
        text: 'OpenPBR',
        items: [
          { text: 'All parameters', link: '/openpbr/parameters' },
          ...[
            'Base',
            'Specular',
            'Transmission',
            'Subsurface',
            'Coat',
            'Fuzz',
            'Thin film',
            'Emission',
            'Geometry',
          ].map((text) => ({ text, link: `/openpbr/${text.toLowerCase().replace(' ', '-')}` })),
          { text: 'Lobes and their sources', link: '/openpbr/lobes' },
          { text: 'Presets', link: '/openpbr/presets' },
          { text: 'From glTF', link: '/openpbr/gltf' },
          { text: 'MaterialX', link: '/openpbr/materialx' },
          { text: 'Versions', link: '/openpbr/versions' },
          { text: 'In a rasteriser', link: '/openpbr/rasteriser' },
        ],
      },
      {
        text: 'Packages',
        link: '/packages/',
        items: packages.map((folder) => ({ text: packageFacts(folder).name, link: `/packages/${folder}` })),
      },
      { text: 'API reference', link: '/api/', collapsed: true, items: api },
      {
        text: 'How it works',
        items: [
          { text: 'From scene to image', link: '/how/' },
          { text: 'Hierarchies, seen', link: '/how/hierarchies' },
          { text: 'Light and chance', link: '/how/light' },
          { text: 'How it is tested', link: '/how/tested' },
          { text: 'The paper', link: '/how/paper' },
        ],
      },
      { text: 'Results', link: '/results/', items: results },
    ],
    footer: { message: 'MIT licensed.' },
  },
});
