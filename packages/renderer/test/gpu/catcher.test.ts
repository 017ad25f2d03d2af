import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Material, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { samplesOf } from '../full';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

const SIZE = 16;
const options: PathTracerOptions = { width: SIZE, height: SIZE, camera, maxDepth: 4, pathsInFlight: 1 << 14 };
const SKY = [0.4, 0.6, 0.9] as const;

/** A ball on a floor under a glowing panel and a sky; floor and ball may be left out, the floor may be a catcher. */
function scene({
  ball = true,
  catcher = false,
  floor = lambert(0.6, 0.5, 0.4),
}: { ball?: boolean; catcher?: boolean; floor?: Material } = {}): Scene {
  const made = createScene();
  // Larger than the image to the left, so that the right shows what is beyond it.
  addQuad(made, 2, 0, floor, { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1.4, 0, 0, 1] });
  addQuad(
    made,
    0.4,
    1.5,
    { name: 'glow', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 3 } },
    { flip: true, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1.2, 0.8, 0, 1] },
  );
  addSphere(
    made,
    0.3,
    [-0.1, -0.1, 0.4],
    { name: 'ball', parameters: { base_color: [0.9, 0.1, 0.1], specular_roughness: 0.3 } },
    16,
  );
  Object.assign(made.instances[0] as object, { catcher });
  Object.assign(made.instances[2] as object, { visible: ball });
  made.environment = { type: 'constant', radiance: SKY };
  return made;
}

async function render(made: Scene, extra: Partial<PathTracerOptions> & { samples?: number } = {}): Promise<PathTracer> {
  const tracer = await PathTracer.create(device, made, { ...options, ...extra });
  for await (const _ of tracer.render({ samples: extra.samples ?? samplesOf(32, 4), maxSubmitMs: 1000 }));
  return tracer;
}
async function image(
  made: Scene,
  extra: Partial<PathTracerOptions> & { samples?: number } = {},
): Promise<Float32Array> {
  const tracer = await render(made, extra);
  const pixels = await tracer.read('beauty');
  tracer.destroy();
  return pixels;
}
const largest = (a: Float32Array, b: Float32Array) =>
  a.reduce((max, value, i) => Math.max(max, Math.abs(value - (b[i] as number))), 0);
const luminance = (r: number, g: number, b: number) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** For each pixel whether all of it is floor, ball, or nothing: found by alpha and ids of ordinary images. */
async function classes(): Promise<('floor' | 'ball' | 'sky' | 'edge')[]> {
  const bare = await image(scene({ ball: false }), { background: 'transparent' });
  const withBall = await render(scene(), { background: 'transparent' });
  const [pixels, position] = [await withBall.read('beauty'), await withBall.read('position')];
  withBall.destroy();
  return Array.from({ length: SIZE * SIZE }, (_, i) => {
    if (pixels[4 * i + 3] === 0) return 'sky';
    if (bare[4 * i + 3] !== 1 && pixels[4 * i + 3] !== 1) return 'edge';
    const [x, y, z] = [position[4 * i] as number, position[4 * i + 1] as number, position[4 * i + 2] as number];
    // The ball's silhouette is seen from (0, 0, 3).
    if (z < 1e-6) return 'floor';
    return Math.hypot(x + 0.1, y + 0.1) < 0.2 ? 'ball' : 'edge';
  });
}

describe('catchers', () => {
  it.each([
    ['a matte floor', lambert(0.6, 0.5, 0.4), 0.002],
    [
      'a glossy floor',
      {
        name: 'gloss',
        parameters: { base_metalness: 1, base_color: [0.9, 0.9, 0.9], specular_roughness: 0.35 },
      } satisfies Material,
      0.01,
    ],
  ])('%s: what two renders, with and without the object, say', async (_, floor, min) => {
    const found = await image(scene({ catcher: true, floor }), { background: 'transparent' });
    const over = await image(scene({ catcher: true, floor }));
    const kept = await image(scene({ floor }));
    const bare = await image(scene({ ball: false, floor }));
    const kinds = await classes();
    const counts = { floor: 0, ball: 0, sky: 0, edge: 0 };
    let shadowed = 0;
    let added = 0;
    kinds.forEach((kind, i) => {
      counts[kind]++;
      const rgb = (pixels: Float32Array) => Array.from(pixels.subarray(4 * i, 4 * i + 3)) as [number, number, number];
      const [f, o, w, b] = [rgb(found), rgb(over), rgb(kept), rgb(bare)];
      const alpha = found[4 * i + 3] as number;
      if (kind === 'sky') {
        expect([...f, alpha]).toEqual([0, 0, 0, 0]);
        for (let c = 0; c < 3; c++) expect(o[c]).toBeCloseTo(SKY[c] as number, 5);
      } else if (kind === 'ball') {
        expect(alpha).toBeCloseTo(1, 5);
        for (let c = 0; c < 3; c++) expect(f[c]).toBeCloseTo(w[c] as number, 5);
      } else if (kind === 'floor') {
        const shadow =
          1 -
          luminance(...(w.map((v, c) => Math.min(v, b[c] as number)) as [number, number, number])) / luminance(...b);
        expect(alpha).toBeCloseTo(shadow, 4);
        for (let c = 0; c < 3; c++) {
          const more = Math.max((w[c] as number) - (b[c] as number), 0);
          expect(f[c]).toBeCloseTo(more, 4);
          expect(o[c]).toBeCloseTo(
            more + ((SKY[c] as number) * Math.min(w[c] as number, b[c] as number)) / (b[c] as number),
            4,
          );
          added += more;
        }
        shadowed += shadow;
      }
      // Nothing is brighter than it could be, or less than nothing.
      expect(alpha).toBeGreaterThanOrEqual(0);
      expect(alpha).toBeLessThanOrEqual(1.00001);
    });
    expect(counts.floor).toBeGreaterThan(80);
    expect(counts.ball).toBeGreaterThan(5);
    expect(counts.sky).toBeGreaterThan(10);
    expect(shadowed).toBeGreaterThan(1);
    expect(added).toBeGreaterThan(min);
  });

  it('the same image whatever the batches, and relit without a sample', async () => {
    const one = await render(scene({ catcher: true }), { samples: 40, lightGroups: 'each' });
    const two = await render(scene({ catcher: true }), { samples: 40, lightGroups: 'each', pathsInFlight: 100 });
    expect(largest(await one.read('beauty'), await two.read('beauty'))).toBe(0);
    const before = await one.read('beauty');
    await one.setLightGroup('glow', { intensity: 0 });
    expect(largest(await one.read('beauty'), before)).toBeGreaterThan(0.01);
    await one.setLightGroup('glow', { intensity: 1 });
    expect(largest(await one.read('beauty'), before)).toBe(0);
    await expect(one.readLightGroup('glow')).rejects.toMatchObject({ code: 'renderer/light-groups' });
    const variance = await one.read('variance');
    expect(variance.every((value) => value >= 0 && value < Infinity)).toBe(true);
    one.destroy();
    two.destroy();
  });

  it('a floor becomes a catcher and a floor again on a live tracer', async () => {
    const tracer = await render(scene(), { samples: 8 });
    const plain = await tracer.read('beauty');
    await tracer.setCatcher(0, true);
    for await (const _ of tracer.render({ samples: 32, maxSubmitMs: 1000 }));
    expect(largest(await tracer.read('beauty'), await image(scene({ catcher: true }), { samples: 32 }))).toBeLessThan(
      1e-5,
    );
    await tracer.setInstanceTransform('sphere', [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.4, 0.2, 0, 1]);
    for await (const _ of tracer.render({ samples: 32, maxSubmitMs: 1000 }));
    const moved = scene({ catcher: true });
    Object.assign(moved.instances[2] as object, { transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.4, 0.2, 0, 1] });
    expect(largest(await tracer.read('beauty'), await image(moved, { samples: 32 }))).toBeLessThan(1e-5);
    await tracer.setInstanceTransform('sphere', scene().instances[2]?.transform as number[]);
    await tracer.setCatcher(0, false);
    for await (const _ of tracer.render({ samples: 8, maxSubmitMs: 1000 }));
    expect(largest(await tracer.read('beauty'), plain)).toBeLessThan(1e-5);
    tracer.destroy();
  });
});
