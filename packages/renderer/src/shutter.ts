import { RenderError } from './errors';
import type { RenderOptions, RenderProgress } from './options';
import type { PathTracer } from './path-tracer';

/** How the samples of an image are distributed over the time in which the shutter is open. */
export interface ShutterSettings {
  /** Samples per pixel of the image, a whole number from 1. */
  readonly samples: number;
  /**
   * Times at which the scene is posed, a whole number from 1, at most one for each sample. Default: one for each sample.
   * Few of them are seen as separate images of what moves.
   */
  readonly times?: number | undefined;
  /** Chooses the times within their strata: for example the number of the frame. Default 0. */
  readonly seed?: number | undefined;
}

/** A time at which the scene is posed. */
export interface ShutterTime {
  /** From 0, where the shutter opens, to 1, where it closes. */
  readonly time: number;
  /** Samples per pixel that the film has when the next time follows. */
  readonly until: number;
}

/** What {@link renderShutter} needs of a tracer. */
export type ShutterTracer = Pick<PathTracer, 'accumulates' | 'render' | 'reset' | 'samples'>;

/** Options for {@link renderShutter}. */
export interface ShutterOptions extends ShutterSettings, Pick<RenderOptions, 'signal' | 'maxSubmitMs'> {
  /**
   * Poses the scene and the camera of the tracer at a time from 0 to 1, by the tracer's edits. Resolves when the image
   * shows them. Called with rising times, perhaps again from the first one.
   */
  readonly pose: (time: number) => void | Promise<void>;
}

/** How often an image begins again because its poses need kernels that are not there yet. */
const MAX_RESTARTS = 3;

/** A number from 0 to below 1, by PCG's output function of two hashed words (Jarzynski and Olano 2020). */
function jitter(seed: number, index: number): number {
  let word = Math.imul((Math.imul(seed, 0x9e3779b1) ^ index) | 0, 747796405) + 2891336453;
  word = Math.imul(((word >>> ((word >>> 28) + 4)) ^ word) | 0, 277803737);
  return (((word >>> 22) ^ word) >>> 0) / 2 ** 32;
}

/**
 * The times of an open shutter, in ascending order: stratified as Cook, Porter and Carpenter (1984) distribute them. The
 * interval is cut into a stratum for each time, as long as its share of the samples, and a time is uniformly distributed
 * in its stratum. The mean over the samples therefore estimates the mean over the interval without bias.
 *
 * Samples follow time in their order. Their random numbers are points of Sobol's sequence, whose prefixes are evenly
 * distributed, so that the numbers together with the time are too (a Hammersley set).
 *
 * @throws {RenderError} `renderer/samples` for numbers out of range
 */
export function shutterTimes({ samples, times = samples, seed = 0 }: ShutterSettings): ShutterTime[] {
  for (const [name, value] of Object.entries({ samples, times }))
    if (!(Number.isInteger(value) && value >= 1))
      throw new RenderError('renderer/samples', `${name} is ${value}; it must be a whole number from 1.`);
  const count = Math.min(times, samples);
  return Array.from({ length: count }, (_, index) => {
    const [from, until] = [index, index + 1].map((i) => Math.floor((i * samples) / count)) as [number, number];
    return { time: (from + (until - from) * jitter(seed, index)) / samples, until };
  });
}

/**
 * Renders an image with motion blur: samples are taken at different times of an open shutter, for each of which the scene
 * is posed, and the film is the mean over them. What moves may be the camera, instances, lights and deformed meshes. A
 * scene that does not move gives the same film as `PathTracer.render`, bit for bit.
 *
 * Each time costs what its edits cost: moved cameras and instances almost nothing, deformed meshes their hierarchies. The
 * samples themselves cost what they cost without motion.
 *
 * Restarts the film. Ends quietly when `signal` aborts, as `PathTracer.render` does.
 *
 * @throws {RenderError} `renderer/samples`; `renderer/shutter` where the film was restarted by others, or by poses that
 * need other kernels each time.
 * @throws what `pose` and `PathTracer.render` throw.
 * @example
 * const pose = (time) => tracer.setInstanceTransform('wheel', turned(0.2 * time));
 * for await (const { samples } of renderShutter(tracer, { samples: 64, pose }));
 */
export async function* renderShutter(
  tracer: ShutterTracer,
  options: ShutterOptions,
): AsyncGenerator<RenderProgress, void, undefined> {
  const { samples, pose, signal, maxSubmitMs } = options;
  const rendering = { ...(signal ? { signal } : {}), ...(maxSubmitMs === undefined ? {} : { maxSubmitMs }) };
  const times = shutterTimes(options);
  const started = performance.now();
  try {
    for (let restarts = 0; restarts <= MAX_RESTARTS; restarts++) {
      tracer.accumulates = false;
      let reached = 0;
      for (const { time, until } of times) {
        if (signal?.aborted) return;
        await pose(time);
        if (reached === 0) tracer.reset();
        // Other kernels have come, and the film has begun again: from the first time on with these.
        else if (tracer.samples !== reached) break;
        tracer.accumulates = true;
        for await (const progress of tracer.render({ samples: until, ...rendering })) {
          const elapsedMs = performance.now() - started;
          const remainingMs =
            progress.samples > 0 ? (elapsedMs * (samples - progress.samples)) / progress.samples : Infinity;
          yield { ...progress, targetSamples: samples, elapsedMs, remainingMs };
        }
        if (signal?.aborted) return;
        reached = until;
        if (tracer.samples !== until) break;
        if (until === samples) return;
      }
    }
  } finally {
    tracer.accumulates = false;
  }
  throw new RenderError(
    'renderer/shutter',
    'The film was restarted while the shutter was open: leave the tracer alone until the image is done, and change its materials and options between images.',
  );
}
