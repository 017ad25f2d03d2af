import type { ComposedWgsl } from './compose';
import { GlanzError } from './error';

/**
 * A shader that the WebGPU implementation refused. `location` names the WGSL module and the line inside it. Code:
 * `wgsl/compile`.
 */
export class ShaderError extends GlanzError {}

const oneLine = (text: string) => text.trim().replace(/\s*\n\s*/g, ' ');

/**
 * Creates a shader module and waits for the compiler's word on it, translating every complaint back to the module and
 * line it came from. The device's `uncapturederror` event stays silent: the error is thrown here, and only here.
 *
 * @param label Appears in the browser's own messages.
 * @throws {ShaderError} code `wgsl/compile` with the first error, its module, its line and the text of that line.
 */
export function createShaderModule(device: GPUDevice, shader: ComposedWgsl, label: string): Promise<GPUShaderModule> {
  return beginShaderModule(device, shader, label).checked;
}

/** What {@link beginShaderModule} gives. */
export interface PendingShaderModule {
  /** To make pipelines of at once, with `create…PipelineAsync`; of a faulty one they come to nothing. */
  readonly module: GPUShaderModule;
  /** The same, once the compiler has found nothing wrong with it. Rejects as {@link createShaderModule} does. */
  readonly checked: Promise<GPUShaderModule>;
}

/**
 * As {@link createShaderModule}, for those who do not want to wait for the compiler's word before they ask for
 * pipelines: the driver has its work a round trip earlier. Await `checked` before the pipelines: where both fail, it
 * says why.
 *
 * @param label Appears in the browser's own messages.
 * @example
 * const { module, checked } = beginShaderModule(device, shader, 'shade');
 * const pipeline = device.createComputePipelineAsync({ layout: 'auto', compute: { module } });
 * pipeline.catch(() => {});   // where the text is at fault, the next line throws
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
  word: Promise<[GPUError | null, GPUCompilationInfo]>,
  shader: ComposedWgsl,
  label: string,
): Promise<GPUShaderModule> {
  const [validation, info] = await word;
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
    throw new ShaderError('wgsl/compile', `Shader "${label}" was refused: ${oneLine(validation.message)}`);
  return module;
}
