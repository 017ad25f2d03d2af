import { ThreeError } from '../error';

/** Checks a number that is set. @throws {ThreeError} `three/option` */
export function checkNumber(name: string, value: number, min: number, max = Infinity): number {
  if (typeof value === 'number' && value >= min && value <= max) return value;
  throw new ThreeError('three/option', `${name} must be a number from ${min} to ${max}, not ${String(value)}.`);
}

/** Edges of a path. */
const MAX_DEPTH = 65_535;

/**
 * The longest path, in edges, for what three-gpu-pathtracer calls bounces: `bounces` surfaces after the camera, and
 * `transmissive` more where a material transmits light.
 */
export const depthOf = (bounces: number, transmissive: number, transmits: boolean): number =>
  Math.max(1, Math.min(MAX_DEPTH, Math.round(bounces + (transmits ? transmissive : 0))));

/** What is reported once: the console gets each message a single time. */
export class Reports {
  readonly #known = new Set<string>();

  warn(message: string): void {
    if (this.#known.has(message)) return;
    this.#known.add(message);
    // oxlint-disable-next-line no-console -- the interface that this stands for has no other place for it
    console.warn(message);
  }

  error(error: unknown): void {
    const message = error instanceof Error ? error.message : String(error);
    if (this.#known.has(message)) return;
    this.#known.add(message);
    // oxlint-disable-next-line no-console -- as above
    console.error(error);
  }
}
