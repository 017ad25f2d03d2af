import { ALIGNMENT, UNIFORM, bindGroup, filledBuffer, type Kernel, type Window } from './gpu';
import { layerStruct } from './kernels/layouts';
import { hasMatrices } from './kernels/shapes';
import type { NetworkKernels } from './network-kernels';
import type { LayerPlan, Strip, TensorWindow } from './plan';

/** A layer that is ready to be dispatched. */
export interface ReadyLayer {
  readonly plan: LayerPlan;
  readonly kernel: Kernel;
  readonly strips: readonly {
    readonly strip: Strip;
    readonly resources: Readonly<Record<number, Window>>;
    /** `undefined` for the last layer, whose bindings depend on the caller's images. */
    readonly group: GPUBindGroup | undefined;
  }[];
}

/**
 * Binds a layer to its tensors.
 *
 * @param kernel Of `kernels`, for this plan.
 * @param buffers Values between layers, by slot.
 * @param rows Uniforms of {@link ALIGNMENT} bytes each with a number of a row of workgroups, for dynamic offsets.
 * @param own Gets what has to be destroyed.
 */
export function readyLayer(
  device: GPUDevice,
  kernels: NetworkKernels,
  kernel: Kernel,
  plan: LayerPlan,
  buffers: readonly GPUBuffer[],
  rows: GPUBuffer,
  own: GPUBuffer[],
): ReadyLayer {
  const windowOf = ({ slot, offset, size }: TensorWindow): Window => ({ buffer: buffers[slot]!, offset, size });
  const { buffer: weights, packed } = kernels.weights(plan);
  const stride = Math.ceil(layerStruct.size / ALIGNMENT) * ALIGNMENT;
  const uniforms = new ArrayBuffer(stride * plan.strips.length);
  for (const [i, { direct, up, result }] of plan.strips.entries()) {
    const bytes = layerStruct.allocate();
    layerStruct.write(bytes, 0, {
      size: [plan.width, plan.height],
      up_quads: plan.up?.quads ?? 0,
      direct_quads: plan.direct.quads,
      up_base: up?.base ?? 0,
      direct_base: direct.base,
      result_base: result?.base ?? 0,
      result_quads: plan.result?.quads ?? 1,
      output_quads: packed.outputQuads,
      up_weights: packed.upAt,
      direct_weights: packed.directAt,
    });
    new Uint8Array(uniforms).set(new Uint8Array(bytes), i * stride);
  }
  const layer = filledBuffer(device, `denoise ${plan.layer.name}`, uniforms, UNIFORM);
  own.push(layer);
  const strips = plan.strips.map((strip, i) => {
    const bound = { buffer: weights, offset: 0, size: weights.size };
    const resources: Record<number, Window> = {
      0: { buffer: layer, offset: i * stride, size: layerStruct.size },
      1: { buffer: rows, offset: 0, size: 16 },
      2: bound,
      3: windowOf(strip.direct),
      ...(strip.up ? { 4: windowOf(strip.up) } : {}),
      ...(strip.result ? { 5: windowOf(strip.result) } : {}),
      // Biases, which are in single precision.
      ...(hasMatrices(plan.shape) ? { 6: bound } : {}),
    };
    return { strip, resources, group: strip.result && bindGroup(device, kernel, resources) };
  });
  return { plan, kernel, strips };
}
