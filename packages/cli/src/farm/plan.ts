import { createHash } from 'node:crypto';
import { dirname, relative, resolve } from 'node:path';
import type { BundleFile, FarmRequest, FarmStore } from '@glanz/farm';
import { checkBatchOutputs, openBatch, type BatchRequest } from '../batch-file';
import { isEnvironmentFile } from '../environment';
import { CliError } from '../errors';
import { checkInput, MAX_SETTINGS_BYTES, readInput } from '../input';
import type { RenderCommandOptions, RenderValues } from '../options';
import { shotLabel, shotsOf, type Shot } from '../render/shots';
import { commonOptions, identityOf, type JobPayload } from './payload';
import { version } from '../version';
import { modelFiles } from './model-files';

/** An image of a batch and the jobs that make it: one, or parts and their merge. */
export interface PlannedImage {
  /** From 0, in the order of the batch. */
  readonly index: number;
  /** The job that has the image as its result. */
  readonly id: string;
  /** What is to be queued. */
  readonly requests: readonly FarmRequest[];
  readonly shot: Shot;
  /** Relative to the root. */
  readonly paths: readonly string[];
}

/** What a plan is made of. */
export interface PlanOptions {
  readonly batch: string;
  readonly cwd: string;
  /** What the command line says of images. */
  readonly values: RenderValues & { readonly model?: string | undefined };
  /** The folder below which all files lie. Default: that of the batch. */
  readonly outputRoot: string | undefined;
  /** Maximum samples of a job; images with more are split. */
  readonly split: number | undefined;
  readonly variantsOf: (options: RenderCommandOptions) => Promise<readonly string[]>;
  readonly warn: (text: string) => void;
}

/** Samples are split between whole chunks of the film. */
const CHUNK = 16;

/** A batch: checked as a whole, then planned image by image. */
export class FarmPlan {
  readonly #options: PlanOptions;
  readonly #requests: () => Iterable<BatchRequest>;
  readonly #scenes = new Map<string, Promise<JobPayload['scene']>>();
  readonly #common = new Map<RenderCommandOptions, Promise<string>>();
  readonly #variants = new Map<string, Promise<readonly string[]>>();
  readonly #version = version();
  #warnedSplit = false;

  private constructor(options: PlanOptions, requests: () => Iterable<BatchRequest>) {
    this.#options = options;
    this.#requests = requests;
  }

  /** Reads a batch file. @throws {CliError} `cli/input`, `cli/batch` */
  static async open(options: PlanOptions): Promise<FarmPlan> {
    const { batch, cwd, values, warn } = options;
    return new FarmPlan(options, await openBatch(batch, cwd, values, warn));
  }

  /** Absolute. */
  get outputRoot(): string {
    const { outputRoot, batch, cwd } = this.#options;
    return resolve(cwd, outputRoot ?? dirname(batch));
  }

  /**
   * Goes through all images before anything is queued: files that can be read, outputs below the root, no two of the
   * same name.
   *
   * @returns The number of images.
   * @throws {CliError} `cli/input`, `cli/batch`, `cli/usage`
   */
  async check(): Promise<number> {
    const { batch, cwd } = this.#options;
    const root = this.outputRoot;
    const readable = new Set<string>();
    // Hashes: a hundred thousand paths take less memory.
    const seen = new Set<string>();
    let count = 0;
    for (const request of this.#requests()) {
      const { model, env } = request.options;
      for (const [file, what] of [[model, 'the model'] as const, [env, 'the environment'] as const]) {
        if (file === undefined || readable.has(file) || (file === env && !isEnvironmentFile(env))) continue;
        await checkInput(file, cwd, what);
        readable.add(file);
      }
      const folders = new Set<string>();
      for (const { outputs } of await this.#shots(request)) {
        count++;
        for (const { path } of outputs) {
          const hash = createHash('sha1').update(resolve(cwd, path)).digest('base64').slice(0, 16);
          if (seen.has(hash))
            throw new CliError(
              'cli/usage',
              `Two images would be written to "${path}": put {model}, {variant} or {view} into the name, or give each its own.`,
            );
          seen.add(hash);
          const folder = dirname(path);
          if (folders.has(folder)) continue;
          folders.add(folder);
          await checkBatchOutputs([path], request, batch, cwd, root);
        }
      }
    }
    return count;
  }

  /** All images, one by one. Models and environments are put into the store as they come. */
  async *images(store: FarmStore): AsyncGenerator<PlannedImage> {
    let index = 0;
    for (const request of this.#requests())
      for (const shot of await this.#shots(request)) yield await this.#planned(shot, index++, store);
  }

  async #shots({ options }: BatchRequest): Promise<Shot[]> {
    if (!options.variants.includes('all')) return shotsOf(options);
    const key = JSON.stringify([options.model, options.pose]);
    let names = this.#variants.get(key);
    if (!names) this.#variants.set(key, (names = this.#options.variantsOf(options)));
    return shotsOf(options, await names);
  }

  async #planned(shot: Shot, index: number, store: FarmStore): Promise<PlannedImage> {
    const { cwd } = this.#options;
    const { options, variant, view } = shot;
    const { env } = options;
    const root = this.outputRoot;
    const paths = shot.outputs.map(({ path }) => relative(root, resolve(cwd, path)));
    const whole: JobPayload = {
      version: this.#version,
      scene: await this.#scene(options.model, store),
      ...(isEnvironmentFile(env) ? { env: await this.#environment(env, store) } : {}),
      options: await this.#commonOf(options, store),
      ...(variant === undefined ? {} : { variant }),
      view: await this.#viewOf(view),
      outputs: shot.outputs.map(({ format, bits }) => ({ format, bits })),
    };
    const label = shotLabel({
      ...shot,
      outputs: shot.outputs.map((target, i) => ({ ...target, path: paths[i] as string })),
    });
    const destination = { root, paths };
    const ranges = this.#ranges(options);
    if (ranges.length < 2) {
      const id = identityOf('image', whole);
      const requests = [{ job: { id, kind: 'image' as const, label, payload: whole }, destination }];
      return { index, id, requests, shot, paths };
    }
    const parts = ranges.map((range) => {
      const payload: JobPayload = { ...whole, outputs: [{ format: 'film', bits: 32 }], range };
      return { id: identityOf('part', payload), payload, range };
    });
    const ids = parts.map(({ id }) => id);
    const id = identityOf('merge', whole, ids);
    const merge = { id, kind: 'merge' as const, label, payload: whole, parts: ids };
    const requests = parts.map(({ id: partId, payload, range: { from, samples } }) => ({
      job: {
        id: partId,
        kind: 'part' as const,
        label: `${label} · samples ${from}–${from + samples - 1}`,
        payload,
        merge,
      },
      destination,
    }));
    return { index, id, requests, shot, paths };
  }

  #ranges({ settings, samplesFrom }: RenderCommandOptions): { from: number; samples: number }[] {
    const { split } = this.#options;
    const all = [{ from: samplesFrom, samples: settings.samples }];
    if (split === undefined || settings.samples <= split) return all;
    if ((settings.noise ?? 0) > 0) {
      if (!this.#warnedSplit)
        this.#options.warn(
          'images with --noise are not split: which pixels need more samples shows in the film as a whole.',
        );
      this.#warnedSplit = true;
      return all;
    }
    const step = Math.max(CHUNK, Math.ceil(split / CHUNK) * CHUNK);
    const ranges = [];
    for (let done = 0; done < settings.samples; done += step)
      ranges.push({ from: samplesFrom + done, samples: Math.min(step, settings.samples - done) });
    return ranges;
  }

  #scene(model: string, store: FarmStore): Promise<JobPayload['scene']> {
    return this.#bundle(model, store, async (path) => modelFiles(path));
  }

  #environment(env: string, store: FarmStore): Promise<JobPayload['scene']> {
    return this.#bundle(env, store, async (path) => {
      const main = `environment${/\.\w+$/.exec(path)?.[0].toLowerCase() ?? ''}`;
      return { main, files: [{ name: main, path }] };
    });
  }

  #bundle(
    file: string,
    store: FarmStore,
    filesOf: (path: string) => Promise<{ readonly main: string; readonly files: readonly BundleFile[] }>,
  ): Promise<JobPayload['scene']> {
    let scene = this.#scenes.get(file);
    if (!scene) {
      scene = filesOf(resolve(this.#options.cwd, file)).then(async ({ main, files }) => ({
        bundle: await store.putBundle(files),
        file: main,
      }));
      this.#scenes.set(file, scene);
    }
    return scene;
  }

  #commonOf(options: RenderCommandOptions, store: FarmStore): Promise<string> {
    let hash = this.#common.get(options);
    if (!hash) {
      // The rows of a large batch come one after another: only the last one is looked for again.
      this.#common.clear();
      this.#common.set(options, (hash = store.put(JSON.stringify(commonOptions(options)))));
    }
    return hash;
  }

  /** A camera in a file becomes part of the job. */
  async #viewOf(view: Shot['view']): Promise<Shot['view']> {
    if (view.kind !== 'camera' || !view.camera || !/\.json$/i.test(view.camera)) return view;
    const { cwd } = this.#options;
    const bytes = await readInput(view.camera, cwd, 'the camera', { maxBytes: MAX_SETTINGS_BYTES }).catch(
      () => undefined,
    );
    // No such file: a camera of the model may be called like this.
    return bytes ? { ...view, camera: new TextDecoder().decode(bytes).trim() } : view;
  }
}
