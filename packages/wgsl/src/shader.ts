import type { ComposedWgsl } from './compose';
import { GlanzError } from './error';

/** A shader that the WebGPU implementation refused. `location` names the WGSL module and the line inside it. */
export class ShaderError extends GlanzError {}

/**
 * Creates a shader module and waits for the compiler's word on it, translating every complaint back to the module and
 * line it came from.
 *
 * @param label Appears in the browser's own messages.
 * @throws {ShaderError} code `wgsl/compile` with the first error, its module, its line and the text of that line.
 */
export async function createShaderModule(device: GPUDevice, shader: ComposedWgsl, label: string): Promise<GPUShaderModule> {
  const module = device.createShaderModule({ label, code: shader.code });
  const info = await module.getCompilationInfo();
  const errors = info.messages.filter((message) => message.type === 'error');
  const first = errors[0];
  if (first) {
    const place = shader.locate(first.lineNum);
    const text = shader.code.split('\n')[first.lineNum - 1]?.trim() ?? '';
    const where = place ? `${place.module}:${place.line}` : `line ${first.lineNum}`;
    const more = errors.length > 1 ? ` (and ${errors.length - 1} more)` : '';
    throw new ShaderError('wgsl/compile', `Shader "${label}" does not compile: ${where}: ${first.message}${more} — "${text}"`, {
      location: place ? { module: place.module, line: place.line } : { line: first.lineNum },
    });
  }
  return module;
}
