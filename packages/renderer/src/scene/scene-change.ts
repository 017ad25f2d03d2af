import type { EditEffect, Move } from '../film/edit-effect';

/** A change of the scene that is ready to be made: what takes time has been done, and nothing has been changed yet. */
export interface SceneChange {
  /** Whether another change has been made since, which this one does not take into account. */
  readonly isStale: () => boolean;
  /** Makes it, in the scene and on the GPU. @returns Whether buffers or textures were replaced. */
  readonly apply: () => boolean;
  /** Takes the scene back to what it was before. */
  readonly undo: () => void;
  /** What it does to the film's samples; default `invalidates`. */
  readonly effect?: EditEffect;
  /** The instances that it moves. */
  readonly moves?: readonly Move[];
  /** Writes shapes to the GPU again that it has overwritten, once everything else has been taken back. */
  readonly rewrite?: () => void;
}
