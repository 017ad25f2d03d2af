import { ViewerError } from './errors';

/**
 * Makes calls of the GPU and waits for its verdict.
 *
 * @param what The calls are for, as an error names it.
 * @returns What `run` returns.
 * @throws {ViewerError} `viewer/out-of-memory`, `viewer/gpu`; what `run` throws.
 */
export async function withErrorScopes<T>(device: GPUDevice, what: string, run: () => T): Promise<Awaited<T>> {
  device.pushErrorScope('out-of-memory');
  device.pushErrorScope('validation');
  const verdicts = () => Promise.all([device.popErrorScope(), device.popErrorScope()]);
  let result: T;
  try {
    result = run();
  } catch (error) {
    await verdicts();
    throw error;
  }
  if (result instanceof Promise) result.catch(() => undefined);
  const [validation, memory] = await verdicts();
  if (memory)
    throw new ViewerError(
      'viewer/out-of-memory',
      `The GPU does not have enough memory for ${what}: ${memory.message}. Show a smaller model or image, or close other programs.`,
    );
  if (validation) throw new ViewerError('viewer/gpu', `The GPU refused ${what}: ${validation.message}`);
  return await result;
}
