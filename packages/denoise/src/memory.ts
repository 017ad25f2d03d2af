import { DenoiseError } from './error';
import { STORAGE, tryBuffers } from './gpu';
import type { Network } from './network';
import { planNetwork, type Plan, type PlanOptions } from './plan';
import { tileImage, type Tiling } from './tiles';

/** What a size is prepared with. */
export interface PrepareOptions extends PlanOptions {
  readonly width: number;
  readonly height: number;
  readonly maxMemory: number;
}

/** How a network computes an image of a size: its tiles, and the plan of one. */
export interface TiledPlan {
  readonly tiling: Tiling;
  readonly plan: Plan;
}

const bytesOf = (slots: readonly number[]): number => slots.reduce((sum, bytes) => sum + bytes, 0);

/** Cuts the image into the fewest tiles whose values take no more than `memory` bytes. */
function planTiles(network: Network, options: PrepareOptions, memory: number, maxBufferSize: number): TiledPlan {
  const { width, height } = options;
  let plan: Plan | undefined;
  let min = Infinity;
  const tiling = tileImage(width, height, network.overlap, (w, h) => {
    const planned = planNetwork(network, w, h, options);
    if (planned) min = Math.min(min, bytesOf(planned.slots));
    plan = planned && planned.slots.every((bytes) => bytes <= maxBufferSize) ? planned : undefined;
    return plan !== undefined && bytesOf(plan.slots) <= memory;
  });
  if (tiling && plan) return { tiling, plan };
  // No plan at all: a row of workgroups does not fit into a binding.
  throw min <= memory || min === Infinity
    ? new DenoiseError(
        'denoise/limit',
        `Not even a small tile of ${width} × ${height} pixels fits into the device's limits (maxBufferSize ${maxBufferSize}, maxStorageBufferBindingSize ${options.maxBinding}). Request higher ones.`,
      )
    : new DenoiseError(
        'denoise/memory',
        `The smallest tile of ${width} × ${height} pixels needs ${min} bytes on the GPU, and ${memory} ${memory < options.maxMemory ? 'are free' : 'are allowed by maxMemory'}. Free memory, or use storage 'f16' or a smaller network.`,
      );
}

/**
 * Makes the memory in which networks compute images of a size, one network after the other in the same buffers.
 *
 * @param images Whole images of three floats a pixel that are needed besides.
 * @throws {DenoiseError} `denoise/memory`, `denoise/limit`.
 */
export async function allocate(
  device: GPUDevice,
  networks: readonly Network[],
  images: number,
  options: PrepareOptions,
): Promise<{ parts: TiledPlan[]; buffers: GPUBuffer[]; images: GPUBuffer[] }> {
  const { maxBufferSize } = device.limits;
  for (let memory = options.maxMemory; ;) {
    const parts = networks.map((network) => planTiles(network, options, memory, maxBufferSize));
    const slots: number[] = [];
    for (const { plan } of parts)
      for (const [i, bytes] of plan.slots.entries()) slots[i] = Math.max(slots[i] ?? 0, bytes);
    const buffers = await tryBuffers(device, [
      ...slots.map((size, i) => ({ label: `denoise values ${i}`, size, usage: STORAGE })),
      ...Array.from({ length: images }, (_, i) => ({
        label: `denoise guide ${i}`,
        size: options.width * options.height * 12,
        usage: STORAGE,
      })),
    ]);
    if (buffers) return { parts, buffers: buffers.slice(0, slots.length), images: buffers.slice(slots.length) };
    // Less than what was refused, in smaller tiles.
    memory = Math.floor(0.75 * Math.max(...parts.map(({ plan }) => bytesOf(plan.slots))));
  }
}
