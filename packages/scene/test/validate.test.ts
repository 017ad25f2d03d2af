import { OperationCounter } from '@glanz/operations';
import { afterAll, describe, expect, test } from 'vitest';
import { checkScene, createScene, defaultMaterial, SceneError, validateScene, validationSteps } from '../src/index';
import type { Scene } from '../src/index';

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

const counter = new OperationCounter(/\/packages\/scene\/src\//);
afterAll(() => counter.end());

/** A scene with one of everything. */
function whole(): Scene {
  const scene = createScene('test');
  scene.meshes.push({
    name: 'triangle',
    positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]),
    indices: new Uint32Array([0, 1, 2]),
    normals: new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1]),
    tangents: new Float32Array([1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1]),
    uvs: [new Float32Array(6)],
    colors: new Float32Array(12).fill(1),
  });
  scene.images.push({ name: 'white', width: 2, height: 1, data: new Uint8Array(8) });
  scene.textures.push({ image: 0, color_space: 'srgb' });
  scene.materials.push({
    ...defaultMaterial(),
    parameters: { base_weight: 0.5, base_color: [1, 0, 0] },
    textures: { base_color: { texture: 0, channels: 'rgb', transform: [1, 0, 0, 1, 0, 0] } },
  });
  scene.instances.push({ name: 'part', mesh: 0, material: 0, transform: identity });
  scene.lights.push({ type: 'point', name: 'p', color: [1, 1, 1], intensity: 1, position: [0, 0, 1] });
  scene.lights.push({
    type: 'spot',
    name: 's',
    color: [1, 1, 1],
    intensity: 1,
    position: [0, 0, 1],
    direction: [0, 0, -1],
    inner_cone_angle: 0,
    outer_cone_angle: 0.5,
  });
  scene.lights.push({ type: 'directional', name: 'd', color: [1, 1, 1], intensity: 1, direction: [0, -1, 0] });
  scene.cameras.push({ type: 'perspective', name: 'c', transform: identity, yfov: 1 });
  scene.cameras.push({ type: 'orthographic', name: 'o', transform: identity, xmag: 1, ymag: 1 });
  scene.environment = { type: 'latlong', width: 2, height: 1, data: new Float32Array(6) };
  return scene;
}

/** Every way to spoil the scene, with the code that it must give and words that must say where. */
const faults: [string, (scene: Scene) => void, string, RegExp][] = [
  [
    'positions not in threes',
    (s) => (s.meshes[0]!.positions = new Float32Array(8)),
    'scene/length',
    /Mesh 0 \("triangle"\): positions has 8/,
  ],
  ['a NaN position', (s) => (s.meshes[0]!.positions[4] = NaN), 'scene/not-finite', /Mesh 0 .*NaN at 4/],
  ['an index out of range', (s) => (s.meshes[0]!.indices[2] = 3), 'scene/reference', /triangle 0 refers to vertex 3/],
  ['indices not in threes', (s) => (s.meshes[0]!.indices = new Uint32Array(4)), 'scene/length', /indices has 4/],
  ['too few normals', (s) => (s.meshes[0]!.normals = new Float32Array(6)), 'scene/length', /normals has 6/],
  ['an infinite normal', (s) => (s.meshes[0]!.normals![0] = Infinity), 'scene/not-finite', /normals/],
  ['too few tangents', (s) => (s.meshes[0]!.tangents = new Float32Array(9)), 'scene/length', /tangents/],
  ['too few colours', (s) => (s.meshes[0]!.colors = new Float32Array(9)), 'scene/length', /colors/],
  ['too few uvs', (s) => (s.meshes[0]!.uvs![0] = new Float32Array(4)), 'scene/length', /uvs\[0\]/],
  ['an image of a wrong length', (s) => (s.images[0]!.data = new Uint8Array(7)), 'scene/length', /Image 0 \("white"\)/],
  [
    'blocks of a wrong length',
    (s) => (s.images[0]!.compressed = { format: 'bc7-rgba-unorm', levels: [new Uint8Array(32)] }),
    'scene/length',
    /Image 0 \("white"\), compressed level 0/,
  ],
  [
    'more levels than there are',
    (s) =>
      (s.images[0]!.compressed = {
        format: 'bc7-rgba-unorm',
        levels: [16, 16, 16].map((bytes) => new Uint8Array(bytes)),
      }),
    'scene/length',
    /3 compressed levels, instead of 1 to 2/,
  ],
  [
    'blocks of an unknown kind',
    (s) => (s.images[0]!.compressed = { format: 'pvrtc' as 'bc7-rgba-unorm', levels: [new Uint8Array(16)] }),
    'scene/value',
    /pvrtc/,
  ],
  ['an image of no size', (s) => (s.images[0]!.width = 0), 'scene/value', /Image 0/],
  ['a texture of no image', (s) => (s.textures[0]!.image = 1), 'scene/reference', /Texture 0 refers to image 1/],
  [
    'a binding of no texture',
    (s) => (s.materials[0]!.textures!.base_color!.texture = 4),
    'scene/reference',
    /base_color refers to texture 4/,
  ],
  [
    'a binding with a broken transform',
    (s) => (s.materials[0]!.textures!.base_color!.transform = [1, 0, 0, NaN, 0, 0]),
    'scene/not-finite',
    /base_color/,
  ],
  [
    'a broken priority',
    (s) => (s.materials[0]!.dielectric_priority = 256),
    'scene/value',
    /dielectric_priority is 256/,
  ],
  ['a NaN parameter', (s) => (s.materials[0]!.parameters = { base_weight: NaN }), 'scene/not-finite', /base_weight/],
  [
    'an infinite colour',
    (s) => (s.materials[0]!.parameters = { base_color: [1, Infinity, 0] }),
    'scene/not-finite',
    /base_color/,
  ],
  [
    'an instance of no mesh',
    (s) => (s.instances[0]!.mesh = -1),
    'scene/reference',
    /Instance 0 \("part"\) refers to mesh -1/,
  ],
  ['an instance of no material', (s) => (s.instances[0]!.material = 0.5), 'scene/reference', /material 0\.5/],
  [
    'a transform of 12 numbers',
    (s) => (s.instances[0]!.transform = identity.slice(4)),
    'scene/length',
    /transform has 12/,
  ],
  ['a NaN transform', (s) => (s.instances[0]!.transform = identity.with(3, NaN)), 'scene/not-finite', /transform/],
  ['a negative light', (s) => (s.lights[0]!.intensity = -1), 'scene/value', /Light 0/],
  ['a light at NaN', (s) => Object.assign(s.lights[0]!, { position: [0, NaN, 0] }), 'scene/not-finite', /Light 0/],
  ['a light without direction', (s) => Object.assign(s.lights[2]!, { direction: [0, 0, 0] }), 'scene/value', /Light 2/],
  [
    'a cone inside out',
    (s) => ((s.lights[1] as { inner_cone_angle: number }).inner_cone_angle = 1),
    'scene/value',
    /Light 1/,
  ],
  ['a field of view of π', (s) => ((s.cameras[0] as { yfov: number }).yfov = Math.PI), 'scene/value', /Camera 0/],
  [
    'a camera without depth',
    (s) => (s.cameras[0]!.transform = identity.with(10, 0)),
    'scene/value',
    /Camera 0 .*inverted/,
  ],
  [
    'a camera whose axes lie in a plane',
    (s) => (s.cameras[1]!.transform = [1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1]),
    'scene/value',
    /Camera 1/,
  ],
  ['a NaN camera', (s) => (s.cameras[0]!.transform = identity.with(12, NaN)), 'scene/not-finite', /Camera 0/],
  ['a lens of NaN', (s) => Object.assign(s.cameras[0]!, { lens_radius: NaN }), 'scene/not-finite', /Camera 0/],
  ...[NaN, Infinity, -Infinity].map((x): (typeof faults)[number] => [
    `a camera at ${x}`,
    (s) => (s.cameras[0]!.transform = identity.with(13, x)),
    'scene/not-finite',
    /Camera 0 .*at 13/,
  ]),
  ...[1e30, -1e13].map((x): (typeof faults)[number] => [
    `a camera at ${x}`,
    (s) => (s.cameras[1]!.transform = identity.with(14, x)),
    'scene/value',
    /Camera 1 .*away from the origin/,
  ]),
  ...[0, -1, NaN, Infinity, Math.PI, 4].map((yfov): (typeof faults)[number] => [
    `a field of view of ${yfov}`,
    (s) => Object.assign(s.cameras[0]!, { yfov }),
    'scene/value',
    /Camera 0 .*yfov/,
  ]),
  ...[NaN, Infinity].flatMap((x) =>
    ['aspect', 'lens_radius', 'focus_distance', 'lens_blades', 'lens_rotation'].map((key): (typeof faults)[number] => [
      `${key} of ${x}`,
      (s) => Object.assign(s.cameras[0]!, { [key]: x }),
      'scene/not-finite',
      /Camera 0/,
    ]),
  ),
  ...[
    ['aspect', 0],
    ['aspect', -1],
    ['lens_radius', -1e-3],
    ['lens_radius', 1e30],
    ['focus_distance', 0],
    ['focus_distance', -1],
    ['lens_blades', -5],
  ].map(([key, x]): (typeof faults)[number] => [
    `${key} of ${x}`,
    (s) => Object.assign(s.cameras[0]!, { [key!]: x }),
    'scene/value',
    new RegExp(`Camera 0 .*${key}`),
  ]),
  ...[NaN, Infinity, -1, 1e30].map((ymag): (typeof faults)[number] => [
    `a view as high as ${ymag}`,
    (s) => Object.assign(s.cameras[1]!, { ymag }),
    'scene/value',
    /Camera 1 .*ymag/,
  ]),
  [
    'a camera of an unknown type',
    (s) => Object.assign(s.cameras[0]!, { type: 'fisheye' }),
    'scene/value',
    /Camera 0 .*fisheye/,
  ],
  ['a view of no size', (s) => ((s.cameras[1] as { xmag: number }).xmag = 0), 'scene/value', /Camera 1/],
  [
    'an environment of a wrong length',
    (s) => ((s.environment as { data: Float32Array }).data = new Float32Array(5)),
    'scene/length',
    /environment/,
  ],
  [
    'an environment of negative intensity',
    (s) => ((s.environment as { intensity?: number }).intensity = -1),
    'scene/value',
    /negative intensity, -1/,
  ],
  ['a negative sky', (s) => ((s.environment as { data: Float32Array }).data[3] = -1), 'scene/not-finite', /-1 at 3/],
];

const large = (triangles: number, vertices: number) => {
  const scene = createScene();
  scene.meshes.push({
    name: 'large',
    positions: Float32Array.from({ length: 3 * vertices }, (_, i) => Math.sin(i * 12.9898) * 10),
    normals: new Float32Array(3 * vertices).fill(0.577),
    indices: Uint32Array.from({ length: 3 * triangles }, (_, i) => (i * 7919) % vertices),
  });
  scene.materials.push(defaultMaterial());
  scene.instances.push({ name: 'part', mesh: 0, material: 0, transform: identity });
  return scene;
};

describe('validateScene', () => {
  test('a valid scene passes without a warning', () => expect(validateScene(whole())).toEqual([]));

  test('cameras at the ends of their ranges pass', () => {
    const scene = whole();
    Object.assign(scene.cameras[0]!, {
      transform: identity.with(12, 1e12),
      yfov: 3.14159,
      aspect: 1e-3,
      lens_radius: 0,
      focus_distance: 1e-6,
      lens_blades: 0,
      lens_rotation: -7,
    });
    Object.assign(scene.cameras[1]!, { xmag: 1e-6, ymag: 1e12 });
    scene.cameras.push({ type: 'panorama', name: 'p', transform: identity });
    expect(validateScene(scene)).toEqual([]);
  });

  test.each(faults)('%s', (_, spoil, code, message) => {
    const scene = whole();
    spoil(scene);
    let caught: unknown;
    try {
      validateScene(scene);
    } catch (error) {
      caught = error;
    }
    expect(caught).toBeInstanceOf(SceneError);
    expect((caught as SceneError).code).toBe(code);
    expect((caught as SceneError).message).toMatch(message);
    expect((caught as SceneError).message).not.toContain('\n');
    expect(() => checkScene(scene)).toThrow(caught as SceneError);
  });

  test('wherever a number is not finite, it is found', () => {
    for (const vertices of [3, 4])
      for (let i = 0; i < 3 * vertices; i++) {
        const scene = createScene();
        const positions = new Float32Array(3 * vertices);
        scene.meshes.push({ name: 'one', positions, indices: new Uint32Array([0, 1, 2]) });
        expect(() => checkScene(scene)).not.toThrow();
        positions[i] = i % 2 === 0 ? NaN : Infinity;
        expect(() => checkScene(scene)).toThrow(`positions holds ${positions[i]} at ${i};`);
      }
  });

  test('suspicious parts are not looked for where scenes are only checked', async () => {
    const scene = large(20_000, 10_000);
    const check = (await counter.measure(() => checkScene(scene))).operations;
    const validation = (await counter.measure(() => validateScene(scene))).operations;
    expect(check).toBeLessThan(0.7 * validation);
  });

  test('triangles with equal corners are reported, not refused', () => {
    const scene = whole();
    scene.meshes[0]!.indices = new Uint32Array([0, 1, 2, 1, 1, 2]);
    expect(validateScene(scene)).toMatchObject([
      { code: 'scene/degenerate', path: '/meshes/0', message: expect.stringContaining('1 triangle without') },
    ]);
  });

  test('so are triangles whose corners lie on a line', () => {
    const scene = whole();
    scene.meshes[0]!.positions = new Float32Array([1, 2, 3, 2, 4, 6, 4, 8, 12]);
    expect(validateScene(scene)).toMatchObject([{ code: 'scene/degenerate' }]);
    scene.meshes[0]!.positions = new Float32Array([1e-8, 0, 0, 0, 1e-8, 0, 0, 0, 1e-8]);
    expect(validateScene(scene)).toEqual([]);
  });

  test('a flattened instance is reported, a mirrored and sheared one is not', () => {
    const scene = whole();
    scene.instances[0]!.transform = identity.with(5, 0);
    expect(validateScene(scene)).toMatchObject([{ code: 'scene/flattened', path: '/instances/0' }]);
    scene.instances[0]!.transform = identity.with(5, -2).with(4, 0.5).with(0, 1e-6);
    expect(validateScene(scene)).toEqual([]);
  });

  test('a texture whose UV set the mesh lacks is reported', () => {
    const scene = whole();
    scene.materials[0]!.textures!.base_color!.uv = 1;
    expect(validateScene(scene)).toMatchObject([{ code: 'scene/missing-uv', path: '/instances/0' }]);
  });

  test('the cost is a few operations per triangle', async () => {
    const cost = async (triangles: number) =>
      (await counter.measure(() => validateScene(large(triangles, triangles / 2)))).operations / triangles;
    const [some, twice] = [await cost(10_000), await cost(20_000)];
    expect(some).toBeGreaterThan(1);
    expect(some).toBeLessThan(10);
    expect(twice).toBeLessThan(1.05 * some);
  });

  test('the last triangle of a million is validated', () => {
    const [triangles, vertices] = [1_000_000, 500_000];
    const scene = large(triangles, vertices);
    expect(validateScene(scene)).toEqual([]);
    scene.meshes[0]!.indices[3 * triangles - 1] = vertices;
    expect(() => validateScene(scene)).toThrow('triangle 999999 refers to vertex 500000; the mesh has 500000.');
  });

  test('a negative constant environment', () => {
    const scene = whole();
    scene.environment = { type: 'constant', radiance: [1, -1, 0] };
    expect(() => validateScene(scene)).toThrow(SceneError);
  });
});

test('in steps: many for a large mesh, with the same findings and faults', () => {
  const scene = whole();
  const count = 500_000;
  // Every tenth triangle is flat.
  const positions = Float32Array.from({ length: 9 * count }, (_, i) =>
    Math.floor(i / 9) % 10 === 0 ? 0 : Math.sin(i),
  );
  scene.meshes.push({ name: 'large', positions, indices: new Uint32Array(3 * count).map((_, i) => i) });
  const run = () => {
    const steps = validationSteps(scene);
    for (let n = 0; ; n++) {
      const step = steps.next();
      if (step.done) return { n, warnings: step.value };
    }
  };
  const { n, warnings } = run();
  expect(n).toBeGreaterThan((12 * count) / 2 ** 18);
  expect(warnings).toEqual(validateScene(scene));
  expect(
    warnings.some(({ code, message }) => code === 'scene/degenerate' && message.includes(` ${count / 10} triangles`)),
  ).toBe(true);
  positions[positions.length - 1] = NaN;
  expect(run).toThrow(SceneError);
});
