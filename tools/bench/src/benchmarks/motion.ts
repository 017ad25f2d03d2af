import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { TEMPORAL_AOVS, TemporalFilter } from '@glanz/denoise/temporal';
import { createCornellBox } from '@glanz/models';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { PRODUCT_SCENES, type ProductScene } from '../denoise/product-scenes';
import { BenchError } from '../error';
import { flipOfSeen, seen, type SeenImage } from '../flip/flip';
import { FRAMES, MOVEMENTS, STEP } from '../motion/movements';

/** Frames that are compared with references, each with the one before it. */
const COMPARED = [29, 59, 89, 119];
const DEPTH = 6;

/** Ways to show a frame: its samples as they are, and with the frames before. */
const WAYS = ['raw', 'temporal'] as const;
type Way = (typeof WAYS)[number];

const SCENES: Readonly<Record<string, (aspect: number) => Promise<ProductScene>>> = {
  'push-button': PRODUCT_SCENES['push-button, studio']!,
  helmet: PRODUCT_SCENES['helmet']!,
  vase: PRODUCT_SCENES['vase']!,
  room: () => {
    const scene = createCornellBox();
    return Promise.resolve({ scene, camera: scene.cameras[0]! });
  },
};

/** Linear RGBA as sRGB shows it, in 8 bits: RGB from 0 to 1. */
function shown(rgba: Float32Array): Float32Array {
  const out = new Float32Array((rgba.length / 4) * 3);
  for (let i = 0; i < out.length; i++) {
    const v = Math.min(Math.max(rgba[4 * Math.floor(i / 3) + (i % 3)]!, 0), 1);
    out[i] = Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055)) / 255;
  }
  return out;
}

/** What is kept of one way through a movement: images by frame, and milliseconds a frame. */
interface Series {
  readonly images: Map<number, Float32Array>;
  readonly milliseconds: number[];
  /** The film some seconds after the last frame. */
  rested?: { readonly image: Float32Array; readonly samples: number };
}

/** Moving images: 120 frames of a few samples, raw and with the frames before, against references. */
export const benchmark: Benchmark = {
  description: `${FRAMES} frames of a movement, raw and filtered over time: FLIP against references of the frames, flicker, frame times`,
  options: {
    scenes: { type: 'string', help: `of ${Object.keys(SCENES).join(',')}; default: all` },
    movements: { type: 'string', help: `of ${Object.keys(MOVEMENTS).join(',')}; default: all` },
    size: { type: 'string', help: 'WIDTHxHEIGHT; default 1920x1080, on software GPUs 160x90' },
    compared: { type: 'string', help: `frames that are compared; default ${COMPARED.join(',')}; "none": times alone` },
    samples: { type: 'string', help: 'of a frame; default 1' },
    references: { type: 'string', help: 'samples of references; default 256' },
    rest: { type: 'string', help: 'seconds after the last frame, compared where it is; the film that begins there' },
    images: { type: 'string', help: 'folder that the compared images go to, as PNG' },
  },
  async run({ log, quick, gpu: name, values }) {
    const { gpu, adapterName, software } = await createGpu(name ? { gpu: name } : {});
    const device = await requestDevice({ gpu });
    const small = quick || software;
    const [width, height] = (values['size'] ?? (small ? '160x90' : '1920x1080')).split('x').map(Number) as [
      number,
      number,
    ];
    const samples = Number(values['samples'] ?? 1);
    const referenceSamples = Number(values['references'] ?? (quick ? 4 : 256));
    const last = quick ? 2 : software ? COMPARED[0]! : FRAMES - 1;
    const restSeconds = Number(values['rest'] ?? 0);
    const asked = values['compared'];
    const compared = quick
      ? [2]
      : asked === 'none'
        ? []
        : (asked?.split(',').map(Number) ?? COMPARED).filter((frame) => frame >= 1 && frame <= last);
    const kept = compared.flatMap((frame) => [frame - 1, frame]);
    const names = values['scenes']?.split(',') ?? Object.keys(SCENES);
    const movements = values['movements']?.split(',') ?? (quick ? ['orbit'] : Object.keys(MOVEMENTS));
    const figures: Figure[] = [];
    const details: unknown[] = [];
    for (const scene of names) {
      const load = SCENES[scene];
      if (!load) throw new BenchError('bench/option', `--scenes: there is no "${scene}".`);
      const product = await load(width / height);
      for (const movement of movements) {
        const moves = MOVEMENTS[movement];
        if (!moves) throw new BenchError('bench/option', `--movements: there is no "${movement}".`);
        const title = movement === 'orbit' ? scene : `${scene}, ${movement}`;
        const create = (aovs: typeof TEMPORAL_AOVS | readonly []) =>
          PathTracer.create(device, product.scene, { width, height, camera: product.camera, maxDepth: DEPTH, aovs });
        const add = async (tracer: PathTracer, count: number) => {
          for await (const progress of tracer.render({ samples: count, maxSubmitMs: 100 })) void progress;
        };
        const made = {} as Record<Way, Series>;
        for (const way of WAYS) {
          const tracer = await create(way === 'raw' ? [] : TEMPORAL_AOVS);
          const filter = way === 'raw' ? undefined : await TemporalFilter.create(device);
          await filter?.prepare(width, height);
          const series: Series = { images: new Map(), milliseconds: [] };
          // Shaders and the scheduler warm up before the movement.
          await add(tracer, 4);
          for (let frame = 0; frame <= last; frame++) {
            const started = performance.now();
            await moves.at(tracer, product, frame);
            const follows = frame > 0 && (!moves.camera || tracer.history !== undefined);
            // Other random numbers than those of the frame before, or its noise would never average out.
            tracer.reset({ firstSample: frame * samples });
            await add(tracer, samples);
            const image = filter?.filterTracer(tracer, follows ? 'moves' : 'cuts', moves.instances);
            await device.queue.onSubmittedWorkDone();
            series.milliseconds.push(performance.now() - started);
            if (kept.includes(frame))
              series.images.set(frame, filter && image ? await filter.read(image) : await tracer.read('beauty'));
          }
          if (restSeconds > 0 && way === 'raw' && kept.includes(last))
            series.rested = { samples: await renderFor(tracer, restSeconds), image: await tracer.read('beauty') };
          filter?.destroy();
          tracer.destroy();
          made[way] = series;
        }
        const reference = await create([]);
        const references = new Map<number, Float32Array>();
        for (const frame of kept) {
          await moves.at(reference, product, frame);
          await add(reference, referenceSamples);
          references.set(frame, await reference.read('beauty'));
        }
        reference.destroy();
        if (values['images'] && compared.length > 0)
          await writeImages(
            values['images'],
            title,
            compared,
            { ...mapImages(made), reference: references },
            width,
            height,
          );
        const look = (images: ReadonlyMap<number, Float32Array>) =>
          new Map([...images].map(([frame, image]) => [frame, seen(shown(image), width, height)]));
        const truth = look(references);
        for (const way of WAYS) {
          const looks = look(made[way].images);
          const error = compared.map((frame) => flipOfSeen(truth.get(frame)!, looks.get(frame)!).mean);
          const flicker = compared.map((frame) => change(looks, frame) - change(truth, frame));
          if (compared.length > 0)
            figures.push(
              timed(`${title}, ${way}: FLIP against the reference of the frame`, '1', error),
              timed(`${title}, ${way}: FLIP from frame to frame beyond that of the references`, '1', flicker),
            );
          figures.push(timed(`${title}, ${way}: frame`, 'ms', made[way].milliseconds));
          const { rested } = made[way];
          if (rested) {
            const after = flipOfSeen(truth.get(last)!, seen(shown(rested.image), width, height)).mean;
            figures.push(timed(`${title}: FLIP of the film ${restSeconds} s after the movement`, '1', [after]));
            log(`${title}, ${restSeconds} s of rest: ${rested.samples} samples, FLIP ${after.toFixed(4)}`);
          }
          details.push({
            scene,
            movement,
            way,
            frames: compared,
            error,
            flicker,
            milliseconds: made[way].milliseconds,
          });
          log(
            `${title}, ${way}: FLIP ${error.map((value) => value.toFixed(4)).join(' ')}, flicker ${flicker.map((value) => value.toFixed(4)).join(' ')}, ${[...made[way].milliseconds].sort((a, b) => a - b)[Math.floor(0.5 * made[way].milliseconds.length)]!.toFixed(1)} ms`,
          );
        }
      }
    }
    device.destroy();
    return {
      settings: { width, height, frames: last + 1, radiansPerFrame: STEP, depth: DEPTH, samples, referenceSamples },
      gpu: { name: adapterName, software },
      figures,
      details,
    };
  },
};

/** Renders a new film for some seconds. Returns its samples a pixel. */
async function renderFor(tracer: PathTracer, seconds: number): Promise<number> {
  tracer.reset();
  const started = performance.now();
  for await (const { samples } of tracer.render({ samples: 1e6, maxSubmitMs: 16 }))
    if (performance.now() - started >= 1000 * seconds) return samples;
  return tracer.samples;
}

const change = (looks: ReadonlyMap<number, SeenImage>, frame: number) =>
  flipOfSeen(looks.get(frame - 1)!, looks.get(frame)!).mean;

const mapImages = (made: Readonly<Record<Way, Series>>) =>
  Object.fromEntries(WAYS.map((way) => [way, made[way].images])) as Record<Way, Map<number, Float32Array>>;

/** Writes the last compared frame of each way. */
async function writeImages(
  folder: string,
  title: string,
  compared: readonly number[],
  images: Readonly<Record<string, ReadonlyMap<number, Float32Array>>>,
  width: number,
  height: number,
): Promise<void> {
  const { default: sharp } = await import('sharp');
  mkdirSync(folder, { recursive: true });
  for (const [way, frames] of Object.entries(images)) {
    const rgb = Uint8Array.from(shown(frames.get(compared.at(-1)!)!), (value) => 255 * value);
    await sharp(rgb, { raw: { width, height, channels: 3 } }).toFile(
      join(folder, `${title.replace(', ', '-')}-${way}.png`),
    );
  }
}
