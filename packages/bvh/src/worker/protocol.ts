import { GlanzError } from '@glanz/wgsl/error';
import type { Blas, BlasOptions } from '../blas';
import type { TriangleMesh } from '../layout';
import type { TreeBuilder } from '../builders/builder';
import { BvhError } from '../error';
import type { TeamMemory } from './team';

/** Options as messages: functions cannot be cloned, so a builder from its own entry is sent by name. */
export type SentOptions = Omit<BlasOptions, 'builder'> & { readonly builder?: 'balanced' | TreeBuilder['name'] };

export function sendableOptions({ builder, ...others }: BlasOptions): SentOptions {
  return builder === undefined ? others : { ...others, builder: typeof builder === 'object' ? builder.name : builder };
}

/** To a worker. */
export type BuildRequest =
  | { readonly kind: 'build'; readonly id: number; readonly mesh: TriangleMesh; readonly options: SentOptions }
  /** For one of two workers that build together; the mesh is in shared memory. */
  | {
      readonly kind: 'together';
      readonly id: number;
      readonly mesh: TriangleMesh;
      readonly options: SentOptions;
      readonly index: number;
      readonly memory: TeamMemory;
    }
  | { readonly kind: 'warm-up' };

/** From a worker. `ready` comes once, before all others. */
export type BuildReply =
  | { readonly kind: 'ready' }
  /** The warm-up has finished, or real builds have replaced it. */
  | { readonly kind: 'warmed' }
  | { readonly kind: 'started'; readonly id: number }
  | { readonly kind: 'built'; readonly id: number; readonly blas: Blas }
  /** The second of two has done its part, or has stopped because the first did. */
  | { readonly kind: 'helped'; readonly id: number }
  | { readonly kind: 'failed'; readonly id: number; readonly error: SentError };

/** An error as a message: structured cloning would drop the class and the code. */
export interface SentError {
  /** Absent: not a `GlanzError`. */
  readonly code?: string;
  readonly message: string;
}

export function sendableError(error: unknown): SentError {
  if (error instanceof GlanzError) return { code: error.code, message: error.message };
  return { message: error instanceof Error ? error.message : String(error) };
}

export function receivedError({ code, message }: SentError): BvhError {
  return code === undefined
    ? new BvhError('bvh/worker', `A build failed in its worker: ${message}`)
    : new BvhError(code, message);
}

/** The buffers behind some arrays, each once, without shared ones. */
export function buffersOf(...arrays: readonly (ArrayBufferView | undefined)[]): ArrayBuffer[] {
  const buffers = new Set<ArrayBuffer>();
  for (const array of arrays) if (array?.buffer instanceof ArrayBuffer) buffers.add(array.buffer);
  return [...buffers];
}
