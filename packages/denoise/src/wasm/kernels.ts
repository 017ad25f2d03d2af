import { assemble, op, type Code, type WasmFunction } from './assembler';

/** Pixels and vectors of four output channels that the loop of a convolution keeps in registers. */
export const TILE_PIXELS = 4;
const TILE_VECTORS = 2;
/** Output channels of one call. */
export const BLOCK = 4 * TILE_VECTORS;
/** Floats of a source that one round of the innermost loop takes: channels of pixels are padded to these. */
export const ROUND = 4;

/** Bytes of a row of the table that describes sources to `convolve`. */
export const SOURCE_BYTES = 16;

/**
 * `convolve(result, step, tiles, bias, table, sources)`: `BLOCK` output channels of `4 × tiles` pixels, with ReLU.
 *
 * - `result`, `step`: address of the first pixel's block, and bytes to that of the next pixel
 * - `bias`: address of `BLOCK` floats
 * - `table`, `sources`: address and number of rows `[address, step, rounds, weights]`. A row says that each pixel's sum
 *   gets the products of `4 × rounds` floats in a row, `[column of the kernel][channel]`, and their weights. Those of
 *   the first pixel begin at `address`, those of the next `step` bytes later. Addresses move on with the tiles.
 *
 * For each float of a source `BLOCK` weights are loaded once for four pixels, whose sums stay in registers: sixteen
 * vectors, as processors have them, hold sums, weights and a splat.
 */
function convolve(fused: boolean): WasmFunction {
  const [result, step, tiles, bias, table, sources] = [0, 1, 2, 3, 4, 5] as const;
  const parameters = 6;
  const pixels = Array.from({ length: TILE_PIXELS }, (_, i) => i);
  const vectors = Array.from({ length: TILE_VECTORS }, (_, i) => i);
  const [row, rows, rounds, distance, weights] = [6, 7, 8, 9, 10] as const;
  const addressOf = (pixel: number) => 11 + pixel;
  const integers = 5 + TILE_PIXELS;
  const firstVector = parameters + integers;
  const sumOf = (pixel: number, vector: number) => firstVector + pixel * TILE_VECTORS + vector;
  const weightOf = (vector: number) => firstVector + TILE_PIXELS * TILE_VECTORS + vector;
  const splat = weightOf(TILE_VECTORS);

  const add = (pixel: number, vector: number): Code => [
    [op.get(splat), op.get(weightOf(vector))],
    fused
      ? [op.get(sumOf(pixel, vector)), op.multiplyAdd]
      : [op.multiplyVectors, op.get(sumOf(pixel, vector)), op.addVectors],
    op.set(sumOf(pixel, vector)),
  ];
  const float = (i: number): Code => [
    vectors.map((v) => [op.get(weights), op.loadVector(4 * (i * BLOCK + 4 * v)), op.set(weightOf(v))]),
    pixels.map((p) => [[op.get(addressOf(p)), op.loadSplat(4 * i), op.set(splat)], vectors.map((v) => add(p, v))]),
  ];
  const round: Code = [
    Array.from({ length: ROUND }, (_, i) => float(i)),
    pixels.map((p) => op.advance(addressOf(p), 4 * ROUND)),
    op.advance(weights, 4 * ROUND * BLOCK),
  ];
  const source: Code = [
    [op.get(row), op.load(4), op.set(distance)],
    [op.get(row), op.load(0), op.set(addressOf(0))],
    pixels.slice(1).map((p) => [op.get(addressOf(p - 1)), op.get(distance), op.add, op.set(addressOf(p))]),
    [op.get(row), op.get(addressOf(TILE_PIXELS - 1)), op.get(distance), op.add, op.store(0)],
    [op.get(row), op.load(8), op.set(rounds)],
    [op.get(row), op.load(12), op.set(weights)],
    op.countdown(rounds, round),
    op.advance(row, SOURCE_BYTES),
  ];
  const tile: Code = [
    pixels.map((p) => vectors.map((v) => [op.get(bias), op.loadVector(16 * v), op.set(sumOf(p, v))])),
    [op.get(table), op.set(row), op.get(sources), op.set(rows)],
    op.countdown(rows, source),
    pixels.map((p) => [
      vectors.map((v) => [[op.get(result), op.get(sumOf(p, v)), op.zeros, op.maxVectors], op.storeVector(16 * v)]),
      [op.get(result), op.get(step), op.add, op.set(result)],
    ]),
  ];
  const body = op.countdown(tiles, tile);
  return { name: 'convolve', parameters, integers, vectors: TILE_PIXELS * TILE_VECTORS + TILE_VECTORS + 1, body };
}

/**
 * `pool(result, above, below, pixels, vectors)`: the maximum of 2 × 2 pixels, of `4 × vectors` channels each, from two
 * rows to one of `pixels` pixels.
 */
function pool(): WasmFunction {
  const [result, above, below, pixels, vectors] = [0, 1, 2, 3, 4] as const;
  const [count, bytes] = [5, 6] as const;
  const beside = (address: number): Code => [op.get(address), op.get(bytes), op.add, op.loadVector(0)];
  const vector: Code = [
    op.get(result),
    [op.get(above), op.loadVector(0), beside(above), op.maxVectors],
    [op.get(below), op.loadVector(0), beside(below), op.maxVectors],
    [op.maxVectors, op.storeVector(0)],
    [result, above, below].map((address) => op.advance(address, 16)),
  ];
  const body: Code = [
    [op.get(vectors), op.constant(4), op.shiftLeft, op.set(bytes)],
    op.countdown(pixels, [
      [op.get(vectors), op.set(count)],
      op.countdown(count, vector),
      [above, below].map((address) => [[op.get(address), op.get(bytes), op.add, op.set(address)]]),
    ]),
  ];
  return { name: 'pool', parameters: 5, integers: 2, vectors: 0, body };
}

/** What the module exports; addresses are bytes. */
export interface WasmKernels {
  convolve(result: number, step: number, tiles: number, bias: number, table: number, sources: number): void;
  pool(result: number, above: number, below: number, pixels: number, vectors: number): void;
}

/**
 * The binary of the kernels.
 *
 * @param fused Whether products are added by relaxed SIMD, which is one instruction on most processors.
 */
export const kernelBytes = (fused: boolean): Uint8Array<ArrayBuffer> => assemble([convolve(fused), pool()]);

/**
 * Compiles the kernels.
 *
 * @returns `undefined` where a page's content security policy forbids WebAssembly, or the browser has no SIMD.
 */
export async function compileWasm(): Promise<WebAssembly.Module | undefined> {
  try {
    const fused = kernelBytes(true);
    return await WebAssembly.compile(WebAssembly.validate(fused) ? fused : kernelBytes(false));
  } catch {
    return undefined;
  }
}
