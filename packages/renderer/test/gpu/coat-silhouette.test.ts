import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Material, Mesh, PerspectiveCamera, TextureBinding } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { addQuad, addSphere, camera, createScene } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const SIZE = 96;
const IOR = 1.6;
/** A black base: only the coat is seen. */
const COAT = { base_weight: 0, specular_weight: 0, coat_weight: 1, coat_roughness: 0.02, coat_ior: IOR } as const;

/** A sphere of 12 segments with smooth normals in a white furnace, whose maps tilt normals by up to 30 degrees. */
async function furnace(maps: readonly ('geometry_normal' | 'geometry_coat_normal')[]) {
  const scene = createScene();
  const binding: TextureBinding = { texture: 0, channels: 'rgb' };
  addSphere(
    scene,
    0.8,
    [0, 0, 0],
    { name: 'coat', parameters: COAT, textures: Object.fromEntries(maps.map((name) => [name, binding])) },
    12,
  );
  const mesh = scene.meshes[0] as Mesh;
  mesh.uvs = [
    Float32Array.from({ length: (mesh.positions.length / 3) * 2 }, (_, i) => {
      const [x, y, z] = mesh.positions.subarray(3 * (i >> 1));
      return i % 2 === 0 ? (2 * Math.atan2(z!, x!)) / Math.PI : y!;
    }),
  ];
  const [n, bumps] = [32, new Float32Array(32 * 32 * 4)];
  for (let i = 0; i < n * n; i++) {
    const [a, b] = [
      0.35 * Math.sin(((i % n) * 4 * Math.PI) / n),
      0.35 * Math.sin((Math.floor(i / n) * 4 * Math.PI) / n),
    ];
    bumps.set([0.5 + a / 2, 0.5 + b / 2, 0.5 + Math.sqrt(1 - a * a - b * b) / 2, 1], 4 * i);
  }
  scene.images.push({ name: 'bumps', width: n, height: n, data: bumps });
  scene.textures.push({ image: 0, color_space: 'linear' });
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera, maxDepth: 4 });
  for await (const _ of tracer.render({ samples: 8 }));
  const [beauty, albedo] = [await tracer.read('beauty'), await tracer.read('albedo')];
  tracer.destroy();
  const covered = [...Array(SIZE * SIZE).keys()].filter(
    (i) => beauty[4 * i + 3]! > 0.999 && albedo[4 * i + 3]! > 0.999,
  );
  const radius = (i: number) => Math.hypot((i % SIZE) + 0.5 - SIZE / 2, Math.floor(i / SIZE) + 0.5 - SIZE / 2) / SIZE;
  const mean = (pixels: readonly number[]) => pixels.reduce((sum, i) => sum + beauty[4 * i + 1]!, 0) / pixels.length;
  return {
    darkest: Math.min(...covered.map((i) => beauty[4 * i + 1]!)),
    center: mean(covered.filter((i) => radius(i) < 0.15)),
    rim: mean(covered.filter((i) => radius(i) > 0.38)),
  };
}

describe('a coat whose normal is not that of its base, in a white furnace', () => {
  it.each([[['geometry_coat_normal']], [['geometry_normal']]] as const)(
    '%s by a map: no pixel is darker than Fresnel allows, and the rim is bright',
    async (maps) => {
      const { darkest, center, rim } = await furnace(maps);
      // An interface reflects least along its normal.
      expect(darkest).toBeGreaterThan(0.99 * ((IOR - 1) / (IOR + 1)) ** 2);
      expect(rim).toBeGreaterThan(3 * center);
    },
  );
});

it('the albedo layer sees a tilted coat from the side where the camera is', async () => {
  const seen = async (x: number, tilt: number) => {
    const scene = createScene();
    const material: Material = {
      name: 'coat',
      parameters: { ...COAT, geometry_coat_normal: [tilt, 0, Math.sqrt(1 - tilt * tilt)] },
    };
    addQuad(scene, 1, 0, material);
    // 60 degrees off the quad's normal, looking at its middle.
    const [s, c] = [Math.sin((x * Math.PI) / 3), Math.cos(Math.PI / 3)];
    const view: PerspectiveCamera = {
      ...camera,
      yfov: 0.1,
      transform: [c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, 3 * s, 0, 3 * c, 1],
    };
    const tracer = await PathTracer.create(device, scene, { width: 8, height: 8, camera: view, maxDepth: 1 });
    for await (const _ of tracer.render({ samples: 1 }));
    const albedo = await tracer.read('albedo');
    tracer.destroy();
    // The mean over pixels: it depends on their sample's place in them by less than 0.001.
    return albedo.reduce((sum, value, i) => (i % 4 === 0 ? sum + value / 64 : sum), 0);
  };
  const [towards, away] = [await seen(1, 0.3), await seen(1, -0.3)];
  expect(away).toBeGreaterThan(2 * towards);
  // The same in a mirror.
  expect(await seen(-1, -0.3)).toBeCloseTo(towards, 2);
  expect(await seen(-1, 0.3)).toBeCloseTo(away, 2);
});
