// What is made of the film's noise. Loaded when a render with a noise target first looks at it.

/** How noisy each tile of an image is. */
export interface NoiseMap {
  /** Per tile: relative error, see {@link noiseMap}. */
  readonly tiles: Float64Array;
  /** Root of the mean of the squares. */
  readonly whole: number;
}

/**
 * Relative errors from sums over tiles: the root of a tile's mean variance over its mean square, the latter with a
 * hundredth of the image's added, so that blackness does not ask for the impossible.
 *
 * @param sums Per tile: variance, square of the mean, pixels; stride 4.
 */
export function noiseMap(sums: Float32Array): NoiseMap {
  let square = 0;
  let pixels = 0;
  for (let at = 0; at < sums.length; at += 4) {
    square += sums[at + 1] as number;
    pixels += sums[at + 2] as number;
  }
  const floor = (0.01 * square) / pixels;
  const tiles = new Float64Array(sums.length / 4);
  let whole = 0;
  for (let tile = 0; tile < tiles.length; tile++) {
    const [variance, bright, count] = sums.subarray(4 * tile, 4 * tile + 3) as unknown as [number, number, number];
    const error = variance > 0 ? variance / (bright + floor * count) : 0;
    tiles[tile] = Math.sqrt(error);
    whole += error * count;
  }
  return { tiles, whole: Math.sqrt(whole / pixels) };
}

/**
 * The tiles that need more samples: those noisier than the target, and those beside one that is twice as noisy. The
 * second rule catches tiles that look calm because they have not seen the light yet that their neighbours have.
 */
export function noisyTiles(errors: Float64Array, columns: number, target: number): number[] {
  const rows = errors.length / columns;
  const found: number[] = [];
  for (let tile = 0; tile < errors.length; tile++) {
    const [x, y] = [tile % columns, Math.floor(tile / columns)];
    let worst = errors[tile] as number;
    for (let dy = -1; dy <= 1; dy++) {
      for (let dx = -1; dx <= 1; dx++) {
        if (x + dx < 0 || x + dx >= columns || y + dy < 0 || y + dy >= rows) continue;
        worst = Math.max(worst, 0.5 * (errors[tile + dy * columns + dx] as number));
      }
    }
    if (worst > target) found.push(tile);
  }
  return found;
}

/**
 * Samples still to be taken in all, if errors go down as the root of the number of samples.
 *
 * @param max Samples that no pixel gets more of.
 * @param nextCheck That of `adaptive.ts`; imported, it would split the first script in two.
 */
export function samplesLeft(
  tiles: readonly number[],
  errors: Float64Array,
  target: number,
  max: number,
  samplesOf: (tile: number) => number,
  pixelsOf: (tile: number) => number,
  nextCheck: (samples: number) => number,
): number {
  let left = 0;
  for (const tile of tiles) {
    const samples = samplesOf(tile);
    const requested = samples * ((errors[tile] as number) / target) ** 2;
    // Tiles end at the next look, not before.
    left +=
      Math.max(0, Math.min(max, nextCheck(Math.max(samples, Math.ceil(requested) - 1))) - samples) * pixelsOf(tile);
  }
  return left;
}
