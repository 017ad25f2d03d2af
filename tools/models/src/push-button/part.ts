import type { MeshBuilder } from '../shapes/mesh-builder';
import type { Tessellation } from '../shapes/tessellation';
import type { MaterialName } from './materials';

/**
 * Where a part sits: its own +z becomes `z`, its own +x becomes `x`, then it moves to `at`. Axes are unit and square to
 * each other.
 */
export interface Placement {
  readonly at?: readonly [number, number, number];
  readonly x?: readonly [number, number, number];
  readonly z?: readonly [number, number, number];
}

/**
 * A named part of the assembly. Millimetres; the axis of the button is +z, towards the user, and the panel's front is z
 * = 0.
 */
export interface Part {
  readonly name: string;
  readonly material: MaterialName;
  readonly placement?: Placement;
  /** Builds the part in its own frame. */
  readonly shape: (builder: MeshBuilder, tessellation: Tessellation) => void;
}

/** Column-major object-to-world matrix of a placement, in metres. */
export function placementMatrix({ at = [0, 0, 0], x = [1, 0, 0], z = [0, 0, 1] }: Placement = {}): number[] {
  const y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]] as const;
  return [...x, 0, ...y, 0, ...z, 0, at[0] / 1000, at[1] / 1000, at[2] / 1000, 1];
}
