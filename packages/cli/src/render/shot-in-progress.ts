import type { Backend, FilmState } from '../backend';
import type { CliIo } from '../io';
import type { ProgressReporter } from '../progress';
import { CheckpointFile } from './checkpoint-file';
import { Checkpoints } from './checkpoints';
import type { Job } from './queue';
import type { RenderTimings } from './results';
import type { Shot } from './shots';

/** Runs a stage and adds its time to one of the timings. */
export type Timed = <T>(key: keyof RenderTimings, run: () => Promise<T>) => Promise<T>;

/** An image that is being rendered, across devices. */
export interface ShotInProgress {
  readonly shot: Shot;
  readonly start: number;
  readonly timings: RenderTimings;
  readonly timed: Timed;
  readonly checkpoints: Checkpoints;
  readonly file: CheckpointFile | undefined;
  /** Samples that this run did not make. */
  readonly resumed: number;
  /** What the file had in it. */
  readonly read: FilmState | undefined;
  readonly lossesBefore: number;
  noise: number | undefined;
}

/** What {@link beginShot} works with. */
interface ShotContext {
  readonly io: CliIo;
  readonly backend: Backend;
  readonly progress: ProgressReporter;
}

/**
 * Reads the checkpoint of an image, if it has one.
 *
 * @param job Its film, where there is one, is where rendering begins.
 * @param losses How often the GPU has been lost before.
 */
export async function beginShot(
  { shot, film }: Job,
  { io, progress, backend }: ShotContext,
  losses: number,
): Promise<ShotInProgress> {
  const start = io.now();
  const timings: RenderTimings = {
    loadMs: 0,
    environmentMs: 0,
    deviceMs: 0,
    prepareMs: 0,
    renderMs: 0,
    readMs: 0,
    denoiseMs: 0,
    writeMs: 0,
    totalMs: 0,
  };
  const timed: Timed = async (key, run) => {
    const from = io.now();
    try {
      return await run();
    } finally {
      timings[key] += io.now() - from;
    }
  };
  const codec = () => backend.filmCodec();
  const file = shot.checkpoint === undefined ? undefined : new CheckpointFile(shot.checkpoint, shot, io.cwd);
  const read = film ? undefined : await file?.read(codec);
  if (read) progress.line(`${shot.checkpoint}: going on from sample ${read.samples}`);
  const resumed = film ?? read;
  const checkpoints = new Checkpoints(
    { io, progress, codec, file, pixels: shot.options.width * shot.options.height },
    resumed,
    read,
  );
  return {
    shot,
    start,
    timings,
    timed,
    checkpoints,
    file,
    resumed: resumed?.samples ?? 0,
    read,
    lossesBefore: losses,
    noise: undefined,
  };
}
