import { angle } from './units';

type Triple = readonly [number, number, number];

const parts = (text: string) => text.trim().split(/\s+/).filter(Boolean);

/** Roll, pitch and yaw in radians; `undefined` where the text is something else. */
export function readOrientation(text: string): Triple | undefined {
  const angles = parts(text).map(angle);
  return angles.length === 3 && angles.every((one) => one !== undefined) ? (angles as unknown as Triple) : undefined;
}

/** Factors along x, y and z; `undefined` where the text is something else. */
export function readScale(text: string): Triple | undefined {
  const factors = parts(text).map(Number);
  const [x = 0] = factors;
  const good = factors.every((one) => one !== 0 && Math.abs(one) < 1e9);
  if (!good || (factors.length !== 1 && factors.length !== 3)) return undefined;
  return factors.length === 1 ? [x, x, x] : (factors as unknown as Triple);
}

/**
 * The matrix that `orientation` and `scale` mean, as in model-viewer: scaled along its own axes, then rolled about +Z,
 * pitched about +X and yawed about +Y. `undefined`: as the file has it.
 */
export function placementOf(orientation: string | null, scale: string | null): number[] | undefined {
  const turned = readOrientation(orientation ?? '');
  const scaled = readScale(scale ?? '');
  if (!turned && !scaled) return undefined;
  const [roll, pitch, yaw] = turned ?? [0, 0, 0];
  const [x, y, z] = scaled ?? [1, 1, 1];
  const [sr, cr, sp, cp, sy, cy] = [roll, pitch, yaw].flatMap((one) => [Math.sin(one), Math.cos(one)]) as [
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  // Columns of Ry · Rx · Rz.
  const axes = [
    [cy * cr + sy * sp * sr, cp * sr, cy * sp * sr - sy * cr, x],
    [sy * sp * cr - cy * sr, cp * cr, sy * sr + cy * sp * cr, y],
    [sy * cp, -sp, cy * cp, z],
  ] as const;
  return [...axes.flatMap(([a, b, c, factor]) => [a * factor, b * factor, c * factor, 0]), 0, 0, 0, 1];
}
