import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { createPushButton } from '@glanz/models';
import { sceneToGlb } from '@glanz/models/gltf';
import { photograph } from '@glanz/browser';
import { WebIO } from '@gltf-transform/core';
import { KHRDracoMeshCompression, KHRONOS_EXTENSIONS } from '@gltf-transform/extensions';
import { expect, test, type Page } from '@playwright/test';
import draco from 'draco3dgltf';
import { requested, sees } from './sees';
import { commandsFrom, fileFrom, installedBy, linesOf, Project, quickStart } from './project';

test.setTimeout(600_000);
test.use({ viewport: { width: 480, height: 320 } });

let project: Project;
test.afterEach(() => project?.stop());

const VITE = { typescript: '~6.0.3', vite: '^8.3.8' };
const TSCONFIG = JSON.stringify({
  compilerOptions: {
    target: 'ES2022',
    lib: ['ES2022', 'DOM', 'DOM.Iterable'],
    module: 'ESNext',
    moduleResolution: 'bundler',
    types: ['vite/client'],
    strict: true,
    skipLibCheck: true,
    noEmit: true,
    jsx: 'react-jsx',
    allowImportingTsExtensions: true,
    noUncheckedSideEffectImports: true,
  },
  include: ['src'],
});
const page = (body: string) =>
  `<!doctype html>\n<html lang="en"><head><meta charset="utf-8" /><link rel="icon" href="data:," /><title>newcomer</title></head><body style="margin: 0">${body}</body></html>\n`;

const model = async () => new Uint8Array(await sceneToGlb(createPushButton({ level: 'low' })));

/** The same model as an exporter compresses it: what shows it has found the decoder's chunk. */
const compressed = async () => {
  const io = new WebIO().registerExtensions(KHRONOS_EXTENSIONS).registerDependencies({
    'draco3d.encoder': await draco.createEncoderModule(),
    'draco3d.decoder': await draco.createDecoderModule(),
  });
  const document = await io.readBinary(await model());
  document.createExtension(KHRDracoMeshCompression).setRequired(true);
  return io.writeBinary(document);
};

/** Leaves a page, so that it asks for nothing more, and stops its server. */
async function leave(browser: Page): Promise<void> {
  await browser.goto('about:blank');
  project.stop();
}

function report(name: string, lines: number, seconds: Record<string, number>): void {
  const parts = [
    ...Object.entries(project.timings).map(([what, ms]) => [what, ms / 1000] as const),
    ...Object.entries(seconds),
  ].map(([what, value]) => `${what} ${value.toFixed(1)} s`);
  console.log(`${name}: ${lines} lines; ${parts.join(', ')}`);
}

test('plain TypeScript', async ({ page: browser }) => {
  requested('typescript');
  project = new Project('typescript');
  project.manifest({}, VITE);
  project.write('tsconfig.json', TSCONFIG);
  project.paste('@glanz/viewer', ['index.html', 'src/main.ts']);
  await project.install();
  await project.type('@glanz/viewer', '@glanz/viewer');
  await project.timed('tsc', () => project.run('npx', ['--no-install', 'tsc', '-p', '.']));
  const dev = await sees(browser, await project.serve('dev'), 'canvas');
  await leave(browser);
  await project.timed('vite build', () => project.vite('build'));
  const built = await sees(await browser.context().newPage(), await project.serve('preview'), 'canvas');
  const code = fileFrom('@glanz/viewer', 'src/main.ts');
  report('plain TypeScript', linesOf(code), {
    'first pixels in development': dev.seconds,
    'first pixels of the build': built.seconds,
  });
  expect(linesOf(code)).toBeLessThanOrEqual(15);
  expect(built.complaints).toEqual([]);
  expect(dev.complaints).toEqual([]);
});

/**
 * Files and commands of a page, pasted into the template and built: what is seen. The second file is the one whose
 * lines are counted.
 */
async function asPasted(
  browser: Page,
  name: string,
  page: string,
  files: readonly string[],
  has: string,
  section?: string,
): Promise<void> {
  project = new Project(name);
  project.manifest({}, VITE);
  project.write('tsconfig.json', TSCONFIG);
  project.paste(page, files, section);
  await project.install();
  await project.type(page, has, section);
  await project.timed('tsc', () => project.run('npx', ['--no-install', 'tsc', '-p', '.']));
  await project.timed('vite build', () => project.vite('build'));
  const built = await sees(browser, await project.serve('preview'), 'canvas');
  report(name, linesOf(fileFrom(page, files[1] as string, section)), { 'first pixels of the build': built.seconds });
  expect(built.complaints).toEqual([]);
}

test('Getting started, its files and commands', async ({ page: browser }) => {
  requested('start');
  await asPasted(
    browser,
    'start',
    'getting-started',
    ['index.html', 'src/main.ts'],
    '@glanz/viewer',
    'A model on a canvas',
  );
});

test('Getting started, without the viewer', async ({ page: browser }) => {
  requested('canvas');
  const files = ['index.html', 'src/show.ts', 'src/main.ts'];
  await asPasted(browser, 'canvas', 'getting-started', files, '@glanz/renderer', 'In a browser, without the viewer');
});

test('the renderer, as its README begins', async ({ page: browser }) => {
  requested('renderer');
  await asPasted(browser, 'renderer', '@glanz/renderer', ['index.html', 'src/main.ts'], 'create vite');
});

test('Getting started, in Node', async ({ page: browser }) => {
  requested('node');
  project = new Project('node');
  const section = 'In Node';
  const foreign = installedBy('getting-started', '@glanz/renderer', section).filter(
    (name) => !name.startsWith('@glanz/'),
  );
  expect(foreign.sort()).toEqual(['sharp', 'webgpu']);
  // With the versions that the packages are tested with, as npm would choose them.
  project.manifest(Object.fromEntries(foreign.map((name) => [name, '*'])), {});
  project.paste('getting-started', ['render.mjs'], section);
  await project.install();
  await project.type('getting-started', '@glanz/renderer', section);
  const [command] = commandsFrom('getting-started', 'node render.mjs', section);
  await project.timed('render', () => project.run('sh', ['-c', command as string]));
  // The image is seen as one that was saved: not of one colour.
  const png = readFileSync(join(project.folder, 'push-button.png')).toString('base64');
  await browser.setContent(`<img alt="rendered" width="480" src="data:image/png;base64,${png}">`);
  const { colours } = await photograph(browser.locator('img'));
  report('in Node', linesOf(fileFrom('getting-started', 'render.mjs', section)), {});
  expect(colours).toBeGreaterThan(300);
});

test('the element with a bundler', async ({ page: browser }) => {
  requested('element');
  project = new Project('element');
  // The guide and the README say the same, so one of them is run.
  expect(fileFrom('element', 'index.html')).toBe(fileFrom('@glanz/element', 'index.html'));
  expect(commandsFrom('element', '@glanz/element')).toEqual(commandsFrom('@glanz/element', '@glanz/element'));
  project.manifest({}, VITE);
  project.paste('element', ['index.html']);
  await project.install();
  await project.type('element', '@glanz/element');
  await project.timed('vite build', () => project.vite('build'));
  const built = await sees(browser, await project.serve('preview'), 'glanz-viewer');
  report('the element', linesOf(fileFrom('element', 'index.html')), { 'first pixels of the build': built.seconds });
  expect(built.complaints).toEqual([]);
});

test('two lines of plain HTML, the element from another origin', async ({ page: browser }) => {
  requested('html');
  project = new Project('html');
  const code = quickStart('element', 'html');
  project.manifest({}, VITE);
  await project.install();
  const network = await project.network('@glanz/element');
  const local = code.replaceAll('https://cdn.jsdelivr.net/npm/@glanz/element', network);
  expect(local).not.toContain('https:');
  // Vite only serves the page: nothing of it is built.
  project.write('index.html', `<!doctype html>\n<link rel="icon" href="data:,">\n${local}\n`);
  const origin = (await project.serve('dev')).replace('127.0.0.1', 'localhost');
  const seen = await sees(browser, origin, 'glanz-viewer');
  report('two lines of plain HTML', linesOf(code), { 'first pixels': seen.seconds });
  expect(linesOf(code)).toBe(2);
  expect(seen.complaints).toEqual([]);
});

test('React', async ({ page: browser }) => {
  requested('react');
  project = new Project('react');
  const code = fileFrom('react', 'src/App.tsx');
  // The guide and the README say the same, so one of them is run.
  expect(code).toBe(fileFrom('@glanz/react', 'src/App.tsx'));
  expect(commandsFrom('react', 'create vite')).toEqual(commandsFrom('@glanz/react', 'create vite'));
  project.manifest(
    { react: '^19.3.1', 'react-dom': '^19.3.1' },
    { ...VITE, '@types/react': '^19.3.0', '@types/react-dom': '^19' },
  );
  project.write('tsconfig.json', TSCONFIG);
  // As the template has them.
  project.write('index.html', page('<div id="root"></div><script type="module" src="/src/main.tsx"></script>'));
  project.write(
    'src/main.tsx',
    "import { StrictMode } from 'react'\nimport { createRoot } from 'react-dom/client'\nimport App from './App.tsx'\n\ncreateRoot(document.getElementById('root')!).render(<StrictMode><App /></StrictMode>)\n",
  );
  project.paste('react', ['src/App.tsx']);
  await project.install();
  await project.type('react', 'create vite');
  await project.timed('tsc', () => project.run('npx', ['--no-install', 'tsc', '-p', '.']));
  const dev = await sees(browser, await project.serve('dev'), 'glanz-viewer');
  await leave(browser);
  project.write('public/push-button.glb', await compressed());
  await project.timed('vite build', () => project.vite('build'));
  const built = await sees(await browser.context().newPage(), await project.serve('preview'), 'glanz-viewer');
  report('React', linesOf(code), {
    'first pixels in development': dev.seconds,
    'first pixels of the build': built.seconds,
  });
  expect(linesOf(code)).toBeLessThanOrEqual(15);
  expect(built.complaints).toEqual([]);
  expect(dev.complaints).toEqual([]);
});

test('a page that a server rendered', async ({ page: browser }) => {
  requested('server');
  project = new Project('server');
  const code = fileFrom('react', 'src/App.tsx');
  project.manifest(
    { react: '^19.3.1', 'react-dom': '^19.3.1' },
    { ...VITE, '@types/react': '^19.3.0', '@types/react-dom': '^19' },
  );
  project.write('tsconfig.json', TSCONFIG);
  project.paste('react', ['src/App.tsx']);
  project.write(
    'src/client.tsx',
    "import { hydrateRoot } from 'react-dom/client'\nimport App from './App.tsx'\n\nhydrateRoot(document.getElementById('root')!, <App />)\n",
  );
  await project.install();
  await project.type('react', 'create vite');
  // In bare Node, nothing bundled: as a server that leaves packages alone imports them.
  project.write(
    'render.mjs',
    "import { createElement } from 'react'\nimport { renderToString } from 'react-dom/server'\nimport { GlanzViewer } from '@glanz/react'\nimport '@glanz/element/define'\nimport '@glanz/viewer'\nimport '@glanz/three'\nif (typeof GlanzViewer !== 'object') throw new Error('no component')\nprocess.stdout.write(renderToString(createElement(GlanzViewer, { src: '/push-button.glb', alt: 'A push-button' })))\n",
  );
  expect(await project.run(process.execPath, ['render.mjs'])).toBe(
    '<glanz-viewer alt="A push-button" src="/push-button.glb"></glanz-viewer>',
  );
  // And bundled: the same component, rendered by the server's build, taken over by the client's.
  project.write(
    'src/server.tsx',
    "import { renderToString } from 'react-dom/server'\nimport App from './App.tsx'\n\nprocess.stdout.write(renderToString(<App />))\n",
  );
  await project.timed('vite build --ssr', () => project.vite('build', '--ssr', 'src/server.tsx', '--outDir', 'server'));
  const html = await project.run(process.execPath, ['server/server.js']);
  expect(html).toMatch(/<glanz-viewer [^>]*src="\/push-button.glb"/);
  project.write(
    'index.html',
    page(
      `<div id="root">${html.slice(html.indexOf('<glanz-viewer'))}</div><script type="module" src="/src/client.tsx"></script>`,
    ),
  );
  await project.timed('vite build', () => project.vite('build'));
  const built = await sees(browser, await project.serve('preview'), 'glanz-viewer');
  report('a page that a server rendered', linesOf(code), { 'first pixels of the build': built.seconds });
  expect(built.complaints).toEqual([]);
});

test('Next.js', async ({ page: browser }) => {
  requested('next');
  project = new Project('next');
  project.manifest(
    { next: '^16.4.6', react: '^19.3.1', 'react-dom': '^19.3.1' },
    { typescript: '~6.0.3', '@types/react': '^19.3.0', '@types/react-dom': '^19', '@types/node': '^20' },
  );
  // This project lies inside the repository, whose lockfile Next.js would take for its root.
  project.write('next.config.mjs', 'export default { turbopack: { root: import.meta.dirname } };\n');
  // As the template has it.
  project.write(
    'app/layout.tsx',
    'import type { ReactNode } from \'react\';\n\nexport default function Layout({ children }: { children: ReactNode }) {\n  return <html lang="en"><head><link rel="icon" href="data:," /></head><body>{children}</body></html>;\n}\n',
  );
  project.paste('react', ['app/page.tsx', 'app/product.tsx', 'app/product/page.tsx']);
  await project.install();
  await project.type('react', 'create-next-app');
  project.write('public/push-button.glb', await compressed());
  await project.timed('next build', () => project.next('build'));
  const origin = await project.serveNext();
  const html = await (await fetch(origin)).text();
  expect(html).toMatch(/<glanz-viewer [^>]*src="\/push-button.glb"/);
  const server = await sees(browser, origin, 'glanz-viewer');
  const client = await sees(await browser.context().newPage(), `${origin}/product`, 'glanz-viewer');
  report('Next.js', linesOf(fileFrom('react', 'app/page.tsx')), {
    'first pixels in a server component': server.seconds,
    'first pixels in a client component': client.seconds,
  });
  expect(server.complaints).toEqual([]);
  expect(client.complaints).toEqual([]);
});
