import { afterAll, describe, expect, it } from 'vitest';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { createScene, type Scene } from '@glanz/scene';
import { sceneToGlb } from '@glanz/models/gltf';
import type { Contestant, Task } from '../../src/equal-time/contestant';
import { createGlanz } from '../../src/equal-time/glanz';
import { createThreeGpuPathtracer, withoutPeer } from '../../src/peers/three-gpu-pathtracer';

const SIZE = 24;

const gpu = await createGpu().catch(() => undefined);
const able = gpu !== undefined && !withoutPeer(gpu.adapterName);

/** A glowing square in the upper left of the view, below it a diffuse one, under a sky whose four quarters differ. */
function scene(): Scene {
  const made = createScene('test');
  made.materials.push(
    {
      name: 'glow',
      parameters: { base_color: [0, 0, 0], specular_weight: 0, emission_color: [1, 0.5, 0.25], emission_luminance: 3 },
    },
    { name: 'grey', parameters: { base_color: [0.5, 0.5, 0.5], specular_weight: 0 } },
  );
  made.meshes.push({
    name: 'square',
    positions: Float32Array.of(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0),
    indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
    normals: Float32Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1),
  });
  const at = (x: number, y: number) => [0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, x, y, -4, 1];
  made.instances.push(
    { name: 'glow', mesh: 0, material: 0, transform: at(-0.7, 0.7) },
    { name: 'grey', mesh: 0, material: 1, transform: at(-0.7, -0.7) },
  );
  return made;
}

async function task(): Promise<Task> {
  const [width, height] = [16, 8];
  const data = new Float32Array(3 * width * height);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      data.fill(
        0.25 + 0.5 * Number(y < height / 2) + 1.5 * Number(x >= width / 4 && x < width / 2),
        3 * (y * width + x),
        3 * (y * width + x) + 3,
      );
  const camera = {
    type: 'perspective',
    name: 'c',
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    yfov: 0.8,
    aspect: 1,
  } as const;
  return {
    glb: await sceneToGlb(scene()),
    camera,
    environment: { type: 'latlong', width, height, data, intensity: 0.5, rotation: 0.6 },
    width: SIZE,
    height: SIZE,
    maxDepth: 6,
    multipleScattering: true,
  };
}

let device: GPUDevice | undefined;
const faults: string[] = [];

async function sharedDevice(): Promise<GPUDevice> {
  device ??= await requestDevice({ gpu: gpu!.gpu });
  device.addEventListener('uncapturederror', ({ error }) => void faults.push(error.message));
  return device;
}

/** Renders at least so many samples. */
async function advance(contestant: Contestant, samples: number): Promise<void> {
  for (let i = 0; i < 100 && (await contestant.samples()) < samples; i++)
    await contestant.advance(contestant.unit === 'samples' ? samples : 8);
  expect(faults).toEqual([]);
  expect(await contestant.samples()).toBeGreaterThanOrEqual(samples);
}

async function rendered(
  make: (gpuDevice: GPUDevice, t: Task) => Promise<Contestant>,
  samples: number,
): Promise<Float32Array> {
  const contestant = await make(await sharedDevice(), await task());
  contestants.push(contestant);
  await contestant.restart(1);
  await advance(contestant, samples);
  return contestant.read();
}

const contestants: Contestant[] = [];
afterAll(() => {
  contestants.forEach((contestant) => contestant.destroy());
  device?.destroy();
});

/** Mean of the pixels of a part of the image, edges 0..1 from its upper left corner. */
function mean(image: Float32Array, [x0, y0, x1, y1]: readonly [number, number, number, number]): number[] {
  const sum = [0, 0, 0];
  let count = 0;
  for (let y = Math.ceil(y0 * SIZE); y < Math.floor(y1 * SIZE); y++) {
    for (let x = Math.ceil(x0 * SIZE); x < Math.floor(x1 * SIZE); x++, count++)
      for (let c = 0; c < 3; c++) sum[c]! += image[3 * (y * SIZE + x) + c]!;
  }
  return sum.map((value) => value / count);
}

describe.skipIf(!able)('the peer in Node (skips without a GPU or Mesa ≥ 25)', () => {
  it('shows what Glanz shows: emitter, lit surface, and sky, each in its place', async () => {
    const theirs = await rendered((d, t) => createThreeGpuPathtracer(d, t, { defaults: false }), 40);
    const ours = await rendered(createGlanz, 64);
    const glow = [0.2, 0.2, 0.4, 0.4] as const,
      grey = [0.2, 0.6, 0.4, 0.8] as const;
    mean(theirs, glow).forEach((value, c) => expect(value).toBeCloseTo([3, 1.5, 0.75][c]!, 1));
    for (const part of [
      glow,
      grey,
      [0.6, 0, 0.8, 0.45],
      [0.85, 0, 1, 0.45],
      [0.6, 0.55, 0.8, 1],
      [0.85, 0.55, 1, 1],
    ] as const) {
      const [a, b] = [mean(theirs, part), mean(ours, part)];
      // Its sky is a half-float texture and its surfaces lose a percent or two; a turned or mirrored sky would be off
      // by halves.
      a.forEach((value, c) =>
        expect(Math.abs(value / b[c]! - 1), `${part.join(' ')}: ${a.join(' ')} beside ${b.join(' ')}`).toBeLessThan(
          0.06,
        ),
      );
    }
  }, 300_000);

  it('gives independent images for different seeds', async () => {
    const [contestant] = contestants as [Contestant];
    const images: Float32Array[] = [];
    for (const seed of [1, 2]) {
      await contestant.restart(seed);
      await advance(contestant, 4);
      images.push(await contestant.read());
    }
    const different = images[0]!.reduce((count, value, i) => count + (value === images[1]![i] ? 0 : 1), 0);
    expect(different).toBeGreaterThan(0.1 * images[0]!.length);
  }, 300_000);
});
