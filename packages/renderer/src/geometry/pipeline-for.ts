import { compose } from '@glanz/wgsl/compose';
import type { WgslModule } from '@glanz/wgsl/module';
import { beginShaderModule, ShaderError } from '@glanz/wgsl/shader';

/** Compiled shaders, by device and name. */
const pipelines = /* @__PURE__ */ new WeakMap<GPUDevice, Map<string, Promise<GPUComputePipeline>>>();

/**
 * The pipeline of a module with the entry point `main`, compiled once a device.
 *
 * @throws {ShaderError} `wgsl/compile`, also where the text is valid and the driver makes no pipeline of it.
 */
export function pipelineFor(
  device: GPUDevice,
  label: string,
  root: WgslModule,
  flags: Readonly<Record<string, boolean>> = {},
): Promise<GPUComputePipeline> {
  const known = pipelines.get(device) ?? new Map<string, Promise<GPUComputePipeline>>();
  pipelines.set(device, known);
  const key = label + JSON.stringify(flags);
  let found = known.get(key);
  if (!found) {
    known.set(key, (found = compile(device, label, root, flags)));
    // A failure is not kept: the next call tries again.
    found.catch(() => known.delete(key));
  }
  return found;
}

async function compile(
  device: GPUDevice,
  label: string,
  root: WgslModule,
  flags: Readonly<Record<string, boolean>>,
): Promise<GPUComputePipeline> {
  const { module, checked } = beginShaderModule(device, compose([root], { flags }), label);
  const compute = { module, entryPoint: 'main' };
  const pipeline = device.createComputePipelineAsync({ label, layout: 'auto', compute });
  // If the text is invalid, the next line throws.
  pipeline.catch(() => undefined);
  await checked;
  try {
    return await pipeline;
  } catch (cause) {
    const { message } = cause as Error;
    throw new ShaderError('wgsl/compile', `The GPU refused the kernel "${label}": ${message}`, { cause });
  }
}
