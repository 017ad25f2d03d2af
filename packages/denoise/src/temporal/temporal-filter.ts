import { DenoiseError } from '../error';
import { ALIGNMENT, COPY_DST, COPY_SRC, STORAGE, UNIFORM, bindGroup, readImage, tryBuffers } from '../gpu';
import { checkSize } from '../images';
import { eyeOf, projectionOf } from './camera';
import { compileTemporalKernels, type TemporalKernels } from './kernels';
import { temporalFrameStruct } from './layouts';
import {
  TEMPORAL_AOVS,
  type FilterableTracer,
  type FilteredImage,
  type FrameStep,
  type Point,
  type TemporalFilterOptions,
  type TemporalFrame,
} from './options';

/** Samples up to which nothing but the filtered image is shown. */
const NOISY_SAMPLES = 4;
const MAX_PASSES = 5;

/** What one frame leaves for the next one. */
interface Past {
  readonly surfaces: GPUBuffer;
  readonly light: GPUBuffer;
  readonly moments: GPUBuffer;
  /** The image that was shown. */
  readonly shown: GPUBuffer;
}

/** What is kept for images of a size. */
interface Buffers {
  readonly width: number;
  readonly height: number;
  readonly uniforms: GPUBuffer;
  readonly shapes: GPUBuffer;
  readonly history: GPUBuffer;
  readonly historyMoments: GPUBuffer;
  readonly filters: readonly [GPUBuffer, GPUBuffer];
  /** Before edges are smoothed. */
  readonly image: GPUBuffer;
  /** The present frame and the one before; they change places. */
  pasts: readonly [now: Past, before: Past];
  readonly all: readonly GPUBuffer[];
}

const NOWHERE: readonly [Point, Point] = [
  [0, 0, 0],
  [0, 0, 0],
];
const UNKNOWN: readonly [ArrayLike<number>, ArrayLike<number>] = [new Float32Array(16), new Float32Array(16)];

function checkOptions({ maxHistory, clampSigmas, passes, settledSamples }: Required<Settings>): void {
  const bad = (name: string, value: number, range: string) =>
    new DenoiseError('denoise/option', `${name} ${value} is out of range: use ${range}.`);
  if (!(maxHistory >= 1)) throw bad('maxHistory', maxHistory, '1 or more');
  if (!(clampSigmas > 0)) throw bad('clampSigmas', clampSigmas, 'a number above 0, or Infinity');
  if (!Number.isInteger(passes) || passes < 0 || passes > MAX_PASSES)
    throw bad('passes', passes, `a whole number from 0 to ${MAX_PASSES}`);
  if (!(settledSamples > NOISY_SAMPLES))
    throw bad('settledSamples', settledSamples, `a number above ${NOISY_SAMPLES}, or Infinity`);
}

type Settings = Omit<TemporalFilterOptions, 'signal'>;

/**
 * Reuses earlier frames: lowers the noise of a film of few samples while the camera or instances move. Works on GPU
 * buffers; the film itself is only read. The image is biased while the film has few samples, and is the film from
 * `settledSamples` on.
 *
 * - Reprojection: each pixel's history is fetched from where its surface was, as the motion AOV tells, bilinearly from
 *   pixels that showed the same instance on the same plane with a like normal. What was hidden has none. The history of
 *   reflections is the shorter, the more the view has turned and the smoother the surface is. What is seen in mirrors or
 *   through clear glass is looked up where its virtual image was, straight on and as far away as the path is long; its
 *   history counts for 4 samples at most where the projections are not known, or instances have moved.
 * - Illumination, the image over its albedo, is averaged with the history by their numbers of samples. Where the light
 *   around a pixel has changed by more than its noise, the history gets as much brighter or darker, and where the
 *   differences of neighbours from their history are alike, as those of noise are not, it counts for less. It is kept
 *   within the spread of the pixel's present neighbours.
 * - Edges and fine textures are smoothed by the image that was shown before, within the colours around each pixel.
 * - A spatial filter by the variance of that (Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering") takes the
 *   noise that is left; where illumination has none, it changes nothing.
 *
 * Memory: 224 bytes a pixel.
 *
 * @example
 * const filter = await TemporalFilter.create(device);
 * const tracer = await PathTracer.create(device, scene, { width, height, aovs: TEMPORAL_AOVS });
 * // after each sample
 * const { buffer } = filter.filterTracer(tracer, 'continues');
 * // after tracer.setCamera() and the first sample that follows
 * const { buffer } = filter.filterTracer(tracer, 'moves');
 */
export class TemporalFilter {
  readonly #device: GPUDevice;
  readonly #kernels: TemporalKernels;
  readonly #settings: Required<Settings>;
  #buffers: Buffers | undefined;
  /** Whether there was a frame, and whether the present film follows from the one before. */
  #known = false;
  #follows = false;
  #destroyed = false;

  private constructor(device: GPUDevice, kernels: TemporalKernels, settings: Required<Settings>) {
    this.#device = device;
    this.#kernels = kernels;
    this.#settings = settings;
  }

  /**
   * Compiles the shaders.
   *
   * @throws {DenoiseError} `denoise/option`, `denoise/pipeline`.
   */
  static async create(
    device: GPUDevice,
    {
      signal,
      maxHistory = 8,
      clampSigmas = 3,
      antialias = true,
      passes = 3,
      settledSamples = 64,
    }: TemporalFilterOptions = {},
  ): Promise<TemporalFilter> {
    signal?.throwIfAborted();
    const settings = { maxHistory, clampSigmas, antialias, passes, settledSamples };
    checkOptions(settings);
    const kernels = await compileTemporalKernels(device);
    signal?.throwIfAborted();
    return new TemporalFilter(device, kernels, settings);
  }

  /** Bytes on the GPU: what the last size needs. */
  get memoryBytes(): number {
    return this.#buffers?.all.reduce((sum, { size }) => sum + size, 0) ?? 0;
  }

  /**
   * Makes memory for images of a size. The history is lost where it was of another size.
   *
   * @throws {DenoiseError} `denoise/size`, `denoise/memory`, `denoise/destroyed`.
   */
  async prepare(width: number, height: number): Promise<void> {
    this.#expectAlive();
    checkSize(width, height);
    if (this.#buffers?.width === width && this.#buffers.height === height) return;
    this.release();
    const image = (name: string, usage = 0, bytes = 16 * width * height) => ({
      label: `temporal ${name}`,
      size: bytes,
      usage: STORAGE | usage,
    });
    const names = ['surfaces', 'light', 'moments', 'shown'] as const;
    const made = await tryBuffers(this.#device, [
      { label: 'temporal frame', size: (MAX_PASSES + 1) * ALIGNMENT, usage: UNIFORM | COPY_DST },
      image('image'),
      image('shapes'),
      image('history', COPY_DST),
      image('history moments', COPY_DST),
      // The second one holds sums over tiles at first, 48 bytes each.
      image('filter'),
      image('filter', 0, Math.max(48, 16 * width * height)),
      ...[...names, ...names].map((name) => image(name, name === 'shown' ? COPY_SRC : 0)),
    ]);
    if (!made)
      throw new DenoiseError(
        'denoise/memory',
        `The GPU has no memory for the history of ${width} × ${height} pixels: filter a smaller image.`,
      );
    if (this.#destroyed) for (const buffer of made) buffer.destroy();
    this.#expectAlive();
    const [uniforms, shown, shapes, history, historyMoments, a, b, ...pasts] = made as [
      GPUBuffer,
      GPUBuffer,
      GPUBuffer,
      GPUBuffer,
      GPUBuffer,
      GPUBuffer,
      GPUBuffer,
      ...GPUBuffer[],
    ];
    const past = (i: number): Past => ({
      surfaces: pasts[i]!,
      light: pasts[i + 1]!,
      moments: pasts[i + 2]!,
      shown: pasts[i + 3]!,
    });
    this.#buffers = {
      width,
      height,
      uniforms,
      shapes,
      history,
      historyMoments,
      filters: [a, b],
      image: shown,
      pasts: [past(0), past(4)],
      all: made,
    };
  }

  /**
   * Filters a frame: records and submits the work, and returns at once.
   *
   * @throws {DenoiseError} `denoise/size` where {@link prepare} was not called for this size, `denoise/input`,
   * `denoise/destroyed`.
   */
  filter(frame: TemporalFrame): FilteredImage {
    this.#expectAlive();
    const { width, height, color, albedo, normal, position, ids, motion } = frame;
    const buffers = this.#buffers;
    if (buffers?.width !== width || buffers.height !== height)
      throw new DenoiseError(
        'denoise/size',
        `Nothing is prepared for ${width} × ${height} pixels: await prepare() with the size before filter().`,
      );
    this.#check(frame);
    // A film that goes on has the same history as before.
    if (frame.step !== 'continues') buffers.pasts = [buffers.pasts[1], buffers.pasts[0]];
    const [now, before] = buffers.pasts;
    const { shapes, history, historyMoments, filters, image } = buffers;
    const share = this.#write(buffers, frame);
    const encoder = this.#device.createCommandEncoder({ label: 'temporal filter' });
    if (frame.step === 'cuts' || !this.#known) this.#follows = false;
    else if (frame.step === 'moves') this.#follows = true;
    if (!this.#follows) {
      encoder.clearBuffer(history);
      encoder.clearBuffer(historyMoments);
    }
    const pass = encoder.beginComputePass({ label: 'temporal filter' });
    const run = (name: keyof TemporalKernels, resources: readonly GPUBuffer[], smoothing = 0) => {
      const kernel = this.#kernels[name];
      const uniform = { buffer: buffers.uniforms, offset: smoothing * ALIGNMENT, size: temporalFrameStruct.size };
      const windows = resources.map((buffer, i) => [i + 1, { buffer, offset: 0, size: buffer.size }] as const);
      pass.setPipeline(kernel.pipeline);
      pass.setBindGroup(0, bindGroup(this.#device, kernel, { 0: uniform, ...Object.fromEntries(windows) }));
      pass.dispatchWorkgroups(Math.ceil(width / 8), Math.ceil(height / 8));
    };
    run('guides', [normal, position, ids, now.surfaces, shapes]);
    if (frame.step === 'moves' && this.#follows)
      run('reproject', [
        motion,
        now.surfaces,
        shapes,
        before.surfaces,
        before.light,
        before.moments,
        history,
        historyMoments,
      ]);
    let [source, target] = filters;
    run('change', [color, albedo, history, target]);
    run('combine', [color, albedo, history, historyMoments, shapes, target, now.light, now.moments]);
    if (share > 0 && this.#settings.passes > 0) run('spread', [now.light, now.moments, shapes, source]);
    else source = now.light;
    for (let i = 0; share > 0 && i < this.#settings.passes; i++) {
      run('smooth', [source, now.surfaces, shapes, target], i);
      [source, target] = [target, source];
    }
    const antialias = this.#settings.antialias && this.#follows;
    run('finish', [color, albedo, source, antialias ? image : now.shown]);
    if (antialias) run('antialias', [image, motion, shapes, before.shown, now.shown]);
    pass.end();
    this.#device.queue.submit([encoder.finish()]);
    this.#known = true;
    return { buffer: now.shown, width, height };
  }

  /**
   * Filters what a tracer has rendered so far. One call for each frame that is shown.
   *
   * @param tracer A `PathTracer` with the AOVs of {@link TEMPORAL_AOVS} on this device, with one sample or more.
   * @throws {DenoiseError} as {@link filter} does; `denoise/input` too where an AOV is not requested. What the tracer throws.
   */
  filterTracer(tracer: FilterableTracer, step: FrameStep, instancesMoved = false): FilteredImage {
    const missing = TEMPORAL_AOVS.filter((name) => !tracer.aovs.includes(name));
    if (missing.length > 0)
      throw new DenoiseError(
        'denoise/input',
        `The tracer does not record ${missing.join(', ')}: create it with aovs: TEMPORAL_AOVS, or await setAovs(TEMPORAL_AOVS).`,
      );
    const buffer = (name: (typeof TEMPORAL_AOVS)[number]) => tracer.aov(name).buffer;
    const cameras = [tracer.camera, (tracer.history ?? tracer).camera] as const;
    const [now, before] = cameras.map((camera) => projectionOf(camera, tracer.width / tracer.height));
    return this.filter({
      width: tracer.width,
      height: tracer.height,
      samples: tracer.samples,
      color: tracer.beautyBuffer,
      albedo: buffer('albedo'),
      normal: buffer('normal'),
      position: buffer('position'),
      ids: buffer('objectId'),
      motion: buffer('motion'),
      step,
      instancesMoved,
      eyes: [eyeOf(cameras[0]), eyeOf(cameras[1])],
      projections: now && before && [now, before],
    });
  }

  /**
   * Copies an image to the CPU: linear RGBA, stride 4, top row first.
   *
   * @throws {DenoiseError} `denoise/destroyed`.
   */
  async read(image: FilteredImage): Promise<Float32Array<ArrayBuffer>> {
    this.#expectAlive();
    return readImage(this.#device, image);
  }

  /** Frees the memory for images, and forgets the frames before; {@link prepare} makes it again. */
  release(): void {
    for (const buffer of this.#buffers?.all ?? []) buffer.destroy();
    this.#buffers = undefined;
    this.#known = this.#follows = false;
  }

  /** Frees everything on the GPU. */
  destroy(): void {
    this.#destroyed = true;
    this.release();
  }

  #expectAlive(): void {
    if (this.#destroyed)
      throw new DenoiseError('denoise/destroyed', 'This TemporalFilter was destroyed: create another one.');
  }

  #check(frame: TemporalFrame): void {
    const { width, height, samples } = frame;
    if (!(samples >= 1) || !Number.isFinite(samples))
      throw new DenoiseError('denoise/input', `samples ${samples} is out of range: a frame has one sample or more.`);
    const bytes = { color: 16, albedo: 16, normal: 16, position: 16, ids: 16, motion: 8 } as const;
    for (const [name, each] of Object.entries(bytes) as [keyof typeof bytes, number][]) {
      const buffer = frame[name];
      const min = each * width * height;
      if (buffer.size < min || !(buffer.usage & STORAGE))
        throw new DenoiseError(
          'denoise/input',
          `"${name}" needs the usage STORAGE and ${min} bytes for ${width} × ${height} pixels; it has ${buffer.size}.`,
        );
    }
  }

  /** Writes the uniforms of all passes. @returns The share of the filtered image. */
  #write(
    { uniforms, width, height }: Buffers,
    { samples, instancesMoved = false, eyes = NOWHERE, projections }: TemporalFrame,
  ): number {
    const { maxHistory, clampSigmas, settledSamples } = this.#settings;
    // Noise falls with the root of the samples: each doubling of them brings the film as much nearer.
    const settled = Math.log(samples / NOISY_SAMPLES) / Math.log(settledSamples / NOISY_SAMPLES);
    const share = settledSamples === Infinity ? 1 : Math.min(1, Math.max(0, 1 - settled));
    const [projection, before] = projections ?? UNKNOWN;
    const data = new Uint8Array((MAX_PASSES + 1) * ALIGNMENT);
    for (let pass = 0; pass <= MAX_PASSES; pass++) {
      const bytes = temporalFrameStruct.allocate();
      temporalFrameStruct.write(bytes, 0, {
        size: [width, height],
        samples,
        max_history: maxHistory,
        clamp_sigmas: Math.min(clampSigmas, 1e15),
        share,
        eye: eyes[0],
        moved: instancesMoved ? 1 : 0,
        eye_before: eyes[1],
        step: 2 ** pass,
        projection,
        projection_before: before,
        projected: projections ? 1 : 0,
      });
      data.set(new Uint8Array(bytes), pass * ALIGNMENT);
    }
    this.#device.queue.writeBuffer(uniforms, 0, data);
    return share;
  }
}
