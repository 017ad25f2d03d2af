import { join } from 'node:path';
import { FarmError, FolderStore, type JobRenderer } from '@glanz/farm';
import { GlanzError } from '@glanz/scene';
import type { Backend } from '../backend';
import { CliError, describeError, EXIT, exitCodeOf } from '../errors';
import type { CliIo } from '../io';
import type { RenderedImage } from '../output/image';
import { writeImage, isImage } from '../output/write';
import { ProgressReporter, type SampleProgress } from '../progress';
import { writeFilmFile } from '../render/film-file';
import { GpuWorker } from '../render/gpu-worker';
import { imageOfFilm, readFilms, SAMPLES_FROM } from '../render/merged-films';
import { SceneLoader } from '../render/scene';
import { version } from '../version';
import { outputName, shotOf, type JobPayload } from './payload';

class JobProgress extends ProgressReporter {
  onSamples: (samples: number, of: number) => void = () => undefined;

  override samples(progress: SampleProgress): void {
    this.onSamples(progress.samples, progress.targetSamples);
    super.samples(progress);
  }
}

/** Renders the jobs of a farm on one GPU. Images of the same scene, one after another, share a tracer. */
export function farmRenderer(io: CliIo, backend: Backend, gpu: string | undefined): JobRenderer {
  const progress = new JobProgress(io, false);
  let signal = new AbortController().signal;
  const context = {
    io,
    backend,
    progress,
    loader: new SceneLoader(backend, io.cwd),
    keepPartial: false,
    get signal() {
      return signal;
    },
  };
  let worker = new GpuWorker(context, gpu);
  return {
    async render({ job, store: storeFolder, folder, checkpoint }, stop, onProgress) {
      const payload = job.payload as JobPayload;
      if (payload.version !== version())
        throw new CliError(
          'cli/farm',
          `The job is of glanz ${payload.version}, and this is ${version()}: their images may differ. Submit it with the version of the workers.`,
        );
      signal = stop;
      progress.onSamples = onProgress;
      const store = new FolderStore(storeFolder);
      const files = payload.outputs.map((target, i) => outputName(i, target));
      if (job.kind === 'merge') return { files, info: await mergeParts(payload, job.parts ?? [], store, folder) };
      const shot = await shotOf(payload, store, folder, checkpoint);
      const made = await worker.render({ shot, lostGpus: 0 });
      if (!made) {
        // A tracer that was stopped is not used again.
        worker.close();
        worker = new GpuWorker(context, gpu);
        return undefined;
      }
      const { samples, resumedSamples, gpuLosses, adapter } = made;
      return { files, info: { samples, resumedSamples, gpuLosses, gpu: adapter.name } };
    },
    failureOf(error) {
      const { code, message } = describeError(error);
      const exit = exitCodeOf(error);
      const kind =
        exit === EXIT.gpu
          ? 'gpu'
          : exit === EXIT.output || error instanceof FarmError
            ? 'output'
            : exit === EXIT.input || exit === EXIT.usage || code === 'cli/farm'
              ? 'input'
              : 'other';
      if (io.debug || !(error instanceof GlanzError)) io.stderr(`${(error as Error)?.stack ?? String(error)}\n`);
      return { kind, code, message };
    },
  };

  async function mergeParts(payload: JobPayload, parts: readonly string[], store: FolderStore, folder: string) {
    const paths = parts.map((id) => join(store.resultFolder(id), outputName(0, { format: 'film' })));
    const { film, settings } = await readFilms(paths, io.cwd, backend);
    const { options, outputs } = await shotOf(payload, store, folder, undefined);
    const image = outputs.some(isImage) ? await imageOfFilm(film, backend) : undefined;
    const display = { ...options, transparent: options.settings.background === 'transparent' };
    const codec = () => backend.filmCodec();
    for (const target of outputs) {
      if (isImage(target)) await writeImage(image as RenderedImage, target, display, io.cwd);
      else
        await writeFilmFile(
          target.path,
          io.cwd,
          film,
          { ...settings, [SAMPLES_FROM]: String(options.samplesFrom) },
          codec,
        );
    }
    return { samples: film.samples, parts: parts.length };
  }
}
