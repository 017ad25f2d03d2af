import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Camera } from '@glanz/scene';
import { afterEach, beforeAll, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const SIZE = 24;
const options: PathTracerOptions = {
  width: SIZE,
  height: SIZE,
  camera,
  maxDepth: 1,
  aovs: ['motion', 'position', 'objectId'],
};
const still = camera.transform as readonly number[];
const moved = (x: number, y: number, z: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1];

function scene() {
  const stage = createScene();
  addQuad(stage, 0.8, 0, lambert(0.5));
  addSphere(stage, 0.4, [0.2, 0.1, 0.3], lambert(0.8));
  stage.environment = { type: 'constant', radiance: [1, 1, 1] };
  return stage;
}

async function sampled(tracer: PathTracer, samples = 64) {
  for await (const _ of tracer.render({ samples }));
  return {
    motion: await tracer.read('motion'),
    position: await tracer.read('position'),
    ids: await tracer.read('objectId'),
  };
}

/** Pixels of a perspective camera that looks along −z, for a place in the world. */
function project(
  { transform, yfov }: { readonly transform: readonly number[]; readonly yfov: number },
  p: readonly number[],
) {
  const depth = transform[14]! - p[2]!;
  const scale = SIZE / 2 / (Math.tan(yfov / 2) * depth);
  return [SIZE / 2 + scale * (p[0]! - transform[12]!), SIZE / 2 - scale * (p[1]! - transform[13]!)] as const;
}

it('leads to where surfaces were: moves of the camera and of instances, added up over frames that were not seen', async () => {
  const tracer = await PathTracer.create(device, scene(), options);
  const first = await sampled(tracer, 4);
  expect(first.motion.every((value) => value === 0)).toBe(true);
  expect(tracer.history).toBeUndefined();
  const there: Camera = { ...camera, transform: moved(0.2, -0.1, 2.8) } as Camera;
  await tracer.setInstanceTransform(1, moved(-0.1, 0, 0));
  await tracer.setCamera(there);
  await tracer.setInstanceTransform(1, moved(-0.3, 0.1, 0.05));
  expect(tracer.history).toMatchObject({ width: SIZE, height: SIZE, samples: 4 });
  const { motion, position, ids } = await sampled(tracer);
  const views = [camera, there] as unknown as Parameters<typeof project>[0][];
  const seen = [0, 0];
  for (let i = 0; i < SIZE * SIZE; i++) {
    const id = ids[i] as number;
    const around = [i - SIZE - 1, i - SIZE, i - SIZE + 1, i - 1, i + 1, i + SIZE - 1, i + SIZE, i + SIZE + 1];
    if (id > 1) {
      expect([motion[2 * i], motion[2 * i + 1]]).toEqual([0, 0]);
      continue;
    }
    // Inside of a surface, the mean position is that of the pixel's centre to a fraction of a pixel.
    if (around.some((j) => ids[j] !== id)) continue;
    seen[id]!++;
    const now = [0, 1, 2].map((k) => position[4 * i + k]!);
    const before = id === 1 ? [now[0]! + 0.3, now[1]! - 0.1, now[2]! - 0.05] : now;
    const [x, y] = project(views[1]!, now);
    const [u, v] = project(views[0]!, before);
    // Motions are up to 4 pixels here, and change by up to a tenth of a pixel from one pixel to the next.
    expect(Math.abs(motion[2 * i]! - (u - x))).toBeLessThan(0.05);
    expect(Math.abs(motion[2 * i + 1]! - (v - y))).toBeLessThan(0.05);
  }
  expect(seen[0]).toBeGreaterThan(50);
  expect(seen[1]).toBeGreaterThan(20);
  // The same view again: nothing has moved since.
  tracer.reset();
  expect((await sampled(tracer, 1)).motion.every((value) => Math.abs(value) < 1e-4)).toBe(true);
  expect(tracer.history).toMatchObject({ camera: there, samples: 64 });
  tracer.destroy();
});

it('goes on over changes of the render scale, and ends with edits of what is seen', async () => {
  const tracer = await PathTracer.create(device, scene(), options);
  tracer.setRenderScale(0.5);
  await sampled(tracer, 2);
  await tracer.setCamera({ ...camera, transform: moved(0.3, 0, 3) } as Camera);
  tracer.setRenderScale(1);
  expect(tracer.history).toEqual({
    camera: expect.objectContaining({ transform: still }) as Camera,
    width: 12,
    height: 12,
    samples: 2,
  });
  const { motion, ids } = await sampled(tracer);
  const centre = (SIZE / 2) * SIZE + 4;
  expect(ids[centre]).toBe(0);
  // The wall is 3 away, and 2 wide there: 0.3 of it, in pixels of the whole image.
  expect(Math.abs(motion[2 * centre]! - (0.3 / 2) * SIZE)).toBeLessThan(0.01);
  await tracer.setMaterial(0, { base_color: [1, 0, 0] });
  expect(tracer.history).toBeUndefined();
  expect((await sampled(tracer, 1)).motion.every((value) => value === 0)).toBe(true);
  await tracer.resize(20, 20);
  expect(tracer.history).toBeUndefined();
  tracer.destroy();
});

it('comes with setAovs too, and takes all that have moved', async () => {
  const stage = createScene();
  addQuad(stage, 3, 0, lambert(0.5));
  for (let i = 1; i < 8; i++)
    stage.instances.push({ ...stage.instances[0]!, name: `copy ${i}`, transform: moved(0, 0, -i) });
  const tracer = await PathTracer.create(device, stage, { ...options, aovs: [] });
  await sampled(tracer, 1);
  // From behind everything to the front, in any order: more than the buffer has at first.
  // Neighbours move to opposite sides, so that the move of another copy leads elsewhere.
  const aside = (i: number) => (i % 2 === 1 ? 0.1 : -0.1) * i;
  for (const i of [5, 1, 7, 3, 2, 4, 6]) await tracer.setInstanceTransform(i, moved(aside(i), 0, 0.1 * i));
  const { motion, ids } = await sampled(tracer);
  const centre = (SIZE / 2) * SIZE + SIZE / 2;
  expect(ids[centre]).toBe(7);
  const views = { transform: still, yfov: (camera as unknown as { yfov: number }).yfov };
  // What is seen by the ray through the pixel's centre, 2.3 away now, was 10 away. Of 64 Sobol points one lies in each
  // cell of 8 × 8, so the one nearest to the centre is at most √2/8 of a pixel off; where the copy was seen moves by
  // 2.3/10 of that.
  const half = (0.5 * 2.3) / (SIZE / 2 / Math.tan(views.yfov / 2));
  const [x, y] = project(views, [half - 0.7, -half, -7]);
  const [nowX, nowY] = project(views, [half, -half, 0.7]);
  expect(nowX).toBeCloseTo(SIZE / 2 + 0.5, 6);
  const off = Math.hypot(motion[2 * centre]! - (x - nowX), motion[2 * centre + 1]! - (y - nowY));
  expect(off).toBeLessThan((1 - 2.3 / 10) * (Math.SQRT2 / 8) + 1e-4);
  tracer.destroy();
});
