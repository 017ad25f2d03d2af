import { mkdirSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { RealtimeIntegrator, TEMPORAL_AOVS } from '@glanz/denoise/temporal';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { timed, type Benchmark, type BenchmarkContext, type BenchmarkResult, type Figure } from '../benchmark';
import { childJob, inChild, type ChildJobs } from '../child';
import type { ProductScene } from '../denoise/product-scenes';
import { BenchError } from '../error';
import { flipOfSeen, seen, type SeenImage } from '../flip/flip';
import { shownBytes, shownImage } from '../flip/shown';
import { CLIP_PIXELS, writeClip, writePng } from '../motion/clip';
import { FRAMES, MOVEMENTS, STEP, type Movement } from '../motion/movements';
import { frameFile, peerFrames, type PeerFrames, type PeerPlan } from '../motion/peer';
import { MOTION_SCENES } from '../motion/scenes';
import { listOption } from '../options';
import { withoutPeer } from '../peers/three-gpu-pathtracer';

/** Frames that are compared with references, each with the one before it. */
const COMPARED = [29, 59, 89, 119];
const DEPTH = 6;

/** Ways to show a frame: its samples as they are, with the frames before, and those of another renderer. */
const WAYS = ['raw', 'temporal', 'raw-reuse', 'temporal-reuse', 'three-gpu-pathtracer'] as const;
/** Reusing light samples does not pay in these scenes: see guide/denoising. */
const DEFAULT_WAYS = 'raw,temporal,three-gpu-pathtracer';
type Way = (typeof WAYS)[number];
type OwnWay = Exclude<Way, 'three-gpu-pathtracer'>;

const JOBS: ChildJobs<PeerPlan> = { name: 'motion', file: import.meta.url, run: peerFrames };

/** What is kept of one way through a movement. */
interface Series {
  /** Images by frame: linear RGBA. */
  readonly images: ReadonlyMap<number, Float32Array>;
  readonly milliseconds: readonly number[];
  /** Each frame as it is shown, RGB in 8 bits, where there is a clip. */
  readonly clip: readonly Uint8Array[];
  /** The film some seconds after the last frame. */
  readonly rested?: { readonly image: Float32Array; readonly samples: number };
}

/** What the command line asks for. */
interface Settings {
  readonly width: number;
  readonly height: number;
  readonly samples: number;
  readonly referenceSamples: number;
  /** The last frame. */
  readonly last: number;
  readonly compared: readonly number[];
  readonly restSeconds: number;
  readonly scenes: readonly string[];
  readonly movements: readonly string[];
  readonly ways: readonly Way[];
  /** Folders. */
  readonly images?: string | undefined;
  readonly clips?: string | undefined;
}

/** Moving images: 120 frames of a few samples, raw and with the frames before, against references. */
export const benchmark: Benchmark = {
  description: `${FRAMES} frames of a movement, raw and filtered over time: FLIP against references of the frames, flicker, frame times`,
  options: {
    scenes: { type: 'string', help: `of ${Object.keys(MOTION_SCENES).join(',')}; default: all` },
    movements: { type: 'string', help: `of ${Object.keys(MOVEMENTS).join(',')}; default: all` },
    contestants: {
      type: 'string',
      help: `of ${WAYS.join(',')}; the last one in orbits alone; default ${DEFAULT_WAYS}`,
    },
    size: { type: 'string', help: 'WIDTHxHEIGHT; default 1920x1080, on software GPUs 160x90' },
    compared: { type: 'string', help: `frames that are compared; default ${COMPARED.join(',')}; "none": times alone` },
    samples: { type: 'string', help: 'of a frame; default 1' },
    references: { type: 'string', help: 'samples of references; default 256' },
    rest: { type: 'string', help: 'seconds after the last frame, compared where it is; the film that begins there' },
    images: { type: 'string', help: 'folder that the compared images go to, as PNG' },
    clips: {
      type: 'string',
      help: 'folder for animated WebP: raw, filtered and reference side by side; up to 640x360',
    },
  },
  async run(context) {
    await childJob(JOBS);
    return compareAll(context);
  },
};

function settingsOf({ quick, values }: BenchmarkContext, software: boolean): Settings {
  const size = values['size'] ?? (quick || software ? '160x90' : '1920x1080');
  const [width, height] = size.split('x').map(Number) as [number, number];
  if (values['clips'] && width * height > CLIP_PIXELS)
    throw new BenchError('bench/option', `--clips: ${size} is too large, at most ${CLIP_PIXELS} pixels: set --size.`);
  const last = quick ? 2 : software ? COMPARED[0]! : FRAMES - 1;
  const asked = values['compared'];
  const compared = quick
    ? [2]
    : asked === 'none'
      ? []
      : (asked?.split(',').map(Number) ?? COMPARED).filter((frame) => frame >= 1 && frame <= last);
  return {
    width,
    height,
    samples: Number(values['samples'] ?? 1),
    referenceSamples: Number(values['references'] ?? (quick ? 4 : 256)),
    last,
    compared,
    restSeconds: Number(values['rest'] ?? 0),
    scenes: listOption(values['scenes'], Object.keys(MOTION_SCENES), 'scene'),
    movements: listOption(values['movements'] ?? (quick ? 'orbit' : undefined), Object.keys(MOVEMENTS), 'movement'),
    ways: listOption(values['contestants'] ?? DEFAULT_WAYS, WAYS, 'contestant'),
    images: values['images'],
    clips: values['clips'],
  };
}

async function compareAll(context: BenchmarkContext): Promise<BenchmarkResult> {
  const { log, gpu: name } = context;
  const { gpu, adapterName, software } = await createGpu(name ? { gpu: name } : {});
  const device = await requestDevice({ gpu });
  const settings = settingsOf(context, software);
  const { width, height, samples, referenceSamples, last, compared, restSeconds } = settings;
  const kept = compared.flatMap((frame) => [frame - 1, frame]);
  const figures: Figure[] = [];
  const details: unknown[] = [];
  const notes: string[] = [];
  for (const scene of settings.scenes) {
    const product = await MOTION_SCENES[scene]!.load(width / height);
    for (const movement of settings.movements) {
      const moves = MOVEMENTS[movement]!;
      const title = movement === 'orbit' ? scene : `${scene}, ${movement}`;
      const file = title.replace(', ', '-');
      const made = new Map<Way, Series>();
      for (const way of settings.ways) {
        if (way !== 'three-gpu-pathtracer') {
          made.set(way, await frames(device, product, moves, way, settings, kept));
          continue;
        }
        if (movement !== 'orbit') continue;
        const theirs = withoutPeer(adapterName) ?? (await peerSeries(scene, settings, kept, name));
        if (typeof theirs !== 'string') made.set(way, theirs.series);
        notes.push(`${title}, ${way}${typeof theirs === 'string' ? ` skipped: ${theirs}` : `: ${theirs.note}`}`);
        log(notes.at(-1)!);
      }
      const references = await referenceFrames(device, product, moves, settings, kept);
      if (settings.images && compared.length > 0)
        for (const [way, { images }] of [...made, ['reference', references] as const])
          await writeImage(settings.images, `${file}-${way}`, images.get(compared.at(-1)!)!, settings);
      if (settings.clips) {
        const ways = [...made.values(), references].flatMap(({ clip }) => (clip.length > 0 ? [clip] : []));
        log(`wrote ${await writeClip(settings.clips, file, ways, width, height)}`);
      }
      const look = (images: ReadonlyMap<number, Float32Array>) =>
        new Map([...images].map(([frame, image]) => [frame, looks(image, settings)]));
      const truth = look(references.images);
      for (const [way, { images, milliseconds, rested }] of made) {
        const shown = look(images);
        const error = compared.map((frame) => flipOfSeen(truth.get(frame)!, shown.get(frame)!).mean);
        const flicker = compared.map((frame) => change(shown, frame) - change(truth, frame));
        if (compared.length > 0)
          figures.push(
            timed(`${title}, ${way}: FLIP against the reference of the frame`, '1', error),
            timed(`${title}, ${way}: FLIP from frame to frame beyond that of the references`, '1', flicker),
          );
        const time = timed(`${title}, ${way}: frame`, 'ms', milliseconds);
        figures.push(time);
        if (rested) {
          const after = flipOfSeen(truth.get(last)!, looks(rested.image, settings)).mean;
          figures.push(timed(`${title}: FLIP of the film ${restSeconds} s after the movement`, '1', [after]));
          log(`${title}, ${restSeconds} s of rest: ${rested.samples} samples, FLIP ${after.toFixed(4)}`);
        }
        details.push({ scene, movement, way, frames: compared, error, flicker, milliseconds });
        const list = (values: readonly number[]) => values.map((value) => value.toFixed(4)).join(' ');
        log(`${title}, ${way}: FLIP ${list(error)}, flicker ${list(flicker)}, ${time.median!.toFixed(1)} ms`);
      }
    }
  }
  device.destroy();
  return {
    settings: { width, height, frames: last + 1, radiansPerFrame: STEP, depth: DEPTH, samples, referenceSamples },
    gpu: { name: adapterName, software },
    figures,
    details,
    notes,
  };
}

const createTracer = (
  device: GPUDevice,
  { scene, camera }: ProductScene,
  { width, height }: Settings,
  aovs: typeof TEMPORAL_AOVS | readonly [],
) => PathTracer.create(device, scene, { width, height, camera, maxDepth: DEPTH, aovs });

async function add(tracer: PathTracer, samples: number): Promise<void> {
  for await (const progress of tracer.render({ samples, maxSubmitMs: 100 })) void progress;
}

/** Renders the frames of a movement. */
async function frames(
  device: GPUDevice,
  product: ProductScene,
  moves: Movement,
  way: OwnWay,
  settings: Settings,
  kept: readonly number[],
): Promise<Series> {
  const { samples, last, restSeconds, clips } = settings;
  const isRaw = way.startsWith('raw');
  const lightReuse = way.endsWith('reuse');
  const tracer = await createTracer(device, product, settings, isRaw ? [] : TEMPORAL_AOVS);
  if (isRaw && lightReuse) await tracer.setLightReuse(true);
  const realtime = isRaw ? undefined : await RealtimeIntegrator.create(device, tracer, { lightReuse });
  const integrator = realtime ?? tracer;
  const images = new Map<number, Float32Array>();
  const milliseconds: number[] = [];
  const clip: Uint8Array[] = [];
  // Shaders and the scheduler warm up before the movement.
  await add(tracer, 4);
  for (let frame = 0; frame <= last; frame++) {
    const started = performance.now();
    await moves.at(tracer, product, frame);
    // Raw frames have other random numbers than those before, as the others have. An edit that changes nothing keeps the
    // film.
    if (!realtime) tracer.reset({ firstSample: frame * samples, lightReuse });
    else if (tracer.samples > 0) tracer.reset();
    const options = { samples, maxSubmitMs: 100, ...(realtime ? { instancesMoved: moves.instances } : {}) };
    for await (const progress of integrator.render(options)) void progress;
    await device.queue.onSubmittedWorkDone();
    milliseconds.push(performance.now() - started);
    if (!clips && !kept.includes(frame)) continue;
    const image = await integrator.read('beauty');
    if (kept.includes(frame)) images.set(frame, image);
    if (clips) clip.push(shownBytes(image));
  }
  const rests = restSeconds > 0 && way === 'raw' && kept.includes(last);
  const rested = rests && { samples: await renderFor(tracer, restSeconds), image: await tracer.read('beauty') };
  realtime?.destroy();
  tracer.destroy();
  return { images, milliseconds, clip, ...(rested ? { rested } : {}) };
}

/** The same frames with many samples. */
async function referenceFrames(
  device: GPUDevice,
  product: ProductScene,
  moves: Movement,
  settings: Settings,
  kept: readonly number[],
): Promise<Pick<Series, 'images' | 'clip'>> {
  const { last, referenceSamples, clips } = settings;
  const tracer = await createTracer(device, product, settings, []);
  const images = new Map<number, Float32Array>();
  const clip: Uint8Array[] = [];
  for (let frame = 0; frame <= last; frame++) {
    if (!clips && !kept.includes(frame)) continue;
    await moves.at(tracer, product, frame);
    // An edit that changes nothing keeps the film.
    tracer.reset();
    await add(tracer, referenceSamples);
    const image = await tracer.read('beauty');
    if (kept.includes(frame)) images.set(frame, image);
    if (clips) clip.push(shownBytes(image));
  }
  tracer.destroy();
  return { images, clip };
}

/** The orbit by three-gpu-pathtracer, in a process of its own. Gives in words why there is none. */
async function peerSeries(
  scene: string,
  { width, height, samples, last }: Settings,
  kept: readonly number[],
  gpu: string | undefined,
): Promise<{ readonly series: Series; readonly note: string } | string> {
  const folder = mkdtempSync(join(tmpdir(), 'glanz-motion-'));
  try {
    const plan = { scene, width, height, maxDepth: DEPTH, samples, last, kept, folder };
    const made = await inChild<PeerFrames, PeerPlan>(JOBS, gpu === undefined ? plan : { ...plan, gpu });
    if (typeof made === 'string') return made;
    const images = new Map(
      kept.map((frame) => [frame, new Float32Array(Uint8Array.from(readFileSync(frameFile(folder, frame))).buffer)]),
    );
    const { rounds, minSamples, milliseconds } = made;
    const note = `${rounds} rounds a frame, ${made.samples.toFixed(1)} samples a pixel, ${minSamples} at least`;
    return { series: { images, milliseconds, clip: [] }, note };
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

/** Renders a new film for some seconds. Returns its samples a pixel. */
async function renderFor(tracer: PathTracer, seconds: number): Promise<number> {
  tracer.reset();
  const started = performance.now();
  for await (const { samples } of tracer.render({ samples: 1e6, maxSubmitMs: 16 }))
    if (performance.now() - started >= 1000 * seconds) return samples;
  return tracer.samples;
}

/** What is seen of an image, for FLIP. */
const looks = (rgba: Float32Array, { width, height }: Settings): SeenImage => seen(shownImage(rgba), width, height);

const change = (shown: ReadonlyMap<number, SeenImage>, frame: number) =>
  flipOfSeen(shown.get(frame - 1)!, shown.get(frame)!).mean;

async function writeImage(
  folder: string,
  name: string,
  rgba: Float32Array,
  { width, height }: Settings,
): Promise<void> {
  mkdirSync(folder, { recursive: true });
  await writePng(join(folder, `${name}.png`), shownBytes(rgba), width, height);
}
