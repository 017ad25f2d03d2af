import { execFile } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { quads, servePage, watch, type Served } from '@glanz/browser';
import { expect, test } from '@playwright/test';
import type { decodeExr } from '@glanz/image';
import type { frameCamera } from '@glanz/scene';
import type { Viewer, ViewerOptions } from '@glanz/viewer';
import { bundleProgram } from '../../cli/test/program';

declare global {
  interface Window {
    make: (options?: ViewerOptions) => Viewer;
    file: (base64: string, name: string) => File;
    frameCamera: typeof frameCamera;
    decodeExr: typeof decodeExr;
    viewer: Viewer;
  }
}

// Wider than 4 : 3, so that cameras which do not say what they are made for stay as they are.
const SIZE = [36, 24] as const,
  SAMPLES = 9,
  SEED = 5,
  DEPTH = 4;
const VARIANTS = ['plain', 'glossy', 'night'];
/** As the command takes them: cameras of the model by name, directions by degrees. */
const VIEWS = ['side', 'above', '30,20', '-70,40'];

/** Three squares above a fourth that takes their light; one of them is seen through another. */
const model = quads(
  [
    { name: 'floor', colour: [0.7, 0.7, 0.7], at: [0, 0, -1] },
    {
      name: 'red',
      colour: [0.9, 0.02, 0.02],
      at: [-0.6, 0.2, 0],
      variants: { plain: [0.9, 0.02, 0.02], glossy: [0.7, 0.4, 0.1], night: [0.05, 0.02, 0.3] },
    },
    { name: 'green', colour: [0.02, 0.8, 0.02], at: [1.2, -0.3, 0.4], variants: { night: [0.3, 0.3, 0.35] } },
  ],
  (json) => {
    for (const material of json['materials'] as { name: string; pbrMetallicRoughness: object; extensions?: object }[]) {
      if (material.name === 'red glossy')
        material.pbrMetallicRoughness = { ...material.pbrMetallicRoughness, metallicFactor: 1, roughnessFactor: 0.25 };
      if (material.name.startsWith('green'))
        material.pbrMetallicRoughness = { ...material.pbrMetallicRoughness, roughnessFactor: 0.1 };
    }
    const nodes = json['nodes'] as object[];
    json['cameras'] = [0.7, 0.9].map((yfov) => ({ type: 'perspective', perspective: { yfov, znear: 0.01 } }));
    nodes.push(
      { name: 'side', camera: 0, translation: [-2.5, 0.7, 4.1], rotation: [-0.07, -0.26, -0.019, 0.963] },
      { name: 'above', camera: 1, translation: [0.1, 3.3, 1.3], rotation: [-0.55, 0.02, 0.1, 0.829] },
    );
    json['scenes'] = [{ nodes: nodes.map((_, i) => i) }];
  },
);

let served: Served;
let folder = '';
test.beforeAll(async () => {
  served = await servePage(fileURLToPath(new URL('page', import.meta.url)));
  folder = mkdtempSync(join(tmpdir(), 'glanz-film-'));
});
test.afterAll(async () => {
  await served.close();
  rmSync(folder, { recursive: true, force: true });
});

/** Runs `glanz` in Node on the SwiftShader that the browser brings, file for file the same driver. */
async function glanz(browser: string, argv: readonly string[]): Promise<string> {
  const program = fileURLToPath(new URL('../.cache/glanz.mjs', import.meta.url));
  await bundleProgram(program);
  const driver = {
    VK_DRIVER_FILES: join(browser, 'vk_swiftshader_icd.json'),
    VK_ICD_FILENAMES: join(browser, 'vk_swiftshader_icd.json'),
    LD_LIBRARY_PATH: [browser, process.env['LD_LIBRARY_PATH']].filter(Boolean).join(':'),
  };
  const { stdout } = await promisify(execFile)(process.execPath, [program, ...argv], {
    cwd: folder,
    env: { ...process.env, ...driver },
    maxBuffer: 1 << 26,
  });
  return stdout;
}

/** How two lists of numbers differ. */
interface Difference {
  readonly count: number;
  readonly max: number;
  readonly of: number;
}

test('three variants from four views by one command are what the viewer shows in the browser on the same GPU: the film bit for bit, and the PNG', async ({
  page,
  launchOptions,
}) => {
  test.skip(!launchOptions.executablePath, 'the browser brings no driver that Node could load here');
  test.setTimeout(300_000);
  const complaints = watch(page, served.origin);
  writeFileSync(join(folder, 'm.glb'), model);
  const defaults = {
    model: 'm.glb',
    variant: 'all',
    view: VIEWS,
    size: SIZE.join('x'),
    samples: SAMPLES,
    seed: SEED,
    depth: DEPTH,
  };
  writeFileSync(
    join(folder, 'batch.json'),
    JSON.stringify({
      defaults,
      images: [
        { output: '{variant}/{view}.exr', bits: 32 },
        { output: '{variant}/{view}.png', bits: 8 },
      ],
    }),
  );
  const report = JSON.parse(
    await glanz(dirname(launchOptions.executablePath as string), [
      'render',
      '--batch',
      'batch.json',
      '--gpu',
      'SwiftShader',
      '--json',
    ]),
  ) as { images: { variant: string; view: string; files: { path: string }[] }[] };
  expect(report.images.length).toBe(2 * VARIANTS.length * VIEWS.length);

  await page.goto(served.origin);
  await page.evaluate(
    async ([base64, [width, height], settings]) => {
      Object.assign(document.querySelector('canvas')!.style, { width: `${width}px`, height: `${height}px` });
      window.viewer = window.make({ pixelRatio: 1, environment: 'studio', damping: 0, ...settings });
      await window.viewer.load(window.file(base64, 'm.glb'));
    },
    [model.toString('base64'), SIZE, { samples: SAMPLES, maxDepth: DEPTH, tracer: { seed: SEED } }] as const,
  );
  const films = new Set<string>();
  const differences: Record<string, { readonly film: Difference; readonly image: Difference }> = {};
  // The other way round than the command, so that nothing can have been left over in the same order.
  for (const [v, view] of [...VIEWS.entries()].reverse()) {
    for (const variant of [...VARIANTS].reverse()) {
      const name = report.images.filter((one) => one.variant === variant)[v]!.view;
      const file = (type: string) =>
        readFileSync(
          join(
            folder,
            report.images
              .flatMap(({ variant: of, view: from, files }) => (of === variant && from === name ? files : []))
              .find(({ path }) => path.endsWith(type))!.path,
          ),
        ).toString('base64');
      const { film, image, hash } = await page.evaluate(
        async ([expected, look, exr, png, samples]) => {
          const { viewer } = window;
          const bytes = (text: string) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
          const degrees = /^(-?\d+),(-?\d+)$/
            .exec(expected)
            ?.slice(1)
            .map((value) => (Number(value) * Math.PI) / 180);
          const [a, e] = degrees ?? [0, 0];
          await viewer.setVariant(look);
          viewer.setCamera(
            degrees
              ? window.frameCamera(viewer.scene!, {
                  aspect: viewer.canvas.width / viewer.canvas.height,
                  direction: [Math.sin(a!) * Math.cos(e!), Math.sin(e!), Math.cos(a!) * Math.cos(e!)],
                })
              : expected,
            { immediate: true },
          );
          const blob = await viewer.toBlob({ samples });
          const shown = await viewer.tracer!.read('beauty');
          const { width, height, channels } = window.decodeExr(bytes(exr));
          const written = Float32Array.from({ length: 4 * width * height }, (_, i) =>
            i % 4 === 3 ? shown[i]! : channels.get('RGB'[i % 4]!)!.data[i >> 2]!,
          );
          const pixels = async (source: Blob) => {
            const bitmap = await createImageBitmap(source, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
            const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d')!;
            context.drawImage(bitmap, 0, 0);
            return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
          };
          const compare = (left: ArrayLike<number>, right: ArrayLike<number>) => {
            const apart = Array.from(left, (value, i) =>
              Object.is(value, right[i]) ? 0 : Math.max(Math.abs(value - right[i]!), 1e-45),
            );
            return {
              of: left.length,
              count: left.length === right.length ? apart.filter((value) => value > 0).length : NaN,
              max: apart.reduce((max, value) => Math.max(max, value), 0),
            };
          };
          return {
            film: compare(shown, written),
            image: compare(await pixels(blob), await pixels(new Blob([bytes(png)]))),
            hash: Array.from(shown).join(),
          };
        },
        [view, variant, file('.exr'), file('.png'), SAMPLES] as const,
      );
      films.add(hash);
      differences[`${variant} from ${view}`] = { film, image };
    }
  }
  const values = 4 * SIZE[0] * SIZE[1];
  const same = { count: 0, max: 0, of: values };
  expect(differences).toEqual(
    Object.fromEntries(Object.keys(differences).map((key) => [key, { film: same, image: same }])),
  );
  // Twelve images that differ: nothing was compared with itself.
  expect(films.size).toBe(VARIANTS.length * VIEWS.length);
  expect(complaints).toEqual([]);
});
