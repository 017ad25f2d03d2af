import { createCornellBox } from '@glanz/models';
import { PathTracer, requestDevice, type PathTracerOptions } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { createScene, type Scene } from '@glanz/scene';
import { estimated, timed, wallTimes, type Benchmark, type Figure } from '../benchmark';
import { BenchError } from '../error';
import { GpuClock } from '../gpu-clock';

type Choice = NonNullable<PathTracerOptions['lightSampling']>;

const CHOICES: readonly Choice[] = ['tree', 'power'];

/** Rows and columns of rooms in the hall. */
const ROOMS = 8;
/** Lights in a room. */
const LIGHTS_PER_ROOM = 16;

/** A quad between two corners and two edges, wound so that its front is where the edges' cross product points. */
function addQuad(
  scene: Scene,
  at: readonly number[],
  edge1: readonly number[],
  edge2: readonly number[],
  material: number,
): void {
  const corner = (a: number, b: number) =>
    at.map((value, k) => value + a * (edge1[k] as number) + b * (edge2[k] as number));
  const mesh =
    scene.meshes.push({
      name: 'quad',
      positions: new Float32Array([...corner(0, 0), ...corner(1, 0), ...corner(1, 1), ...corner(0, 1)]),
      indices: new Uint32Array([0, 1, 2, 0, 2, 3]),
    }) - 1;
  scene.instances.push({ name: 'quad', mesh, material, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] });
}

/**
 * A floor with walls between rooms of 2 m, each lit by small lights of its own: 1,024 quads, of which a place sees a
 * few.
 */
function hall(): Scene {
  const scene = createScene();
  scene.materials.push({ name: 'plaster', parameters: { base_color: [0.7, 0.7, 0.7], specular_weight: 0 } });
  for (const [i, color] of (
    [
      [1, 0.7, 0.4],
      [0.6, 0.8, 1],
    ] as const
  ).entries())
    scene.materials.push({
      name: `light ${i}`,
      parameters: { base_weight: 0, specular_weight: 0, emission_color: color, emission_luminance: 40 },
    });
  const size = 2 * ROOMS;
  addQuad(scene, [0, 0, 0], [0, 0, size], [size, 0, 0], 0);
  for (let i = 0; i <= ROOMS; i++) {
    for (const thick of [-0.05, 0.05]) {
      const along = thick < 0 ? 1 : -1;
      addQuad(scene, [2 * i + thick, 0, along > 0 ? 0 : size], [0, 0, along * size], [0, 1.2, 0], 0);
      addQuad(scene, [along > 0 ? size : 0, 0, 2 * i + thick], [-along * size, 0, 0], [0, 1.2, 0], 0);
    }
  }
  for (let room = 0; room < ROOMS * ROOMS; room++) {
    for (let light = 0; light < LIGHTS_PER_ROOM; light++) {
      const x = 2 * (room % ROOMS) + 0.3 + 0.45 * (light % 4);
      const z = 2 * Math.floor(room / ROOMS) + 0.3 + 0.45 * Math.floor(light / 4);
      addQuad(scene, [x, 1.0, z], [0.05, 0, 0], [0, 0, 0.05], 1 + (room % 2));
    }
  }
  scene.cameras.push({
    type: 'perspective',
    name: 'above',
    yfov: 0.9,
    transform: [1, 0, 0, 0, 0, 0.5, -0.8660254, 0, 0, 0.8660254, 0.5, 0, size / 2, 9, size / 2 + 5, 1],
  });
  return scene;
}

/** The mean over pixels of the squared deviation of images from their mean, relative to it as relMSE is. */
function spread(images: readonly Float32Array[]): { readonly perImage: number[]; readonly mean: number } {
  const n = images.length;
  const pixels = (images[0] as Float32Array).length / 4;
  const mean = new Float64Array(4 * pixels);
  for (const image of images) image.forEach((value, i) => (mean[i]! += value / n));
  let [total, power] = [0, 0];
  for (let i = 0; i < pixels; i++)
    for (let c = 4 * i; c < 4 * i + 3; c++)
      [total, power] = [total + mean[c]! / (3 * pixels), power + mean[c]! ** 2 / (3 * pixels)];
  const perImage = images.map((image) => {
    let sum = 0;
    for (let i = 0; i < pixels; i++) {
      let [error, bright] = [0, 0];
      for (let c = 4 * i; c < 4 * i + 3; c++)
        [error, bright] = [error + (image[c]! - mean[c]!) ** 2 / 3, bright + mean[c]! ** 2 / 3];
      sum += error / (bright + 0.01 * power);
    }
    // The mean is made of the images themselves.
    return (sum / pixels) * (n / (n - 1));
  });
  return { perImage, mean: total };
}

/** What the choice of a light costs and what it gains, with few lights and with many. */
export const benchmark: Benchmark = {
  description:
    'error per sample and time per sample of light samples by the tree and by power, with 2 and with 2,048 emissive triangles',
  options: {
    choices: { type: 'string', help: 'only these, separated by commas: tree, power' },
    samples: { type: 'string', help: 'samples per pixel of each image' },
  },
  async run({ log, quick, gpu, values }) {
    const choices = (values['choices']?.split(',') ?? CHOICES) as readonly Choice[];
    const unknown = choices.find((choice) => !CHOICES.includes(choice));
    if (unknown !== undefined)
      throw new BenchError(
        'bench/option',
        `--choices: there is no choice "${unknown}"; there are: ${CHOICES.join(', ')}.`,
      );
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const device = await requestDevice({ gpu: api });
    const size = quick ? 32 : software ? 96 : 512;
    const samples = values['samples'] === undefined ? (quick ? 2 : software ? 16 : 64) : Number(values['samples']);
    if (!Number.isInteger(samples) || samples < 1)
      throw new BenchError('bench/option', `--samples ${values['samples']}: it must be a whole number of at least 1.`);
    const runs = quick ? 2 : software ? 6 : 12;
    const clock = GpuClock.create(device);
    const figures: Figure[] = [];
    for (const [name, scene] of [
      ['few lights', createCornellBox()],
      ['many lights', hall()],
    ] as const) {
      for (const lightSampling of choices) {
        const images: Float32Array[] = [];
        const times: number[] = [];
        for (let seed = 1; seed <= runs; seed++) {
          const tracer = await PathTracer.create(device, scene, {
            width: size,
            height: size,
            maxDepth: 4,
            camera: 0,
            seed,
            lightSampling,
          });
          const work = async () => {
            tracer.reset();
            for await (const progress of tracer.render({ samples })) void progress;
            await device.queue.onSubmittedWorkDone();
          };
          // The first run of a tracer learns how large its batches may be.
          if (seed === 1) await work();
          times.push((clock ? (await clock.measure(work)).busy : (await wallTimes(1, 0, work))[0]!) / samples);
          images.push(await tracer.read('beauty'));
          tracer.destroy();
        }
        const { perImage, mean } = spread(images);
        const time = timed(`${name}, ${lightSampling}: ${clock ? 'GPU' : 'wall'} time per sample`, 'ms', times);
        figures.push(
          estimated(
            `${name}, ${lightSampling}: relative variance × samples`,
            '1',
            perImage.map((value) => value * samples),
          ),
          time,
          estimated(
            `${name}, ${lightSampling}: relative variance × milliseconds`,
            'ms',
            perImage.map((value) => value * samples * (time.median as number)),
          ),
          { name: `${name}, ${lightSampling}: mean of the image`, unit: '1', runs, mean, ci95: 0 },
        );
        log(
          figures
            .slice(-4)
            .map((figure) => `${figure.name} ${(figure.mean ?? figure.median ?? 0).toPrecision(4)}`)
            .join('; '),
        );
      }
    }
    clock?.destroy();
    device.destroy();
    return {
      settings: {
        size,
        samples,
        runs,
        maxDepth: 4,
        choices,
        triangles: { 'few lights': 2, 'many lights': 2 * ROOMS * ROOMS * LIGHTS_PER_ROOM },
      },
      gpu: { name: adapterName, software },
      figures,
    };
  },
};
