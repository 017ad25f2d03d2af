/** Contents of a buffer for {@link runCompute}. */
export type ComputeInput = ArrayBuffer | ArrayBufferView<ArrayBuffer>;

/** Options for {@link runCompute}. */
export interface ComputeOptions {
  /** Read-only storage buffers, at `@binding(0)`, `@binding(1)`, … of group 0. Default none. */
  readonly inputs?: readonly ComputeInput[];
  /** Bytes of the `read_write` storage buffer that comes after the inputs; zero at first. A multiple of 4. */
  readonly outputBytes: number;
  /** Workgroups in x, y, z. Default 1. */
  readonly workgroups?: number | readonly [number, number?, number?];
  /** Default `main`. */
  readonly entryPoint?: string;
}

const bytesOf = (input: ComputeInput) =>
  input instanceof ArrayBuffer
    ? new Uint8Array(input)
    : new Uint8Array(input.buffer, input.byteOffset, input.byteLength);

/** WebGPU writes whole words. */
function wholeWords(bytes: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> {
  if (bytes.byteLength % 4 === 0) return bytes;
  const padded = new Uint8Array(Math.ceil(bytes.byteLength / 4) * 4);
  padded.set(bytes);
  return padded;
}

async function run(device: GPUDevice, code: string, options: ComputeOptions, keep: GPUBuffer[]): Promise<ArrayBuffer> {
  const buffer = (label: string, size: number, usage: number) => {
    const made = device.createBuffer({ label, size, usage });
    keep.push(made);
    return made;
  };
  const module = device.createShaderModule({ label: 'runCompute', code });
  const messages = (await module.getCompilationInfo()).messages.filter((message) => message.type === 'error');
  if (messages.length > 0)
    throw new Error(
      messages
        .map((m) => `WGSL line ${m.lineNum}: ${m.message} — "${code.split('\n')[m.lineNum - 1]?.trim() ?? ''}"`)
        .join('\n'),
    );
  const inputs = (options.inputs ?? []).map((input, index) => {
    const bytes = wholeWords(bytesOf(input));
    const made = buffer(
      `input ${index}`,
      Math.max(16, bytes.byteLength),
      GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST,
    );
    device.queue.writeBuffer(made, 0, bytes);
    return made;
  });
  const output = buffer('output', options.outputBytes, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
  const staging = buffer('staging', options.outputBytes, GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ);
  const entries: GPUBindGroupLayoutEntry[] = [...inputs, output].map((_, binding) => ({
    binding,
    visibility: GPUShaderStage.COMPUTE,
    buffer: { type: binding < inputs.length ? 'read-only-storage' : 'storage' },
  }));
  const layout = device.createBindGroupLayout({ entries });
  const pipeline = await device.createComputePipelineAsync({
    layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
    compute: { module, entryPoint: options.entryPoint ?? 'main' },
  });
  const group = device.createBindGroup({
    layout,
    entries: [...inputs, output].map((resource, binding) => ({ binding, resource: { buffer: resource } })),
  });
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, group);
  const [x, y = 1, z = 1] = typeof options.workgroups === 'object' ? options.workgroups : [options.workgroups ?? 1];
  pass.dispatchWorkgroups(x, y, z);
  pass.end();
  encoder.copyBufferToBuffer(output, 0, staging, 0, options.outputBytes);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(GPUMapMode.READ);
  return staging.getMappedRange().slice(0);
}

/**
 * Compiles a compute shader, runs it once, and returns its output buffer: for unit tests of small WGSL functions.
 * All buffers are in group 0, the inputs first, then the output; a shader need not use them all.
 *
 * @param code WGSL text with one compute entry point.
 * @returns The output buffer's bytes; wrap them in the typed array you want.
 * @throws {Error} with the compiler's messages, or the validation error.
 * @example
 * const code = `@group(0) @binding(0) var<storage, read> x: array<f32>;
 * @group(0) @binding(1) var<storage, read_write> y: array<f32>;
 * @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
 *   if (id.x < arrayLength(&x)) { y[id.x] = sqrt(x[id.x]); }
 * }`;
 * const y = new Float32Array(await runCompute(device, code, { inputs: [new Float32Array([4, 9])], outputBytes: 8 }));
 */
export async function runCompute(device: GPUDevice, code: string, options: ComputeOptions): Promise<ArrayBuffer> {
  device.pushErrorScope('out-of-memory');
  device.pushErrorScope('validation');
  const buffers: GPUBuffer[] = [];
  const outcome = await run(device, code, options, buffers).then(
    (result) => ({ result }),
    (failure: unknown) => ({ failure }),
  );
  const errors = [await device.popErrorScope(), await device.popErrorScope()].filter((error) => error !== null);
  for (const buffer of buffers) buffer.destroy();
  if ('failure' in outcome) throw outcome.failure;
  if (errors.length > 0) throw new Error(errors.map((error) => error.message).join('\n'));
  return outcome.result;
}
