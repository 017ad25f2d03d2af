import { createPushButton } from '@glanz/models';
import { sceneToGlb } from '@glanz/models/gltf';
import { photograph } from '@glanz/browser';
import { WebIO } from '@gltf-transform/core';
import { KHRDracoMeshCompression, KHRONOS_EXTENSIONS } from '@gltf-transform/extensions';
import { expect, test, type Page } from '@playwright/test';
import draco from 'draco3dgltf';
import { commandsOf, fileFromGuide, linesOf, Project, quickStart } from './project';

const only = process.env['GLANZ_NEWCOMER_ONLY'];
const wanted = (name: string) => test.skip(only !== undefined && only !== name, 'GLANZ_NEWCOMER_ONLY asks for another');

test.setTimeout(600_000);
test.use({ viewport: { width: 480, height: 320 } });

let project: Project;
test.afterEach(() => project?.stop());

const VITE = { typescript: '~6.0.3', vite: '^8.3.8' };
const TSCONFIG = JSON.stringify({ compilerOptions: { target: 'ES2022', lib: ['ES2022', 'DOM', 'DOM.Iterable'], module: 'ESNext', moduleResolution: 'bundler', types: ['vite/client'], strict: true, skipLibCheck: true, noEmit: true, jsx: 'react-jsx', noUncheckedSideEffectImports: true }, include: ['src'] });
const page = (body: string) => `<!doctype html>\n<html lang="en"><head><meta charset="utf-8" /><link rel="icon" href="data:," /><title>newcomer</title></head><body style="margin: 0">${body}</body></html>\n`;

const model = async () => new Uint8Array(await sceneToGlb(createPushButton({ level: 'low' })));

/** The same model as an exporter compresses it: what shows it has found the decoder's chunk. */
const compressed = async () => {
  const io = new WebIO().registerExtensions(KHRONOS_EXTENSIONS).registerDependencies({ 'draco3d.encoder': await draco.createEncoderModule(), 'draco3d.decoder': await draco.createDecoderModule() });
  const document = await io.readBinary(await model());
  document.createExtension(KHRDracoMeshCompression).setRequired(true);
  return io.writeBinary(document);
};

/** Opens a page and waits until the element shows a path-traced model. @returns What the page complained about. */
async function sees(browser: Page, address: string, selector: string): Promise<{ readonly seconds: number; readonly complaints: readonly string[] }> {
  const complaints: string[] = [];
  browser.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  browser.on('pageerror', (error) => complaints.push(`uncaught: ${error.message}`));
  const from = performance.now();
  await browser.goto(address);
  await expect.poll(async () => ((await browser.locator(selector).count()) > 0 ? (await photograph(browser.locator(selector))).colours : 0), { timeout: 120_000, intervals: [100] }).toBeGreaterThan(300);
  return { seconds: (performance.now() - from) / 1000, complaints };
}

function report(name: string, lines: number, seconds: Record<string, number>): void {
  const parts = [...Object.entries(project.timings).map(([what, ms]) => [what, ms / 1000] as const), ...Object.entries(seconds)].map(([what, value]) => `${what} ${value.toFixed(1)} s`);
  console.log(`${name}: ${lines} lines; ${parts.join(', ')}`);
}

test('plain TypeScript', async ({ page: browser }) => {
  wanted('typescript');
  project = new Project('typescript');
  const code = quickStart('viewer', 'ts');
  project.manifest({}, VITE);
  project.write('tsconfig.json', TSCONFIG);
  project.write('index.html', page('<canvas style="display: block; width: 480px; height: 320px"></canvas><script type="module" src="/src/main.ts"></script>'));
  project.write('src/main.ts', code);
  project.write('public/chair.glb', await model());
  await project.install();
  await project.timed('tsc', () => project.run('npx', ['--no-install', 'tsc', '-p', '.']));
  const dev = await sees(browser, await project.serve('dev'), 'canvas');
  project.stop();
  await project.timed('vite build', () => project.vite('build'));
  const built = await sees(await browser.context().newPage(), await project.serve('preview'), 'canvas');
  report('plain TypeScript', linesOf(code), { 'first pixels in development': dev.seconds, 'first pixels of the build': built.seconds });
  expect(linesOf(code)).toBeLessThanOrEqual(15);
  expect(built.complaints).toEqual([]);
  expect(dev.complaints).toEqual([]);
});

test('Getting started, its files and commands', async ({ page: browser }) => {
  wanted('start');
  project = new Project('start');
  project.manifest({}, VITE);
  project.write('tsconfig.json', TSCONFIG);
  for (const file of ['index.html', 'src/main.ts']) project.write(file, fileFromGuide('getting-started', file));
  await project.install();
  for (const line of commandsOf('getting-started', '@glanz/viewer')) await project.run('sh', ['-c', line]);
  await project.timed('tsc', () => project.run('npx', ['--no-install', 'tsc', '-p', '.']));
  await project.timed('vite build', () => project.vite('build'));
  const built = await sees(browser, await project.serve('preview'), 'canvas');
  report('Getting started', linesOf(fileFromGuide('getting-started', 'src/main.ts')), { 'first pixels of the build': built.seconds });
  expect(built.complaints.filter((text) => !text.includes('favicon'))).toEqual([]);
});

test('two lines of plain HTML, the element from another origin', async ({ page: browser }) => {
  wanted('html');
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
  wanted('react');
  project = new Project('react');
  const code = quickStart('react', 'tsx');
  project.manifest({ react: '^19.3.1', 'react-dom': '^19.3.1' }, { ...VITE, '@types/react': '^19.3.0', '@types/react-dom': '^19' });
  project.write('tsconfig.json', TSCONFIG);
  project.write('index.html', page('<div id="root"></div><script type="module" src="/src/main.tsx"></script>'));
  project.write('src/Chair.tsx', code);
  // As the template has it.
  project.write('src/main.tsx', "import { StrictMode } from 'react'\nimport { createRoot } from 'react-dom/client'\nimport { Chair } from './Chair'\n\ncreateRoot(document.getElementById('root')!).render(<StrictMode><Chair /></StrictMode>)\n");
  project.write('public/chair.glb', await compressed());
  project.write('public/chair.webp', Buffer.from('R0lGODlhAQABAIAAAAAAAP///yH5BAEAAAAALAAAAAABAAEAAAIBRAA7', 'base64'));
  await project.install();
  await project.timed('tsc', () => project.run('npx', ['--no-install', 'tsc', '-p', '.']));
  const dev = await sees(browser, await project.serve('dev'), 'glanz-viewer');
  project.stop();
  await project.timed('vite build', () => project.vite('build'));
  const built = await sees(await browser.context().newPage(), await project.serve('preview'), 'glanz-viewer');
  report('React', linesOf(code), { 'first pixels in development': dev.seconds, 'first pixels of the build': built.seconds });
  expect(linesOf(code)).toBeLessThanOrEqual(15);
  expect(built.complaints).toEqual([]);
  expect(dev.complaints).toEqual([]);
});

test('a page that a server rendered', async ({ page: browser }) => {
  wanted('server');
  project = new Project('server');
  const code = quickStart('react', 'tsx');
  project.manifest({ react: '^19.3.1', 'react-dom': '^19.3.1' }, { ...VITE, '@types/react': '^19.3.0', '@types/react-dom': '^19' });
  project.write('tsconfig.json', TSCONFIG);
  project.write('src/Chair.tsx', code);
  project.write('src/client.tsx', "import { hydrateRoot } from 'react-dom/client'\nimport { Chair } from './Chair'\n\nhydrateRoot(document.getElementById('root')!, <Chair />)\n");
  project.write('public/chair.glb', await model());
  project.write('public/chair.webp', Buffer.from('R0lGODlhAQABAIAAAAAAAP///yH5BAEAAAAALAAAAAABAAEAAAIBRAA7', 'base64'));
  await project.install();
  // In bare Node, nothing bundled: as a server that leaves packages alone imports them.
  project.write('render.mjs', "import { createElement } from 'react'\nimport { renderToString } from 'react-dom/server'\nimport { GlanzViewer } from '@glanz/react'\nimport '@glanz/element/define'\nimport '@glanz/viewer'\nimport '@glanz/three'\nif (typeof GlanzViewer !== 'object') throw new Error('no component')\nprocess.stdout.write(renderToString(createElement(GlanzViewer, { src: '/chair.glb', alt: 'An oak chair' })))\n");
  expect(await project.run(process.execPath, ['render.mjs'])).toBe('<glanz-viewer alt="An oak chair" src="/chair.glb"></glanz-viewer>');
  // And bundled: the same component, rendered by the server's build, taken over by the client's.
  project.write('src/server.tsx', "import { renderToString } from 'react-dom/server'\nimport { Chair } from './Chair'\n\nprocess.stdout.write(renderToString(<Chair />))\n");
  await project.timed('vite build --ssr', () => project.vite('build', '--ssr', 'src/server.tsx', '--outDir', 'server'));
  const html = await project.run(process.execPath, ['server/server.js']);
  expect(html).toMatch(/<glanz-viewer [^>]*src="\/chair.glb"/);
  project.write('index.html', page(`<div id="root">${html.slice(html.indexOf('<glanz-viewer'))}</div><script type="module" src="/src/client.tsx"></script>`));
  await project.timed('vite build', () => project.vite('build'));
  const built = await sees(browser, await project.serve('preview'), 'glanz-viewer');
  report('a page that a server rendered', linesOf(code), { 'first pixels of the build': built.seconds });
  expect(built.complaints).toEqual([]);
});

test('Next.js', async ({ page: browser }) => {
  wanted('next');
  project = new Project('next');
  project.manifest({ next: '^16.4.6', react: '^19.3.1', 'react-dom': '^19.3.1' }, { typescript: '~6.0.3', '@types/react': '^19.3.0', '@types/react-dom': '^19', '@types/node': '^20' });
  // This project lies inside the repository, whose lockfile Next.js would take for its root.
  project.write('next.config.mjs', 'export default { turbopack: { root: import.meta.dirname } };\n');
  // As the template has it.
  project.write('app/layout.tsx', "import type { ReactNode } from 'react';\n\nexport default function Layout({ children }: { children: ReactNode }) {\n  return <html lang=\"en\"><head><link rel=\"icon\" href=\"data:,\" /></head><body>{children}</body></html>;\n}\n");
  for (const file of ['app/page.tsx', 'app/product.tsx', 'app/product/page.tsx']) project.write(file, fileFromGuide('react', file));
  project.write('public/chair.glb', await compressed());
  await project.install();
  await project.timed('next build', () => project.next('build'));
  const origin = await project.serveNext();
  const html = await (await fetch(origin)).text();
  expect(html).toMatch(/<glanz-viewer [^>]*src="\/chair.glb"/);
  const server = await sees(browser, origin, 'glanz-viewer');
  const client = await sees(await browser.context().newPage(), `${origin}/product`, 'glanz-viewer');
  report('Next.js', linesOf(fileFromGuide('react', 'app/page.tsx')), { 'first pixels in a server component': server.seconds, 'first pixels in a client component': client.seconds });
  expect(server.complaints).toEqual([]);
  expect(client.complaints).toEqual([]);
});
