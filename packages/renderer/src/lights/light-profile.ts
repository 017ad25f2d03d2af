import type { LightProfile } from '@glanz/scene';
import { lightStruct, PROFILE_HORIZONTAL, PROFILE_VERTICAL } from '../storage/layout';

/** A profile on the grid that the kernels read: for each angle around the axis those from it. */
export interface ProfileGrid {
  /** Angles around the axis: 1, or as many as the grid has. */
  readonly around: number;
  /** W/sr, stride `PROFILE_VERTICAL`. */
  readonly intensities: Float32Array;
  readonly largest: number;
  /** Radiant flux, W. */
  readonly power: number;
  /** The largest angle from the axis at which it shines, radians. */
  readonly reach: number;
}

/** Where a value lies among rising ones: the index below it, and how far it is to the next one. */
function between(values: Float32Array, value: number): readonly [below: number, share: number] {
  let below = 0;
  while (below < values.length - 2 && (values[below + 1] as number) <= value) below++;
  const [a, b] = [values[below] as number, values[below + 1] as number];
  return [below, (value - a) / (b - a)];
}

/** Puts a profile on the grid, linear in both angles. */
export function profileGrid({ vertical, horizontal, intensities }: LightProfile): ProfileGrid {
  const count = vertical.length;
  const around = horizontal.length > 1 ? PROFILE_HORIZONTAL : 1;
  const out = new Float32Array(around * PROFILE_VERTICAL);
  const [first, last] = [vertical[0] as number, vertical.at(-1) as number];
  // Once around: the first angle again at the end.
  const full = Float32Array.from([...horizontal, 2 * Math.PI]);
  let largest = 0,
    power = 0,
    reach = 0;
  for (let j = 0; j < around; j++) {
    const [below, share] = around > 1 ? between(full, (2 * Math.PI * j) / around) : [0, 0];
    const above = (below + 1) % horizontal.length;
    for (let i = 0; i < PROFILE_VERTICAL; i++) {
      const angle = (Math.PI * i) / (PROFILE_VERTICAL - 1);
      // Files give degrees: their last angle is one of the grid's, but for rounding.
      if (angle < first - 1e-5 || angle > last + 1e-5) continue;
      const [row, along] = between(vertical, Math.min(Math.max(angle, first), last));
      const at = (column: number) =>
        (intensities[column * count + row] as number) * (1 - along) +
        (intensities[column * count + row + 1] as number) * along;
      const value = at(below) * (1 - share) + at(above) * share;
      out[j * PROFILE_VERTICAL + i] = value;
      if (value > 0) reach = Math.max(reach, Math.min(Math.PI, angle + Math.PI / (PROFILE_VERTICAL - 1)));
      largest = Math.max(largest, value);
      power += (value * Math.sin(angle) * Math.PI * 2 * Math.PI) / ((PROFILE_VERTICAL - 1) * around);
    }
  }
  return { around, intensities: out, largest, power, reach };
}

/** How many light records a grid takes: four intensities each, where those of meshes have their numbers. */
export const profileRecords = ({ intensities }: ProfileGrid): number => Math.ceil(intensities.length / 4);

/** Writes a grid into light records from `first` on. */
export function writeProfile(records: ArrayBuffer, first: number, { intensities }: ProfileGrid): void {
  const floats = new Float32Array(records);
  const [words, ids] = [lightStruct.size / 4, lightStruct.offsetOf('ids') / 4];
  intensities.forEach((value, i) => (floats[(first + (i >> 2)) * words + ids + (i & 3)] = value));
}
