import type { ComposedWgsl } from './compose';
import { GlanzError } from './error';

/**
 * Thrown for a shader that the WebGPU implementation rejected. `location` names the WGSL module and the line inside it.
 * Code: `wgsl/compile` (the message quotes the line; correct it).
 */
export class ShaderError extends GlanzError {}

const oneLine = (text: string) => text.trim().replace(/\s*\n\s*/g, ' ');

/**
 * Creates a shader module and waits for the compiler's result, mapping every message back to its module and line. The
 * device's `uncapturederror` event does not fire: the error is thrown only here.
 *
 * @param label Appears in the browser's own messages.
 * @throws {ShaderError} code `wgsl/compile` with the first error, its module, its line and the text of that line.
 */
export function createShaderModule(device: GPUDevice, shader: ComposedWgsl, label: string): Promise<GPUShaderModule> {
  return beginShaderModule(device, shader, label).checked;
}

/** The result of {@link beginShaderModule}. */
export interface PendingShaderModule {
  /** For pipelines at once, with `create…PipelineAsync`; those of an invalid module fail. */
  readonly module: GPUShaderModule;
  /** The same module, once the compiler has accepted it. Rejects as {@link createShaderModule} does. */
  readonly checked: Promise<GPUShaderModule>;
}

/**
 * As {@link createShaderModule}, without waiting for the compiler's result before creating pipelines: the driver starts
 * a round trip earlier. Await `checked` before the pipelines: where both fail, it gives the reason.
 *
 * @param label Appears in the browser's own messages.
 * @example
 * const { module, checked } = beginShaderModule(device, shader, 'shade');
 * const pipeline = device.createComputePipelineAsync({ layout: 'auto', compute: { module } });
 * pipeline.catch(() => {});   // if the text is invalid, the next line throws
 * await checked;
 * const ready = await pipeline;
 */
export function beginShaderModule(device: GPUDevice, shader: ComposedWgsl, label: string): PendingShaderModule {
  device.pushErrorScope('validation');
  const module = device.createShaderModule({ label, code: shader.code });
  return {
    module,
    checked: check(module, Promise.all([device.popErrorScope(), module.getCompilationInfo()]), shader, label),
  };
}

async function check(
  module: GPUShaderModule,
  result: Promise<[GPUError | null, GPUCompilationInfo]>,
  shader: ComposedWgsl,
  label: string,
): Promise<GPUShaderModule> {
  const [validation, info] = await result;
  const errors = info.messages.filter((message) => message.type === 'error');
  const first = errors[0];
  if (first) {
    const place = shader.locate(first.lineNum);
    const text = shader.code.split('\n')[first.lineNum - 1]?.trim();
    // Line 0 stands for the whole shader.
    const where = place ? `${place.module}:${place.line}: ` : first.lineNum > 0 ? `line ${first.lineNum}: ` : '';
    const more = errors.length > 1 ? ` (and ${errors.length - 1} more)` : '';
    const location = place ? { module: place.module, line: place.line } : { line: first.lineNum };
    throw new ShaderError(
      'wgsl/compile',
      `Shader "${label}" does not compile: ${where}${oneLine(first.message)}${more}${text ? ` — "${text}"` : ''}`,
      first.lineNum > 0 ? { location } : {},
    );
  }
  if (validation)
    throw new ShaderError('wgsl/compile', `Shader "${label}" was rejected: ${oneLine(validation.message)}`);
  return module;
}
