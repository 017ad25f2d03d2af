import type { BlobOptions } from './options';
import type { PathTracer } from '@glanz/renderer';
import { MAX_ADAPTIVE_SAMPLES } from '@glanz/renderer/options';
import { inSlices, loadPart } from '@glanz/scene';
import type { ToneMap } from '@glanz/tonemap';
import { toneMapPixels, type ToneMapOptions } from '@glanz/tonemap/tone-map';
import type { checkedOption, checkedSetting } from './checks';
import type { Emitter } from './emitter';
import type { Engine } from './engine';
import type { ViewerError } from './errors';
import { imageProgress, renderCopy } from './render-copy';
import type { ViewerEvents, ViewerState } from './events';

/** Pixels that are tone-mapped in one step, about a millisecond. */
const STEP = 8192;

/** Passed in: imported, they would be a chunk of their own in every page. */
interface Checks {
  readonly checkedOption: typeof checkedOption;
  readonly checkedSetting: typeof checkedSetting;
  readonly ViewerError: typeof ViewerError;
  /** Whether an animation plays. */
  readonly animates: () => boolean;
}

/** What is read of a viewer. */
interface ShownImage extends Pick<Emitter<ViewerEvents>, 'on'> {
  readonly canvas: HTMLCanvasElement;
  readonly state: ViewerState;
  readonly samples: number;
  readonly noise: number | undefined;
  readonly background: 'environment' | 'transparent';
  readonly exposure: number;
  readonly toneMap: ToneMap;
  readonly autoRotate: number;
}

/** What an image is to be, checked. */
interface ImageRequest {
  readonly size: readonly [number, number] | undefined;
  readonly samples: number;
  readonly noise: number | undefined;
  readonly background: 'environment' | 'transparent';
  /** Whether the goal is the one on the screen. */
  readonly usual: boolean;
}

/** @throws {ViewerError} `viewer/option` */
function checked(viewer: ShownImage, options: BlobOptions, checks: Checks): ImageRequest {
  const { width, height, samples, noise, background } = options;
  const { checkedOption, checkedSetting } = checks;
  for (const [name, value] of [
    ['width', width],
    ['height', height],
  ] as const)
    if (value !== undefined) checkedSetting(name, value);
  if (options.quality !== undefined) checkedSetting('quality', options.quality);
  const aspect = Math.max(1, viewer.canvas.clientWidth) / Math.max(1, viewer.canvas.clientHeight);
  const size =
    width === undefined && height === undefined
      ? undefined
      : ([
          width ?? Math.max(1, Math.round((height as number) * aspect)),
          height ?? Math.max(1, Math.round((width as number) / aspect)),
        ] as const);
  const usual = samples === undefined && noise === undefined;
  return {
    size,
    samples:
      samples === undefined ? (usual ? viewer.samples : MAX_ADAPTIVE_SAMPLES) : checkedOption('samples', samples),
    noise: usual ? viewer.noise : noise === undefined ? undefined : checkedOption('noise', noise) || undefined,
    background: background === undefined ? viewer.background : checkedOption('background', background),
    usual,
  };
}

/**
 * Waits until the image on the screen is the wanted one.
 * @returns Its tracer, or `undefined` where it never will be, or at an unknown time: then it has to be rendered
 * separately.
 */
async function screenImage(
  viewer: ShownImage,
  engine: Engine,
  requested: ImageRequest,
  { onProgress }: BlobOptions,
  signal: AbortSignal,
  checks: Checks,
): Promise<PathTracer | undefined> {
  const { size, samples, noise, background, usual } = requested;
  if (background !== viewer.background || (!usual && noise !== undefined)) return undefined;
  const whole = () => {
    const { tracer } = engine;
    if (!tracer || !engine.current || tracer.samples === 0) return undefined;
    if (size && (tracer.width !== size[0] || tracer.height !== size[1])) return undefined;
    return tracer.samples >= samples || (usual && viewer.state === 'done') ? tracer : undefined;
  };
  const idle = () =>
    viewer.state === 'paused' || viewer.state === 'hidden' || viewer.autoRotate !== 0 || checks.animates();
  const ready = whole();
  if (ready || size || samples > viewer.samples || idle()) return ready;
  const listening = new AbortController();
  try {
    const started = performance.now();
    return await new Promise<PathTracer | undefined>((resolve, reject) => {
      const options = { signal: listening.signal };
      const look = () => {
        const tracer = whole();
        if (tracer || idle()) resolve(tracer);
      };
      viewer.on(
        'sample',
        (progress) => {
          onProgress?.(
            imageProgress(
              progress.samples,
              samples,
              performance.now() - started,
              progress.remainingMs,
              usual && noise !== undefined,
            ),
          );
          look();
        },
        options,
      );
      viewer.on('converged', () => queueMicrotask(look), options);
      viewer.on('play', look, options);
      viewer.on(
        'state',
        ({ state }) => {
          if (state === 'failed')
            reject(
              new checks.ViewerError(
                'viewer/no-scene',
                'The viewer failed before the image was rendered; see its error event.',
              ),
            );
          else queueMicrotask(look);
        },
        options,
      );
      signal.addEventListener('abort', () => reject(signal.reason as Error), options);
    });
  } finally {
    listening.abort();
  }
}

/** The codes of an image, tone-mapped in slices. */
export async function codesOf(
  film: Float32Array,
  view: ToneMapOptions,
  alpha: 'opaque' | 'straight',
  signal: AbortSignal,
): Promise<Uint8ClampedArray<ArrayBuffer>> {
  const codes = new Uint8ClampedArray(film.length);
  function* steps(): Generator<void, void> {
    for (let at = 0; at < film.length; at += 4 * STEP) {
      const part = film.subarray(at, at + 4 * STEP);
      codes.set(toneMapPixels(part, part.length / 4, 1, { ...view, alpha }), at);
      yield;
    }
  }
  await inSlices(steps(), { signal });
  return codes;
}

/** Linear RGBA as OpenEXR. */
async function exrBlob(film: Float32Array, { width, height, samples }: PathTracer, type: string): Promise<Blob> {
  const { encodeExr } = await loadPart('exr', import('@glanz/image/exr'));
  const plane = (channel: number) =>
    Float32Array.from({ length: film.length / 4 }, (_, i) => film[4 * i + channel] as number);
  const attributes = { software: 'Glanz', samples: String(samples) };
  const layers = [{ name: '', channels: { R: plane(0), G: plane(1), B: plane(2), A: plane(3) } }];
  return new Blob([encodeExr({ width, height, attributes, layers })], { type });
}

/** Writes the film of a tracer as a file, denoised where the viewer does. @throws {ViewerError} `viewer/blob` */
async function fileOf(
  tracer: PathTracer,
  { settings: { denoise } }: Engine,
  view: ToneMapOptions,
  { type = 'image/png', quality }: BlobOptions,
  signal: AbortSignal,
  checks: Checks,
): Promise<Blob> {
  const { width, height } = tracer;
  const exr = type === 'image/x-exr';
  const denoised = exr ? undefined : await denoise?.still(tracer, signal);
  const film = denoised ?? (await tracer.read('beauty'));
  signal.throwIfAborted();
  if (exr) return exrBlob(film, tracer, type);
  const codes = await codesOf(film, view, type === 'image/jpeg' ? 'opaque' : 'straight', signal);
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  if (!context)
    throw new checks.ViewerError('viewer/blob', `The browser has no canvas of ${width} × ${height} pixels.`);
  context.putImageData(new ImageData(codes, width, height), 0, 0);
  const blob = await canvas
    .convertToBlob({ type, ...(quality === undefined ? {} : { quality }) })
    .catch((cause: unknown) => {
      throw new checks.ViewerError(
        'viewer/blob',
        `The browser cannot write an image of ${width} × ${height} pixels as "${type}".`,
        { cause },
      );
    });
  if (blob.type !== type)
    throw new checks.ViewerError('viewer/blob', `This browser cannot write "${type}": choose image/png.`);
  return denoised && denoise && type === 'image/png' ? denoise.mark(blob) : blob;
}

/** See `Viewer.toBlob`. */
export async function imageBlob(
  viewer: ShownImage,
  engine: Engine,
  options: BlobOptions,
  checks: Checks,
): Promise<Blob> {
  const requested = checked(viewer, options, checks);
  const ended = new AbortController();
  const stop = viewer.on('state', ({ state }) => {
    if (state === 'destroyed') ended.abort(new DOMException('the viewer was destroyed', 'AbortError'));
  });
  const signal = options.signal ? AbortSignal.any([options.signal, ended.signal]) : ended.signal;
  const view = { exposure: viewer.exposure, toneMap: viewer.toneMap };
  try {
    signal.throwIfAborted();
    const shown = await screenImage(viewer, engine, requested, options, signal, checks);
    if (shown) return await fileOf(shown, engine, view, options, signal, checks);
    const { samples, noise, background } = requested;
    const [width, height] = requested.size ?? engine.imageSize;
    const tracer = await renderCopy(
      engine,
      {
        width,
        height,
        samples,
        noise,
        background,
        onProgress: options.onProgress,
        signal,
      },
      checks.ViewerError,
    );
    try {
      return await fileOf(tracer, engine, view, options, signal, checks);
    } finally {
      tracer.destroy();
    }
  } finally {
    stop();
  }
}
