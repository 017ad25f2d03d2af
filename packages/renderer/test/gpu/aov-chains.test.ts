import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Material, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type AovName, type PathTracerOptions } from '../../src/index';
import { readAov } from '../aovs';
import { addBox, addQuad, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  // Many programs, few pixels.
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

const SIZE = 16;
const ALL: readonly AovName[] = ['albedo', 'coverage', 'normal', 'depth', 'virtualDepth', 'position', 'roughness'];
const WALL = [0.25, 0.5, 0.75] as const;

async function layers(scene: Scene, more: Partial<PathTracerOptions> = {}) {
  const tracer = await PathTracer.create(device, scene, {
    width: SIZE,
    height: SIZE,
    camera,
    maxDepth: 8,
    aovs: ALL,
    ...more,
  });
  for await (const _ of tracer.render({ samples: 64, maxSubmitMs: 1000 }));
  const found = {} as Record<AovName, Float32Array>;
  for (const name of ALL) found[name] = await readAov(device, tracer, name);
  tracer.destroy();
  return found;
}

/** Mean of channel `c` of `channels` over the image. */
const mean = (data: Float32Array, channels: number, c = 0) =>
  data.reduce((sum, value, i) => (i % channels === c ? sum + (value * channels) / data.length : sum), 0);

const S = Math.SQRT1_2;
/** About y by 45°: a quad then faces (1, 0, 1) / √2. */
const TILTED = [S, 0, -S, 0, 0, 1, 0, 0, S, 0, S, 0, 0, 0, 0, 1];
/** Faces −x from x = 3. */
const ASIDE = [0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 3, 0, 0, 1];

const mirror = (roughness: number, parameters: Material['parameters'] = {}): Material => ({
  name: 'mirror',
  parameters: { base_color: [1, 1, 1], base_metalness: 1, specular_roughness: roughness, ...parameters },
});

/** A mirror that fills the view and shows a wall that stands beside the camera. */
function mirrored(surface: Material): Scene {
  const scene = createScene();
  addQuad(scene, 3, 0, surface, { transform: TILTED });
  addQuad(scene, 20, 0, lambert(...WALL), { transform: ASIDE });
  return scene;
}

/** What rays through 8 × 8 points of a pixel meet: lengths to the mirror and on to the wall, and where the mirror is. */
function traced(x: number, y: number) {
  const sums = { depth: 0, virtual: 0, position: [0, 0, 0] };
  for (let i = 0; i < 64; i++) {
    const through = [
      (2 * (x + ((i % 8) + 0.5) / 8)) / SIZE - 1,
      1 - (2 * (y + (Math.floor(i / 8) + 0.5) / 8)) / SIZE,
    ].map((value) => value / 3) as [number, number];
    const length = Math.hypot(...through, 1);
    const [dx, dy, dz] = [through[0] / length, through[1] / length, -1 / length];
    // The mirror: x + z = 0, from (0, 0, 3).
    const depth = -3 / (dx + dz);
    const at = [depth * dx, depth * dy, 3 + depth * dz] as [number, number, number];
    // It swaps x and −z.
    const edge = (3 - at[0]) / -dz;
    sums.depth += depth / 64;
    sums.virtual += (depth + edge) / 64;
    at.forEach((value, k) => (sums.position[k]! += value / 64));
  }
  return sums;
}

describe('mirrors', () => {
  it('albedo and normal are of what they show, depth and position of themselves, and the virtual depth adds up', async () => {
    const found = await layers(mirrored(mirror(0)));
    let tails = 0;
    for (let y = 0; y < SIZE; y++) {
      for (let x = 0; x < SIZE; x++) {
        const i = y * SIZE + x;
        // A sample of 1 / 64 that shows the mirror itself: reflected so far out that its lobe was none of a mirror.
        if (Math.abs(found.albedo[3 * i]! - WALL[0]) > (0.5 * (1 - WALL[0])) / 64) {
          tails++;
          continue;
        }
        for (const c of [0, 1, 2]) {
          // White metal of α = 1e-4 reflects all; albedos have 16 bits.
          expect(Math.abs(found.albedo[3 * i + c]! - WALL[c]!)).toBeLessThan(1e-3);
          expect(Math.abs(found.normal[3 * i + c]! - [-1, 0, 0][c]!)).toBeLessThan(1e-4);
        }
        expect(found.coverage[i]).toBe(1);
        expect(found.roughness[i]).toBe(1);
        const expected = traced(x, y);
        // 64 stratified samples and 64 midpoints of functions that vary by less than 0.4 in a pixel agree to some 1e-3.
        expect(Math.abs(found.depth[i]! - expected.depth)).toBeLessThan(0.005);
        expect(Math.abs(found.virtualDepth[i]! - expected.virtual)).toBeLessThan(0.01);
        expected.position.forEach((value, k) =>
          expect(Math.abs(found.position[3 * i + k]! - value)).toBeLessThan(0.005),
        );
      }
    }
    // GGX of α has α² / (α² + t²) beyond a tangent t, and a density of 0.5 about where t² = α / √(2π): 2.5e-4 of 16384.
    expect(tails).toBeLessThan(16);
  });

  it('tint what they show, in a row too', async () => {
    // Looks into a second mirror, coloured, that shows the wall: (1, 0, 0) becomes (0, 0, 1).
    const scene = createScene();
    addQuad(scene, 3, 0, mirror(0), { transform: TILTED });
    addQuad(scene, 20, 0, mirror(0, { base_color: [0.5, 0.8, 1], specular_color: [1, 1, 1] }), {
      transform: [S, 0, S, 0, 0, 1, 0, 0, -S, 0, S, 0, 6, 0, 0, 1],
    });
    addQuad(scene, 40, 9, lambert(...WALL), { flip: true });
    const { albedo, normal } = await layers(scene);
    const centre = (SIZE / 2) * SIZE + SIZE / 2;
    for (const c of [0, 1, 2]) {
      // At 45° a metal reflects what it does straight on and at most a few percent of the rest.
      const tint = [0.5, 0.8, 1][c]!;
      expect(albedo[3 * centre + c]!).toBeGreaterThan(WALL[c]! * tint - 1e-3);
      expect(albedo[3 * centre + c]!).toBeLessThan(WALL[c]! * (tint + 0.05 * (1 - tint)) + 1e-3);
      expect(Math.abs(normal[3 * centre + c]! - [0, 0, -1][c]!)).toBeLessThan(1e-4);
    }
  });

  it.each([
    [0.1, true],
    [0.12, false],
    [0.5, false],
  ])('of roughness %d: followed is %s', async (roughness, follows) => {
    const { albedo, normal, depth, virtualDepth } = await layers(mirrored(mirror(roughness)));
    // A lobe of roughness 0.1 has 3 directions of 100 too far out to count.
    expect(Math.abs(mean(albedo, 3, 0) - (follows ? WALL[0] : 1))).toBeLessThan(follows ? 0.05 : 0.01);
    expect(Math.abs(mean(normal, 3, 0) - (follows ? -1 : S))).toBeLessThan(follows ? 0.1 : 1e-3);
    if (!follows) expect(virtualDepth).toEqual(depth);
  });

  it('show themselves where they show nothing', async () => {
    const scene = mirrored(mirror(0));
    scene.instances[1]!.visible = false;
    const { albedo, normal, depth, virtualDepth, roughness } = await layers(scene);
    expect(Math.abs(mean(albedo, 3, 1) - 1)).toBeLessThan(1e-3);
    expect(Math.abs(mean(normal, 3, 2) - S)).toBeLessThan(1e-4);
    expect(Math.max(...roughness)).toBeLessThan(0.02);
    expect(virtualDepth).toEqual(depth);
  });

  it('a smooth coat over a matt base is no mirror, nor is a path that ends at its first surface', async () => {
    const plastic: Material = { name: 'plastic', parameters: { base_color: [...WALL], specular_roughness: 0 } };
    const { albedo, normal } = await layers(mirrored(plastic));
    expect(Math.abs(mean(normal, 3, 2) - S)).toBeLessThan(1e-4);
    // What is below shines through the interface, which reflects 5 of 100 at 45°.
    expect(Math.abs(mean(albedo, 3, 0) - WALL[0])).toBeLessThan(0.05);
    const short = await layers(mirrored(mirror(0)), { maxDepth: 1 });
    expect(Math.abs(mean(short.normal, 3, 2) - S)).toBeLessThan(1e-4);
    expect(Math.abs(mean(short.albedo, 3, 0) - 1)).toBeLessThan(1e-3);
  });
});

describe('glass', () => {
  /** A pane before a wall that fills the view. */
  function pane(material: Material, solid: boolean): Scene {
    const scene = createScene();
    addQuad(scene, 4, -1, lambert(...WALL));
    if (solid) addBox(scene, [-2, -2, 0], [2, 2, 0.2], material);
    else addQuad(scene, 2, 0, material);
    return scene;
  }
  const clear: Material['parameters'] = { transmission_weight: 1, specular_roughness: 0, specular_ior: 1.5 };

  it.each([
    ['a solid pane', true, clear],
    ['a thin wall', false, { ...clear, geometry_thin_walled: true }],
  ] as const)('%s: what is behind, blended with what it reflects', async (_name, solid, parameters) => {
    const found = await layers(pane({ name: 'glass', parameters }, solid), { maxDepth: 16 });
    // Both faces of a pane: 2R / (1 + R) is reflected, with R = 0.04 straight on; at 18° it is the same to 1e-3. What is
    // reflected leaves the scene, so the glass itself counts there, as white.
    const reflected = 0.08 / 1.04;
    // Independent samples would have a standard error of 0.27 / √(64 · 256) = 0.0021 times 0.75; four of them.
    for (const c of [0, 1, 2])
      expect(Math.abs(mean(found.albedo, 3, c) - (WALL[c]! * (1 - reflected) + reflected))).toBeLessThan(0.0085);
    expect(Math.abs(mean(found.normal, 3, 2) - 1)).toBeLessThan(2e-3);
    const front = solid ? 2.8 : 3;
    const centre = (SIZE / 2) * SIZE + SIZE / 2;
    expect(Math.abs(found.depth[centre]! - front)).toBeLessThan(0.01);
    expect(Math.abs(found.position[3 * centre + 2]! - (3 - front))).toBeLessThan(1e-5);
    // On average between the way to the pane and that to the wall.
    expect(found.virtualDepth[centre]!).toBeGreaterThan(4 - reflected - 0.2);
    expect(found.virtualDepth[centre]!).toBeLessThan(4.01);
  });

  it('frosted glass shows itself', async () => {
    const frosted = { name: 'glass', parameters: { ...clear, specular_roughness: 0.4 } };
    const { albedo, virtualDepth, depth } = await layers(pane(frosted, true));
    expect(mean(albedo, 3, 0)).toBeGreaterThan(0.9);
    expect(virtualDepth).toEqual(depth);
  });

  it('dispersive glass is followed without colours of its own', async () => {
    const prism = { name: 'glass', parameters: { ...clear, transmission_dispersion_scale: 1 } };
    const { albedo } = await layers(pane(prism, true), { maxDepth: 16 });
    const reflected = 0.08 / 1.04;
    for (let i = 0; i < SIZE * SIZE; i++) {
      const share = [0, 1, 2].map((c) => (albedo[3 * i + c]! - WALL[c]!) / (1 - WALL[c]!));
      // Each sample shows either the wall or the glass: the share of glass is that of all channels, to 16 bits.
      for (const one of share) expect(Math.abs(one - share[0]!)).toBeLessThan(1e-3);
    }
    expect(Math.abs(mean(albedo, 3, 0) - (WALL[0] * (1 - reflected) + reflected))).toBeLessThan(0.012);
  });
});
