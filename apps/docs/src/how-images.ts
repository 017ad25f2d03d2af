import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { encodePng } from '@glanz/image';
import { createCornellBox } from '@glanz/models';
import { PathTracer, requestDevice, type PathTracerOptions, type Sampler } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { createScene, type Scene } from '@glanz/scene';
import { toneMapPixels } from '@glanz/tonemap';
import { sphere } from '../examples/spheres';

/** Pages show a pixel of the samplers' images as a square of several. */
const SIZE = 112;
/** Between images. */
const GAP = 4;

type Image = Uint8ClampedArray;

async function trace(
  device: GPUDevice,
  scene: Scene,
  exposure: number,
  options: Partial<PathTracerOptions>,
  samples: number,
  size: number,
): Promise<Image> {
  const tracer = await PathTracer.create(device, scene, { width: size, height: size, camera: 0, ...options });
  for await (const _ of tracer.render({ samples }));
  const image = toneMapPixels(await tracer.read('beauty'), size, size, { toneMap: 'neutral', exposure }) as Image;
  tracer.destroy();
  return image;
}

/** Rows of square images as one, on nothing. */
function sheet(rows: readonly (readonly Image[])[], size: number): { width: number; height: number; data: Uint8Array } {
  const step = size + GAP;
  const width = (rows[0] as readonly Image[]).length * step - GAP;
  const height = rows.length * step - GAP;
  const data = new Uint8Array(4 * width * height);
  rows.forEach((images, row) =>
    images.forEach((image, column) => {
      for (let y = 0; y < size; y++)
        data.set(image.subarray(4 * y * size, 4 * (y + 1) * size), 4 * ((row * step + y) * width + column * step));
    }),
  );
  return { width, height, data };
}

/** The Cornell box at 1, 4 and 16 samples (rows) by the three samplers (columns). */
async function samplers(device: GPUDevice): Promise<ReturnType<typeof sheet>> {
  const names: readonly Sampler[] = ['independent', 'sobol', 'blue-noise'];
  const rows: Image[][] = [];
  for (const samples of [1, 4, 16]) {
    const row: Image[] = [];
    for (const sampler of names)
      row.push(await trace(device, createCornellBox(), 1.5, { sampler, maxDepth: 4 }, samples, SIZE));
    rows.push(row);
  }
  return sheet(rows, SIZE);
}

/**
 * A ball of few triangles with smooth normals under a low sun: by the triangles' horizons, by the smooth surface, and
 * of many triangles.
 */
async function terminator(device: GPUDevice): Promise<ReturnType<typeof sheet>> {
  const ball = (segments: number): Scene => {
    const scene = createScene('Ball');
    scene.meshes = [sphere(segments)];
    scene.materials = [{ name: 'matt', parameters: { base_color: [0.7, 0.7, 0.7], specular_weight: 0 } }];
    scene.instances = [
      { name: 'ball', mesh: 0, material: 0, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] },
    ];
    scene.lights = [
      { type: 'directional', name: 'sun', color: [1, 1, 1], intensity: 3, direction: [-0.9, -0.36, 0.25] },
    ];
    scene.environment = { type: 'constant', radiance: [0.03, 0.035, 0.045], visible: false };
    scene.cameras = [
      { type: 'perspective', name: 'front', yfov: 0.4, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5.6, 1] },
    ];
    return scene;
  };
  const size = 2 * SIZE;
  return sheet(
    [
      [
        await trace(device, ball(8), 0, { shadowTerminator: 'faceted' }, 64, size),
        await trace(device, ball(8), 0, { shadowTerminator: 'smooth' }, 64, size),
        await trace(device, ball(128), 0, {}, 64, size),
      ],
    ],
    size,
  );
}

/** Renders the images of the section "How it works" into PNG files. */
export async function howMain([folder = '.', ...names]: readonly string[]): Promise<void> {
  mkdirSync(folder, { recursive: true });
  const device = await requestDevice({ gpu: (await createGpu()).gpu });
  for (const [name, make] of Object.entries({ samplers, terminator })) {
    if (names.length > 0 && !names.includes(name)) continue;
    writeFileSync(join(folder, `${name}.png`), encodePng(await make(device)));
    process.stderr.write(`${name}\n`);
  }
  device.destroy();
}
