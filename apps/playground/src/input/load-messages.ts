import type { SentScene } from '@glanz/gltf/workers';
import type { SampleName } from './samples';

/** What the loading worker is asked. */
export type LoadRequest =
  | { readonly kind: 'sample'; readonly name: SampleName }
  | { readonly kind: 'files'; readonly files: ReadonlyMap<string, Blob>; readonly entry: string; readonly animation?: number; readonly time?: number };

/** What it answers: any number of `progress`, then one of the others. */
export type LoadReply =
  | { readonly kind: 'progress'; readonly stage: string; readonly done: number }
  | { readonly kind: 'scene'; readonly scene: SentScene }
  | { readonly kind: 'error'; readonly message: string; readonly code?: string };
