import type { Network } from '../network';
import { Evaluator } from '../wasm/evaluator';
import { compileWasm } from '../wasm/kernels';
import { slices } from '../wasm/slices';
import type { Planes } from './layers';

/**
 * Evaluates a network in WebAssembly.
 *
 * @param first The encoded images, of the padded size.
 * @returns What the last layer computes; `undefined` where there is no WebAssembly with SIMD, it is forbidden, or the
 * engine has no memory for it.
 * @throws the signal's reason where it aborts.
 */
export async function evaluateInWasm(
  network: Network,
  first: Planes,
  signal: AbortSignal | undefined,
): Promise<Planes | undefined> {
  const module = await compileWasm();
  if (!module) return undefined;
  const { width, height } = first;
  const evaluator = await Evaluator.create(module, [network], { width, height });
  const wasm = evaluator?.networks[0];
  if (!wasm) return undefined;
  const { floats, input, output, tiling } = wasm;
  const data = new Float32Array(3 * width * height);
  const pause = slices(() => signal?.throwIfAborted());
  const wait = async () => {
    const due = pause();
    if (due) await due;
  };
  for (const { x, y, innerX, innerY } of tiling.tiles) {
    for (let row = 0; row < tiling.height; row++) {
      const to = wasm.rowOf(input, row) / 4;
      for (let c = 0; c < first.channels; c++) {
        const from = (c * height + y + row) * width + x;
        for (let i = 0; i < tiling.width; i++) floats[to + i * input.channels + c] = first.data[from + i]!;
      }
      wasm.clearBorders(input, row);
      await wait();
    }
    for (const work of wasm.steps()) {
      void work;
      await wait();
    }
    for (let row = innerY[0]; row < innerY[1]; row++) {
      const from = wasm.rowOf(output, row - y) / 4;
      for (let c = 0; c < 3; c++)
        for (let i = innerX[0]; i < innerX[1]; i++)
          data[(c * height + row) * width + i] = floats[from + (i - x) * output.channels + c]!;
    }
  }
  return { channels: 3, width, height, data };
}
