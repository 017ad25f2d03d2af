import type { SentScene } from '@glanz/gltf/workers';
import type { CompressedFormat, Scene } from '@glanz/scene';
import type { PartGroup } from './part-groups';
import type { SampleName } from './samples';

/** A model of the playground. */
export type ModelRequest =
  | { readonly kind: 'sample'; readonly name: SampleName }
  | {
      readonly kind: 'files';
      readonly files: ReadonlyMap<string, Blob>;
      readonly entry: string;
      readonly animation?: number;
      readonly time?: number;
      /** Images are not decoded: a pose has no need of them. */ readonly shapesOnly?: boolean;
    };

/**
 * What the loading worker is asked: a model, with the formats that its images may stay packed in, or all parts that a
 * push-button can be put together from.
 */
export type LoadRequest =
  | (ModelRequest & { readonly compressedFormats?: readonly CompressedFormat[] })
  | { readonly kind: 'kit'; readonly level: 'low' | 'medium' };

/** A scene with the groups of its parts, each before those in it. Default: none. */
export interface GroupedScene extends Scene {
  readonly groups?: readonly PartGroup[];
}

/** What it answers: any number of `progress`, then one of the others. */
export type LoadReply =
  | { readonly kind: 'progress'; readonly stage: string; readonly done: number }
  | { readonly kind: 'scene'; readonly scene: SentScene }
  | { readonly kind: 'error'; readonly message: string; readonly code?: string };
