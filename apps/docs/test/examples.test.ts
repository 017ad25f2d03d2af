import { mkdir, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { afterAll, beforeAll, describe, expect, test, vi } from 'vitest';
import { execFile } from 'node:child_process';
import { promisify } from 'node:util';
import { build } from 'esbuild';
import sharp from 'sharp';
import { createRequire } from 'node:module';
import { loadGltf } from '@glanz/gltf';
import { testDevice } from '@glanz/gpu';
import { decodeExr } from '@glanz/image/exr';
import { encodeHdr } from '@glanz/image/hdr';
import { readMaterialX } from '@glanz/openpbr/materialx';
import { PathTracer } from '@glanz/renderer';
import type { Mesh, PerspectiveCamera, Scene } from '@glanz/scene';
import { stepToGlb } from '../examples/cad';
import cadMaterials from '../examples/cad-materials.json';
import * as configurator from '../examples/configurator';
import * as cameras from '../examples/cameras';
import { open } from '../examples/errors';
import * as layers from '../examples/layers';
import * as lighting from '../examples/lighting';
import * as gltf from '../examples/load-gltf';
import * as materials from '../examples/materials';
import * as materialx from '../examples/materialx';
import { nod } from '../examples/pose';
import { productShot } from '../examples/product-shot';
import * as progressive from '../examples/progressive';
import { createSpheres } from '../examples/spheres';
import { weslSource } from '../../../tools/pipeline/wesl.mjs';

// Examples that want a canvas run in the browser: site.spec.ts.

const SIZE = { width: 24, height: 16 };
let device: GPUDevice;

/** Three spheres with the names that the examples use. */
function exampleScene(): Scene {
  const scene = createSpheres();
  ['floor', 'lid', 'packaging', 'screw 1'].forEach((name, i) => (scene.instances[i]!.name = name));
  ['table', 'housing', 'lens', 'glass'].forEach((name, i) => (scene.materials[i]!.name = name));
  scene.materials.push({ name: 'ring', parameters: {} });
  scene.lights = [
    { type: 'point', name: 'key', color: [1, 1, 1], intensity: 5, position: [0, 4, 2] },
    { type: 'point', name: 'lamp', color: [1, 1, 1], intensity: 5, position: [2, 4, 2] },
  ];
  scene.variants = ['matt black'];
  return scene;
}

async function withTracer<T>(
  use: (tracer: PathTracer) => Promise<T> | T,
  scene = exampleScene(),
  size = SIZE,
): Promise<T> {
  const tracer = await PathTracer.create(device, scene, { ...size, camera: 0 });
  try {
    return await use(tracer);
  } finally {
    tracer.destroy();
  }
}

async function image(tracer: PathTracer, samples = 4): Promise<Float32Array> {
  for await (const progress of tracer.render({ samples })) void progress;
  return tracer.read('beauty');
}

const mean = (rgba: ArrayLike<number>, channel: number) =>
  Array.from(rgba).reduce((sum, x, i) => (i % 4 === channel ? sum + x : sum), 0) / (rgba.length / 4);

/** One of the spheres alone. */
function exampleSphere(): Scene {
  const { instances, ...scene } = createSpheres();
  return { ...scene, instances: instances.filter(({ name }) => name === 'clay') };
}

/** A .glb of one triangle. */
function triangleGlb(): Uint8Array<ArrayBuffer> {
  const positions = Float32Array.of(-1, -1, 0, 1, -1, 0, 0, 1, 0);
  const json = JSON.stringify({
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0, name: 'screw' }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [-1, -1, 0], max: [1, 1, 0] }],
    bufferViews: [{ buffer: 0, byteLength: 36 }],
    buffers: [{ byteLength: 36 }],
  });
  const text = new TextEncoder().encode(json.padEnd(4 * Math.ceil(json.length / 4)));
  const glb = new Uint8Array(12 + 8 + text.length + 8 + 36);
  const view = new DataView(glb.buffer);
  [0x46546c67, 2, glb.length, text.length, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  glb.set(text, 20);
  view.setUint32(20 + text.length, 36, true);
  view.setUint32(24 + text.length, 0x004e4942, true);
  glb.set(new Uint8Array(positions.buffer), 28 + text.length);
  return glb;
}

const dataUrl = (bytes: Uint8Array, type: string) => `data:${type};base64,${Buffer.from(bytes).toString('base64')}`;

beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterAll(() => device?.destroy());

describe('cameras', () => {
  test('from the left, through a lens, in focus where one points', () =>
    withTracer(async (tracer) => {
      const before = await image(tracer);
      cameras.fromTheLeft(tracer);
      expect((tracer.camera as PerspectiveCamera).yfov).toBeCloseTo(0.4189, 3);
      expect(await image(tracer)).not.toEqual(before);
      cameras.focusOn(tracer, 12, 8);
      const { lens_radius, focus_distance, yfov } = tracer.camera as PerspectiveCamera;
      expect(lens_radius).toBeCloseTo(0.024 / (2 * Math.tan(yfov / 2)) / 8, 6);
      expect(focus_distance).toBeGreaterThan(1);
    }));

  test('a plan, a panorama, an exposure', () =>
    withTracer(async (tracer) => {
      for (const camera of [cameras.plan, cameras.around]) {
        await tracer.setCamera(camera);
        expect(mean(await image(tracer), 1)).toBeGreaterThan(0.01);
      }
      const codes = await cameras.photograph(tracer);
      expect(codes.length).toBe(4 * SIZE.width * SIZE.height);
    }));
});

test('a head nods', async () => {
  const scene = exampleScene();
  const tracer = await PathTracer.create(device, scene, { ...SIZE, maxDepth: 2 });
  const [head] = scene.meshes;
  const frames: (string | undefined)[] = [];
  await nod(
    {
      replaceMesh: (name: string, mesh: Mesh) => {
        frames.push(mesh.pose && name);
        return frames.length < 4 ? tracer.replaceMesh(name, mesh) : Promise.resolve();
      },
      render: () => (frames.length < 4 ? tracer.render({ samples: 1 }) : []),
    } as unknown as PathTracer,
    head as Mesh,
  );
  expect(frames).toEqual(Array(30).fill(head?.name));
  tracer.destroy();
});

describe('layers', () => {
  test('a mask covers what it names', () =>
    withTracer(async (tracer) => {
      await image(tracer, 1);
      const [floor, nothing] = [await layers.maskOf(tracer, 'floor'), await layers.maskOf(tracer, 'no such part')];
      expect(floor.reduce((sum, x) => sum + x, 0)).toBeGreaterThan(20);
      expect(nothing.every((x) => x === 0)).toBe(true);
    }));

  test('layers come back out of the EXR', () =>
    withTracer(async (tracer) => {
      const beauty = await image(tracer);
      const { channels } = decodeExr(await layers.toExr(tracer));
      expect([...channels.keys()].sort()).toEqual([
        'A',
        'B',
        'G',
        'R',
        'depth.Z',
        'normal.X',
        'normal.Y',
        'normal.Z',
        'objectId.id',
      ]);
      const red = channels.get('R')!.data;
      // Half floats carry eleven bits.
      beauty.forEach((x, i) => i % 4 === 0 && expect(Math.abs(red[i / 4]! - x)).toBeLessThanOrEqual(x * 2 ** -11));
    }));

  test('a light dimmed afterwards', async () => {
    const log = vi.spyOn(console, 'log').mockImplementation(() => undefined);
    const create = vi
      .spyOn(PathTracer, 'create')
      .mockImplementationOnce((d, scene, options) => PathTracer.create(d, scene, { ...options, ...SIZE, camera: 0 }));
    const part = await layers.withLightGroups(device, exampleScene());
    expect(log.mock.calls.flat()).toContain('lamp');
    expect(mean(part, 0)).toBeGreaterThan(mean(part, 2));
    log.mockRestore();
    create.mockRestore();
  });
});

describe('lighting', () => {
  test('environments: a file, a studio, fog, darkness', () =>
    withTracer(async (tracer) => {
      const data = Float32Array.from({ length: 8 * 4 * 3 }, (_, i) => (i % 3 === 0 ? 2 : 0.1));
      await lighting.lightWith(tracer, dataUrl(encodeHdr({ width: 8, height: 4, data }), 'image/vnd.radiance'));
      const red = await image(tracer);
      expect(mean(red, 0)).toBeGreaterThan(2 * mean(red, 2));
      await lighting.inTheStudio(tracer);
      expect(mean(await image(tracer), 1)).toBeGreaterThan(0.05);
      await lighting.inFog(tracer);
      expect(mean(await image(tracer), 2)).toBeGreaterThan(0.05);
      await lighting.inTheDark(tracer);
    }));

  test('punctual and area lights, emission', async () => {
    const scene = lighting.addPanels(lighting.addPunctualLights(exampleScene()));
    delete (scene as { environment?: unknown }).environment;
    await withTracer(async (tracer) => {
      expect(mean(await image(tracer), 0)).toBeGreaterThan(0.001);
      await lighting.glow(tracer);
      const [r, g] = [mean(await image(tracer), 0), mean(await tracer.read('beauty'), 1)];
      expect(g).toBeGreaterThan(r);
    }, scene);
  });

  test('a light by its IES file', async () => {
    const ies = new TextEncoder().encode(
      'IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0.1 0.1 0\n1 1 10\n0 45 90\n0\n900 400 0',
    );
    const scene = lighting.addDownlight({ ...exampleScene(), lights: [] }, ies);
    delete (scene as { environment?: unknown }).environment;
    await withTracer(async (tracer) => {
      const pixels = await image(tracer);
      expect(mean(pixels, 0)).toBeGreaterThan(0.001);
      expect(mean(pixels, 0)).toBeGreaterThan(mean(pixels, 2));
    }, scene);
  });

  test('onto a photograph', async () => {
    const create = vi
      .spyOn(PathTracer, 'create')
      .mockImplementationOnce((d, scene, options) => PathTracer.create(d, scene, { ...options, ...SIZE, camera: 0 }));
    const tracer = await lighting.ontoPhotograph(device, exampleScene());
    const alpha = Array.from(await image(tracer)).filter((_, i) => i % 4 === 3);
    expect(Math.min(...alpha)).toBeLessThan(0.9);
    expect(Math.max(...alpha)).toBeGreaterThan(0.99);
    tracer.destroy();
    create.mockRestore();
  });
});

describe('glTF', () => {
  test('from an address, from a drop, without screws', async () => {
    const glb = triangleGlb();
    const scene = await gltf.fromUrl(dataUrl(glb, 'model/gltf-binary'), new AbortController().signal);
    expect(scene.instances.map(({ name }) => name)).toEqual(['screw']);
    expect(gltf.withoutScrews(scene).instances).toEqual([]);
    const dropped = await gltf.fromDrop([new File([glb], 'triangle.glb')] as unknown as FileList);
    expect(dropped.meshes.length).toBe(1);
  });

  test('an incomplete download is reported', async () => {
    const said: string[] = [];
    expect(
      await open(dataUrl(triangleGlb().slice(0, 100), 'model/gltf-binary'), (text) => said.push(text)),
    ).toBeUndefined();
    expect(said).toEqual(['The file is incomplete. Load it again?']);
  });
});

describe('materials', () => {
  test('paint, and what a user typed', () =>
    withTracer(async (tracer) => {
      await materials.repaint(tracer);
      expect(tracer.scene.materials[1]?.parameters.base_color).toEqual([0.8, 0.1, 0.1]);
      await materials.repaintByName(tracer, 'lime');
      expect(tracer.scene.materials[1]?.parameters.base_color).toEqual([0, 1, 0]);
      await expect(tracer.setMaterial(1, { base_color: 'lime' } as never)).rejects.toThrow('cssColor()');
      const warn = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
      expect(materials.fromUser({ specular_roughness: 3 })).toMatchObject({ specular_roughness: 1 });
      expect(warn).toHaveBeenCalledOnce();
      warn.mockRestore();
      expect(materials.sliders.length).toBeGreaterThan(20);
      const scene = exampleScene();
      scene.materials[1] = materials.chrome;
      scene.materials[2] = materials.rubber;
      scene.materials[3] = materials.brushed;
      await withTracer(async (other) => expect(mean(await image(other), 1)).toBeGreaterThan(0.02), scene);
    }));

  test('MaterialX in and out, presets', () =>
    withTracer(async (tracer) => {
      expect(readMaterialX(materialx.document).materials.map(({ name }) => name)).toContain('housing');
      await materialx.dress(
        tracer,
        dataUrl(new TextEncoder().encode(materialx.document.replaceAll('label', 'table')), 'application/mtlx+xml'),
      );
      expect(tracer.scene.materials[1]?.parameters.base_metalness).toBe(1);
      await materialx.pour(tracer);
      expect(mean(await image(tracer, 1), 1)).toBeGreaterThan(0);
    }));
});

describe('progress', () => {
  test('reported, stopped, adaptive', () =>
    withTracer(
      async (tracer) => {
        const lines: string[] = [];
        await progressive.render(tracer, (text) => lines.push(text));
        expect(lines.at(-1)).toMatch(/^512\/512, .* a second, 0 s left$/);
        tracer.reset();
        const noise: string[] = [];
        await progressive.untilGood(tracer, (text) => noise.push(text));
        expect(noise.length).toBeGreaterThan(0);
        tracer.reset();
        const button = new EventTarget();
        const stopped = progressive.renderUntilClicked(tracer, button as HTMLButtonElement);
        setTimeout(() => button.dispatchEvent(new Event('click')), 50);
        expect((await stopped).length).toBe(4 * 4 * 4);
        expect(tracer.samples).toBeLessThan(4096);
        const abort = new AbortController();
        tracer.reset();
        await progressive.keepRendering(tracer, abort.signal, () => tracer.samples >= 8 && abort.abort());
        expect(tracer.samples).toBeGreaterThanOrEqual(8);
        // Thousands of samples of few pixels.
      },
      exampleScene(),
      { width: 4, height: 4 },
    ));

  test('edits of every kind', () =>
    withTracer(async (tracer) => {
      const before = await image(tracer);
      await progressive.rearrange(tracer);
      expect(await image(tracer)).not.toEqual(before);
    }));
});

test('a product shot is a cut-out with a shadow', async () => {
  const png = await productShot(device, exampleSphere(), [32, 24], 0.2);
  const { data } = await sharp(png).raw().toBuffer({ resolveWithObject: true });
  const alpha = [...data].filter((_, i) => i % 4 === 3);
  expect(alpha.filter((a) => a === 255).length).toBeGreaterThan(50);
  expect(alpha.filter((a) => a > 5 && a < 200).length).toBeGreaterThan(20);
});

test('a configurator: parts, colours, an address', () => {
  const scene = exampleScene();
  scene.meshes[0]!.name = 'legend';
  return withTracer(async (tracer) => {
    const lens = {
      name: 'lens',
      choices: [
        { name: 'lid', shows: ['lid'] },
        { name: 'box', shows: ['packaging'], materials: { packaging: 'ring' } },
      ],
    };
    expect(configurator.assemblies([lens, lens, lens])).toBe(8);
    expect(await configurator.choose(tracer, lens, 'box')).toBeGreaterThan(0);
    const of = (name: string) => tracer.scene.instances.find((instance) => instance.name === name)!;
    expect([of('lid').visible, of('packaging').visible, of('packaging').material]).toEqual([false, true, 4]);
    await expect(configurator.choose(tracer, lens, 'none')).rejects.toThrow('lens has no choice none');
    const choices = { lens: 'clear & bright', legend: 'ä' };
    expect(configurator.fromAddress(configurator.toAddress(choices))).toEqual(choices);
    expect(configurator.withHidden(tracer.scene, new Set(['floor'])).instances.map(({ visible }) => visible)).toContain(
      false,
    );
    const before = await image(tracer);
    await configurator.engrave(tracer, {
      name: 'legend',
      positions: Float32Array.of(-1, 0, 0, 1, 0, 0, 0, 1, 0),
      indices: Uint32Array.of(0, 1, 2),
    });
    expect(await image(tracer)).not.toEqual(before);
  }, scene);
});

test('the Node example as it is printed, at a smaller size', async () => {
  const cache = join(dirname(fileURLToPath(import.meta.url)), '../.vitepress/cache');
  await mkdir(cache, { recursive: true });
  const folder = await mkdtemp(join(cache, 'examples-'));
  try {
    const source = await readFile(new URL('../examples/node.ts', import.meta.url), 'utf8');
    const contents = source.replace('[640, 480]', '[32, 24]').replace('samples: 64', 'samples: 4');
    expect(contents).not.toMatch(/640|64/);
    await build({
      stdin: { contents, resolveDir: fileURLToPath(new URL('../examples', import.meta.url)), loader: 'ts' },
      outfile: join(folder, 'node.mjs'),
      conditions: ['@glanz/source'],
      bundle: true,
      format: 'esm',
      platform: 'node',
      external: ['webgpu', 'sharp', '@sparticuz/chromium'],
      plugins: [weslSource()],
    });
    await writeFile(join(folder, 'push-button.glb'), triangleGlb());
    const { stderr } = await promisify(execFile)(process.execPath, ['node.mjs'], { cwd: folder });
    expect(stderr).toContain('4, 0 s left');
    expect([...(await readFile(join(folder, 'push-button.png'))).subarray(0, 4)]).toEqual([0x89, 0x50, 0x4e, 0x47]);
  } finally {
    await rm(folder, { recursive: true, force: true });
  }
});

test('CAD to web', { timeout: 120_000 }, async () => {
  // An assembly of the CAx Implementor Forum, as the reader's package brings it along.
  const folder = dirname(
    createRequire(new URL('../../../packages/cad/package.json', import.meta.url)).resolve(
      'occt-import-js/package.json',
    ),
  );
  const step = await readFile(join(folder, 'test/testfiles/cax-if/as1-oc-214/as1-oc-214.stp'));
  const files = await stepToGlb(new Uint8Array(step), cadMaterials);
  const levels = await Promise.all(files.map((file) => loadGltf(new Uint8Array(file))));
  const triangles = levels.map(({ instances, meshes }) =>
    instances.reduce((sum, { mesh }) => sum + meshes[mesh]!.indices.length / 3, 0),
  );
  expect(levels.map(({ warnings, instances }) => [warnings.length, instances.length])).toEqual([
    [0, 18],
    [0, 18],
    [0, 18],
  ]);
  expect(triangles[0]).toBeGreaterThan(2 * triangles[1]!);
  expect(triangles[1]).toBeGreaterThan(1.5 * triangles[2]!);
  // Brass and aluminium by the rules; the paths of the rules are those of the file.
  const metals = levels[0]!.materials.filter(({ parameters }) => parameters.base_metalness === 1);
  expect(metals.length).toBeGreaterThanOrEqual(2);
});
