import { TEMPORAL_AOVS, TemporalFilter, type FilteredImage } from '@glanz/denoise/temporal';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { PathTracer } from '@glanz/renderer';
import { createScene, type Light, type Material, type PerspectiveCamera, type Scene } from '@glanz/scene';
import { afterAll, afterEach, beforeAll, expect, it } from 'vitest';
import { uncheckedReprojection } from '../../src/motion/unchecked-reprojection';

let device: GPUDevice;
let filter: TemporalFilter;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
  filter = await TemporalFilter.create(device);
  await filter.prepare(WIDTH, HEIGHT);
});
afterAll(() => filter?.destroy());
afterEach(() => expectNoGpuErrors());

const [WIDTH, HEIGHT] = [72, 48];
const FRAMES = 16;
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

type Point = readonly [x: number, y: number, z: number];

/** Emits light and reflects none: one sample of it has no noise. */
const glowing = (r: number, g = r, b = r): Material => ({
  name: 'glowing',
  parameters: { base_weight: 0, specular_weight: 0, emission_color: [r, g, b], emission_luminance: 1 },
});
const mirror: Material = {
  name: 'mirror',
  parameters: { base_color: [1, 1, 1], base_metalness: 1, specular_roughness: 0 },
};
/** Reflects nothing: no choice between two ways makes noise. */
const glass: Material = {
  name: 'glass',
  parameters: { transmission_weight: 1, specular_weight: 0, specular_roughness: 0, geometry_thin_walled: true },
};
const matte = (value: number): Material => ({
  name: 'matte',
  parameters: { base_color: [value, value, value], specular_weight: 0 },
});

/** Adds rectangles, each given by a corner and two edges. */
function add(scene: Scene, material: Material, rectangles: readonly (readonly [Point, Point, Point])[]): void {
  const positions = rectangles.flatMap(([corner, u, v]) =>
    [
      [0, 0],
      [1, 0],
      [1, 1],
      [0, 1],
    ].flatMap(([s, t]) => [0, 1, 2].map((k) => corner[k]! + s! * u[k]! + t! * v[k]!)),
  );
  const name = `${material.name} ${scene.meshes.length}`;
  scene.meshes.push({
    name,
    positions: new Float32Array(positions),
    indices: new Uint32Array(rectangles.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map((k) => 4 * i + k))),
  });
  scene.materials.push(material);
  scene.instances.push({
    name,
    mesh: scene.meshes.length - 1,
    material: scene.materials.length - 1,
    transform: IDENTITY,
  });
}

/** Upright stripes of a width that face +z, every other one bright, the others dim. */
function addStripes(scene: Scene, width: number, z: number, turned = false): void {
  const all = Array.from({ length: 61 }, (_, i) => i - 30);
  for (const odd of [0, 1])
    add(
      scene,
      odd === 1 ? glowing(0.1, 0.15, 0.2) : glowing(0.8, 0.9, 1),
      all
        .filter((i) => Math.abs(i % 2) === odd)
        .map(
          (i) =>
            [
              [i * width, -9, z],
              [turned ? -width : width, 0, 0],
              [0, 18, 0],
            ] as const,
        ),
    );
}

/** From (x, 0, 3) along −z; the image shows 3 × 2 units of the plane z = 0. */
const view = (x: number): PerspectiveCamera => ({
  type: 'perspective',
  name: 'view',
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 3, 1],
  yfov: 2 * Math.atan(1 / 3),
});

/** Pixels whose 5 × 5 neighbours are alike: away from edges, which are jagged in an image of one sample. */
function evenPixels(image: Float32Array): number[] {
  const even: number[] = [];
  for (let y = 2; y < HEIGHT - 2; y++)
    for (let x = 2; x < WIDTH - 2; x++) {
      const spread = [0, 1, 2].map((k) => {
        const around = Array.from(
          { length: 25 },
          (_, i) => image[4 * ((y + Math.floor(i / 5) - 2) * WIDTH + x + (i % 5) - 2) + k]!,
        );
        return Math.max(...around) - Math.min(...around);
      });
      if (Math.max(...spread) < 0.1) even.push(y * WIDTH + x);
    }
  return even;
}

/** Root of the mean squared difference of RGB over some pixels. */
function difference(a: Float32Array, b: Float32Array, pixels: readonly number[]): number {
  const squares = pixels.flatMap((i) => [0, 1, 2].map((k) => (a[4 * i + k]! - b[4 * i + k]!) ** 2));
  return Math.sqrt(squares.reduce((sum, square) => sum + square, 0) / squares.length);
}

/**
 * Moves the camera sideways by a step and takes a sample, frame after frame, and compares the last frame with its
 * reference away from edges: as the filter shows it, by reprojection without any check, and without its history.
 *
 * @param referenceSamples Those of the reference; more where one sample is noise.
 * @param edit Is called before each frame is rendered, with the number of frames that follow.
 */
async function ghosts(
  scene: Scene,
  step: number,
  edit?: (tracer: PathTracer, left: number) => Promise<void>,
  referenceSamples = 16,
) {
  const size = { width: WIDTH, height: HEIGHT };
  const tracer = await PathTracer.create(device, scene, { ...size, camera: view(0), maxDepth: 4, aovs: TEMPORAL_AOVS });
  const naive = uncheckedReprojection(WIDTH, HEIGHT);
  let filtered: FilteredImage | undefined;
  let unchecked: Float32Array = new Float32Array();
  for (let frame = 0; frame < FRAMES; frame++) {
    await tracer.setCamera(view((frame - FRAMES / 2) * step));
    await edit?.(tracer, FRAMES - frame);
    // As in the viewer: without a history the tracer tells no motion.
    const follows = frame > 0 && tracer.history !== undefined;
    tracer.reset({ firstSample: frame });
    for await (const _ of tracer.render({ samples: 1 }));
    filtered = filter.filterTracer(tracer, follows ? 'moves' : 'cuts');
    unchecked = naive.add(await tracer.read('beauty'), await tracer.read('motion'));
  }
  const shown = await filter.read(filtered!);
  const last = await tracer.read('beauty');
  tracer.reset({ firstSample: FRAMES });
  for await (const _ of tracer.render({ samples: referenceSamples }));
  const reference = await tracer.read('beauty');
  tracer.destroy();
  const pixels = evenPixels(reference);
  expect(pixels.length).toBeGreaterThan(400);
  const off = (image: Float32Array) => difference(image, reference, pixels);
  return { filtered: off(shown), unchecked: off(unchecked), raw: off(last) };
}

it('has no trails of thin wires before a background that moves otherwise', async () => {
  const scene = createScene();
  addStripes(scene, 0.7, -2);
  add(
    scene,
    glowing(1, 0.1, 0.05),
    [-4, -3, -2, -1, 0, 1, 2, 3, 4].map(
      (i) =>
        [
          [i * 0.3, -2, 1],
          [0.02, 0, 0],
          [0, 4, 0],
        ] as const,
    ),
  );
  const { filtered, unchecked } = await ghosts(scene, 0.05);
  expect(unchecked).toBeGreaterThan(0.1);
  expect(filtered).toBeLessThan(0.01);
});

it('shows what moves in a mirror', async () => {
  const scene = createScene();
  add(scene, mirror, [
    [
      [-3, -3, 0],
      [6, 0, 0],
      [0, 6, 0],
    ],
  ]);
  addStripes(scene, 0.8, 4.5, true);
  const { filtered, unchecked } = await ghosts(scene, 0.05);
  expect(unchecked).toBeGreaterThan(0.1);
  expect(filtered).toBeLessThan(0.01);
});

// As in a mirror: the chain is followed by the same code (aov-chains.test.ts of the renderer).
it.runIf(process.env['GLANZ_FULL'])('shows what moves behind clear glass', async () => {
  const scene = createScene();
  add(scene, glass, [
    [
      [-3, -3, 0],
      [6, 0, 0],
      [0, 6, 0],
    ],
  ]);
  addStripes(scene, 0.8, -4);
  const { filtered, unchecked } = await ghosts(scene, 0.05);
  expect(unchecked).toBeGreaterThan(0.1);
  expect(filtered).toBeLessThan(0.01);
});

it('takes the noise from what a mirror shows, too', async () => {
  // A wall behind the camera, lit by a square from above: one sample of its shadows is noise.
  const scene = createScene();
  add(scene, mirror, [
    [
      [-3, -3, 0],
      [6, 0, 0],
      [0, 6, 0],
    ],
  ]);
  add(scene, matte(0.8), [
    [
      [9, -9, 5],
      [-18, 0, 0],
      [0, 18, 0],
    ],
  ]);
  add(scene, glowing(4), [
    [
      [-2, 4, 2.5],
      [4, 0, 0],
      [0, 0, 2],
    ],
  ]);
  const { filtered, raw } = await ghosts(scene, 0.02, undefined, 64);
  expect(raw).toBeGreaterThan(0.05);
  expect(filtered / raw).toBeLessThan(0.3);
});

it('has forgotten a light within five frames', async () => {
  const scene = createScene();
  add(scene, matte(0.8), [
    [
      [-3, -3, 0],
      [6, 0, 0],
      [0, 6, 0],
    ],
  ]);
  const light = (intensity: number): Light => ({
    type: 'point',
    name: `${intensity}`,
    position: [intensity / 9, 0.5, 2],
    color: [1, 1, 1],
    intensity,
  });
  scene.lights.push(light(9), light(1));
  const { filtered, unchecked } = await ghosts(scene, 0.02, async (tracer, left) => {
    if (left === 5) await tracer.setLight(0, { ...light(9), intensity: 0 });
  });
  expect(unchecked).toBeGreaterThan(0.1);
  expect(filtered).toBeLessThan(0.01);
});
