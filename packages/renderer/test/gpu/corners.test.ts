import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { casesOf } from '../full';
import { createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

/**
 * White walls around the camera, in a blinding environment: every path that slips out is seen. A prism of regular
 * polygons, so its walls meet at one angle; far from the origin, where the rounding of positions is a noticeable part
 * of the room.
 */
async function brightest(corners: number, far: number, samples: number): Promise<number> {
  const scene = createScene();
  const [positions, indices]: [number[], number[]] = [[], []];
  for (let i = 0; i < corners; i++) {
    const angle = (2 * Math.PI * (i + 0.3)) / corners;
    for (const y of [-0.5, 0.5]) positions.push(far + Math.cos(angle), far + y, far + Math.sin(angle));
  }
  for (let i = 0; i < corners; i++) {
    const [a, b] = [2 * i, 2 * ((i + 1) % corners)];
    indices.push(a, b, a + 1, b, b + 1, a + 1);
    if (i > 0 && i < corners - 1) indices.push(0, a, b, 1, b + 1, a + 1);
  }
  scene.meshes.push({ name: 'room', positions: Float32Array.from(positions), indices: Uint32Array.from(indices) });
  scene.materials.push(lambert(1));
  scene.instances.push({
    name: 'room',
    mesh: 0,
    material: 0,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  });
  scene.environment = { type: 'constant', radiance: [1e6, 1e6, 1e6] };
  const eye = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, far, far, far, 1] as const;
  const tracer = await PathTracer.create(device, scene, {
    width: 32,
    height: 32,
    camera: { type: 'panorama', name: 'eye', transform: [...eye] },
    maxDepth: 64,
  });
  for await (const progress of tracer.render({ samples })) void progress;
  const beauty = await tracer.read('beauty');
  tracer.destroy();
  return beauty.reduce((max, value, i) => (i % 4 === 3 ? max : Math.max(max, value)), 0);
}

describe('no light comes through the corners of a closed room', () => {
  // Positions are rounded four times as much at 400 m, and so as many of a quarter of the paths would slip out.
  const [far, samples] = process.env['GLANZ_FULL'] === undefined ? [400, 16] : [100, 64];
  it.each(casesOf(3, 7))(`of %i walls, ${far} m from the origin`, async (corners) => {
    expect(await brightest(corners, far, samples)).toBe(0);
  });
});
