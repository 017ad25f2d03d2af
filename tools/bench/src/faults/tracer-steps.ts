import { createHash } from 'node:crypto';
import { PathTracer, type FilmLayer, type FilmState } from '@glanz/renderer';
import { createScene, type Mesh, type Scene } from '@glanz/scene';

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A grid of n × n quads in the xy plane. */
function grid(name: string, n: number, half: number, z: number): Mesh {
  const side = n + 1;
  const positions = Float32Array.from(
    { length: 3 * side * side },
    (_, i) =>
      [
        ((Math.floor(i / 3) % side) / n) * 2 * half - half,
        (Math.floor(Math.floor(i / 3) / side) / n) * 2 * half - half,
        z,
      ][i % 3]!,
  );
  const uvs = Float32Array.from(
    { length: 2 * side * side },
    (_, i) => [(Math.floor(i / 2) % side) / n, Math.floor(Math.floor(i / 2) / side) / n][i % 2]!,
  );
  const faces = Array.from({ length: n * n }, (_, i) => {
    const a = Math.floor(i / n) * side + (i % n);
    return [a, a + 1, a + side + 1, a, a + side + 1, a + side];
  }).flat();
  return { name, positions, uvs: [uvs], indices: Uint32Array.from(faces) };
}

/** A small scene with something of everything that edits touch: textures, lights in groups, variants, hidden parts. */
export function faultScene(): Scene {
  const scene = createScene();
  scene.images.push({
    name: 'checks',
    width: 4,
    height: 4,
    data: Uint8ClampedArray.from({ length: 64 }, (_, i) =>
      i % 4 === 3 ? 255 : (((i >> 2) % 4) ^ (i >> 4)) & 1 ? 220 : 60,
    ),
  });
  scene.textures.push({ image: 0, color_space: 'srgb' });
  scene.materials.push(
    {
      name: 'floor',
      parameters: { base_color: [0.6, 0.6, 0.6] },
      textures: { base_color: { texture: 0, channels: 'rgb' } },
    },
    { name: 'paint', parameters: { base_color: [0.8, 0.1, 0.1], specular_roughness: 0.3 } },
    { name: 'steel', parameters: { base_metalness: 1, base_color: [0.7, 0.7, 0.7], specular_roughness: 0.2 } },
  );
  scene.meshes.push(grid('floor', 2, 1.5, -0.4), grid('part', 3, 0.5, 0), grid('extra', 2, 0.2, 0.3));
  scene.variants = ['bare'];
  scene.instances.push(
    { name: 'floor', mesh: 0, material: 0, transform: IDENTITY },
    { name: 'part', mesh: 1, material: 1, transform: IDENTITY, variants: { 0: 2 } },
    { name: 'extra', mesh: 2, material: 2, transform: IDENTITY, visible: false },
  );
  scene.lights.push({
    type: 'directional',
    name: 'key',
    light_group: 'key',
    color: [1, 0.9, 0.8],
    intensity: 2,
    direction: [0.5, -0.3, -0.8],
  });
  scene.environment = { type: 'constant', radiance: [0.4, 0.5, 0.6] };
  scene.cameras.push({
    type: 'perspective',
    name: 'front',
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 3, 1],
    yfov: 0.7,
  });
  return scene;
}

/** Pixels of an edge of the images. */
export const SIZE = 12;

/** One kind of work that a tracer is asked for, from its creation on. */
export interface Step {
  readonly name: string;
  /** Brings the tracer into the state that the step begins with. No fault is injected. */
  readonly before?: (tracer: PathTracer) => unknown;
  /** The call under test. What it resolves with, if anything, is compared. */
  readonly act: (tracer: PathTracer) => unknown;
}

const latlong = {
  type: 'latlong',
  width: 8,
  height: 4,
  data: Float32Array.from({ length: 96 }, (_, i) => 0.2 + ((i * 7) % 11) / 10),
} as const;
const camera = (x: number, extra: object = {}) =>
  ({
    type: 'perspective',
    name: 'moved',
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 3, 1],
    yfov: 0.7,
    ...extra,
  }) as Parameters<PathTracer['setCamera']>[0];
const LAYERS: readonly FilmLayer[] = ['variance', 'albedo', 'normal', 'position', 'depth', 'objectId', 'materialId'];

export const STEPS: readonly Step[] = [
  { name: 'create', act: () => undefined },
  ...LAYERS.map((layer): Step => ({ name: `read ${layer}`, before: (t) => render(t, 2), act: (t) => t.read(layer) })),
  { name: 'readLightGroup', before: (t) => render(t, 2), act: (t) => t.readLightGroup('key') },
  { name: 'readRayCount', before: (t) => render(t, 2), act: (t) => t.readRayCount() },
  { name: 'render to a noise target', act: (t) => render(t, 48, 0.05) },
  { name: 'setCamera', act: (t) => t.setCamera(camera(0.2)) },
  { name: 'setCamera with a lens', act: (t) => t.setCamera(camera(0.2, { lens_radius: 0.05, focus_distance: 3 })) },
  { name: 'setMaterial', act: (t) => t.setMaterial('paint', { base_color: [0.1, 0.7, 0.2] }) },
  { name: 'setMaterial with a new lobe', act: (t) => t.setMaterial('paint', { coat_weight: 1 }) },
  { name: 'setMaterial that begins to emit', act: (t) => t.setMaterial('paint', { emission_luminance: 2 }) },
  { name: 'setLight', act: (t) => t.setLight('key', { intensity: 1 }) },
  { name: 'setEnvironment', act: (t) => t.setEnvironment(latlong as Parameters<PathTracer['setEnvironment']>[0]) },
  {
    name: 'adjustEnvironment',
    before: (t) => t.setEnvironment(latlong as Parameters<PathTracer['setEnvironment']>[0]),
    act: (t) => t.adjustEnvironment({ rotation: 1 }),
  },
  {
    name: 'setInstanceTransform',
    act: (t) => t.setInstanceTransform('part', [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.2, 0.1, 0.1, 1]),
  },
  { name: 'setVisibility off', act: (t) => t.setVisibility('part', false) },
  { name: 'setVisibility of a new mesh', act: (t) => t.setVisibility('extra', true) },
  { name: 'setCatcher', act: (t) => t.setCatcher('floor', true) },
  { name: 'setInstanceMaterial', act: (t) => t.setInstanceMaterial('part', 'steel') },
  { name: 'setVariant', act: (t) => t.setVariant('bare') },
  { name: 'replaceMesh by a smaller one', act: (t) => t.replaceMesh('part', grid('part', 2, 0.4, 0.1)) },
  { name: 'replaceMesh by a larger one', act: (t) => t.replaceMesh('part', grid('part', 12, 0.6, 0.1)) },
  { name: 'setDepth', act: (t) => t.setDepth(3) },
  { name: 'setBackground', act: (t) => t.setBackground('transparent') },
  { name: 'setLightGroup', before: (t) => render(t, 2), act: (t) => t.setLightGroup('key', { intensity: 0.5 }) },
  { name: 'resize', act: (t) => t.resize(SIZE + 4, SIZE - 2) },
  { name: 'saveFilm', before: (t) => render(t, 1), act: async (t) => (await t.saveFilm()).sums.film_total },
  {
    name: 'restoreFilm',
    before: async (t) => {
      await render(t, 1);
      films.set(t, await t.saveFilm());
      t.reset();
    },
    act: (t) => t.restoreFilm(films.get(t) as FilmState),
  },
];

/** Films that a step saved for the call under test. */
const films = new WeakMap<PathTracer, FilmState>();

/** Adds samples until there are so many. */
export async function render(tracer: PathTracer, samples: number, noise?: number): Promise<void> {
  for await (const progress of tracer.render({ samples, maxSubmitMs: 1000, ...(noise === undefined ? {} : { noise }) }))
    void progress;
}

/** A name for data that differs where a bit differs. */
export function digest(value: unknown): string | undefined {
  if (value === undefined) return undefined;
  const hash = createHash('sha256');
  if (ArrayBuffer.isView(value)) hash.update(new Uint8Array(value.buffer, value.byteOffset, value.byteLength));
  else hash.update(JSON.stringify(value));
  return hash.digest('base64url').slice(0, 16);
}

/** The image that the tracer shows with two samples. */
export async function look(tracer: PathTracer): Promise<string | undefined> {
  await render(tracer, 2);
  return digest(await tracer.read('beauty'));
}

/** A tracer of {@link faultScene}. */
export const createTracer = (device: GPUDevice): Promise<PathTracer> =>
  PathTracer.create(device, faultScene(), {
    width: SIZE,
    height: SIZE,
    maxDepth: 4,
    pathsInFlight: 1024,
    background: 'environment',
  });
