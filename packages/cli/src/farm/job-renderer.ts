import type { BlasCache } from '@glanz/bvh/cache';
import { FarmError, openFarmStore, type FarmStore, type JobRenderer, type StoreAddress } from '@glanz/farm';
import { GlanzError } from '@glanz/scene';
import type { Backend } from '../backend';
import { CliError, describeError, EXIT, exitCodeOf } from '../errors';
import type { CliIo } from '../io';
import type { RenderedImage } from '../output/image';
import { writeImage, isImage } from '../output/write';
import { ProgressReporter, type SampleProgress } from '../progress';
import { writeFilmFile } from '../render/film-file';
import { GpuWorker } from '../render/gpu-worker';
import { areImagesOnly, imageOfFilm, readFilms, SAMPLES_FROM, type MergedFilms } from '../render/merged-films';
import { SceneLoader } from '../render/scene';
import type { Shot } from '../render/shots';
import { version } from '../version';
import { outputName, shotOf, type JobPayload } from './payload';

class JobProgress extends ProgressReporter {
  onSamples: (samples: number, of: number) => void = () => undefined;

  override samples(progress: SampleProgress): void {
    this.onSamples(progress.samples, progress.targetSamples);
    super.samples(progress);
  }
}

/** Hierarchies of a store, which all its workers share. */
async function storedHierarchies(store: FarmStore, onError: (error: unknown) => void): Promise<BlasCache> {
  const [{ buildBlas }, { BlasCache }] = await Promise.all([import('@glanz/bvh'), import('@glanz/bvh/cache')]);
  return new BlasCache(store.hierarchies, { buildBlas }, { onError });
}

/**
 * Renders the jobs of a farm on one GPU. Images of the same scene, one after another, share a tracer, and hierarchies
 * that another worker has built are read from the store.
 */
export function farmRenderer(io: CliIo, backend: Backend, gpu: string | undefined): JobRenderer {
  const progress = new JobProgress(io, false);
  let signal = new AbortController().signal;
  let hierarchies: BlasCache | undefined;
  const context = {
    io,
    backend,
    progress,
    loader: new SceneLoader(backend, io.cwd),
    keepPartial: false,
    get signal() {
      return signal;
    },
    get hierarchies() {
      return hierarchies;
    },
  };
  let worker = new GpuWorker(context, gpu);
  let opened: { readonly key: string; readonly store: Promise<FarmStore> } | undefined;
  const storeAt = async (address: StoreAddress): Promise<FarmStore> => {
    const key = JSON.stringify(address);
    if (opened?.key !== key) opened = { key, store: openFarmStore(address) };
    // One that cannot be opened is tried again with the next job.
    return opened.store.catch((error: unknown) => {
      opened = undefined;
      throw error;
    });
  };
  return {
    async render({ job, store: address, folder, checkpoint }, stop, onProgress) {
      const payload = job.payload as JobPayload;
      if (payload.version !== version())
        throw new CliError(
          'cli/farm',
          `The job was submitted with glanz ${payload.version}, and this is glanz ${version()}: their images may differ. Submit it with the version of the workers.`,
        );
      signal = stop;
      progress.onSamples = onProgress;
      const store = await storeAt(address);
      hierarchies = await storedHierarchies(store, (error) => progress.warning(describeError(error).message));
      const files = payload.outputs.map((target, i) => outputName(i, target));
      const shot = {
        ...(await shotOf(payload, store, folder, job.kind === 'merge' ? undefined : checkpoint)),
        label: job.label,
      };
      const imageOnly = shot.options.denoise === undefined && areImagesOnly(shot.outputs);
      const merged = job.kind === 'merge' ? await readParts(job.parts ?? [], store, imageOnly) : undefined;
      if (merged && shot.options.denoise === undefined)
        return { files, info: await writeMerged(merged, shot, job.parts?.length ?? 0) };
      // Denoising needs the scene: a merged film is one whose samples are all there.
      const made = await worker.render({ shot, lostGpus: 0, ...(merged ? { film: merged.film } : {}) });
      await hierarchies.written();
      if (!made) {
        // A tracer that was stopped is not used again.
        worker.close();
        worker = new GpuWorker(context, gpu);
        return undefined;
      }
      const { samples, resumedSamples, gpuLosses, adapter } = made;
      const hashed = made.files.flatMap(({ sha256 }, i) => (sha256 === undefined ? [] : [[files[i], sha256] as const]));
      return {
        files,
        hashes: Object.fromEntries(hashed),
        info: {
          samples,
          resumedSamples,
          gpuLosses,
          gpu: adapter.name,
          ...(merged ? { parts: job.parts?.length } : {}),
        },
      };
    },
    failureOf(error) {
      const { code, message } = describeError(error);
      const exit = exitCodeOf(error);
      const kind =
        exit === EXIT.gpu
          ? 'gpu'
          : code === 'farm/missing-file'
            ? 'files'
            : exit === EXIT.output || error instanceof FarmError
              ? 'output'
              : exit === EXIT.input || exit === EXIT.usage || code === 'cli/farm'
                ? 'input'
                : 'other';
      if (io.debug || !(error instanceof GlanzError)) io.stderr(`${(error as Error)?.stack ?? String(error)}\n`);
      return { kind, code, message };
    },
  };

  async function readParts(parts: readonly string[], store: FarmStore, imageOnly: boolean): Promise<MergedFilms> {
    const paths = await Promise.all(parts.map((id) => store.resultFile(id, outputName(0, { format: 'film' }))));
    return readFilms(paths, io.cwd, backend, imageOnly);
  }

  async function writeMerged(merged: MergedFilms, { options, outputs }: Shot, parts: number) {
    const { film, settings } = merged;
    const image = outputs.some(isImage) ? await imageOfFilm(merged, outputs, backend) : undefined;
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
    return { samples: film.samples, parts };
  }
}
