import { resolve } from 'node:path';
import { contentId, type FarmStore } from '@glanz/farm';
import { isEnvironmentFile } from '../environment';
import type { RenderCommandOptions } from '../options';
import type { OutputTarget } from '../output/formats';
import type { Shot } from '../render/shots';
import type { View } from '../views';

/** What a renderer's process gets of a job. Files are named by their content. */
export interface JobPayload {
  readonly version: string;
  /** The model: a bundle of the store, and the file in it. */
  readonly scene: { readonly bundle: string; readonly file: string };
  /** An environment's file. */
  readonly env?: { readonly bundle: string; readonly file: string };
  /** An object of the store: the options that all images of a row have in common. */
  readonly options: string;
  readonly variant?: string;
  readonly view: View;
  readonly outputs: readonly Pick<OutputTarget, 'format' | 'bits'>[];
  /** Of a part: its samples. */
  readonly range?: { readonly from: number; readonly samples: number };
}

/** The options of a row without its files and without what tells its images apart. */
export const commonOptions = (options: RenderCommandOptions): RenderCommandOptions => ({
  ...options,
  model: '',
  env: isEnvironmentFile(options.env) ? '' : options.env,
  variants: [],
  views: [],
  outputs: [],
});

/** What decides the pixels of a job's files. The name of a view does not. */
export function identityOf(kind: string, { view, ...payload }: JobPayload, parts?: readonly string[]): string {
  const { name: _name, ...camera } = view;
  return contentId({ kind, ...payload, view: camera, parts });
}

/** The file of a job's result. */
export const outputName = (index: number, { format }: Pick<OutputTarget, 'format'>): string => `${index}.${format}`;

/**
 * The image that a payload asks for, with its files in a folder.
 *
 * @param checkpoint Where its samples are kept when it is stopped.
 */
export async function shotOf(
  payload: JobPayload,
  store: FarmStore,
  folder: string,
  checkpoint: string | undefined,
): Promise<Shot> {
  const { denoise, ...common } = JSON.parse(
    new TextDecoder().decode(await store.read(payload.options)),
  ) as RenderCommandOptions;
  const file = async ({ bundle, file: name }: JobPayload['scene']) => resolve(await store.bundle(bundle), name);
  const { range } = payload;
  const outputs = payload.outputs.map(({ format, bits }, i) => ({
    path: resolve(folder, outputName(i, { format })),
    format,
    bits,
  }));
  return {
    options: {
      ...common,
      model: await file(payload.scene),
      env: payload.env ? await file(payload.env) : common.env,
      views: [payload.view],
      outputs,
      // Parts are denoised when they have been merged.
      ...(range
        ? { samplesFrom: range.from, settings: { ...common.settings, samples: range.samples } }
        : denoise === undefined
          ? {}
          : { denoise }),
    },
    variant: payload.variant,
    view: payload.view,
    outputs,
    checkpoint,
    isPart: range !== undefined,
  };
}
