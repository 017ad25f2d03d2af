import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { RendererProcess, type JobRenderer } from '@glanz/farm';
import type { Backend } from '../backend';
import { checkHiding, hiding } from '../gpus/hidden-files';
import type { ChosenGpu } from '../gpus/choose-gpus';
import type { CliIo } from '../io';
import { farmRenderer } from './job-renderer';

/** The program, for the renderers' processes: beside this file in the package, or this process's own script. */
export function program(): string {
  const beside = fileURLToPath(new URL('./glanz.js', import.meta.url));
  return existsSync(beside) ? beside : (process.argv[1] as string);
}

/** How to start a renderer's process that sees its own GPU alone. */
export const rendererOf = ({ name, hidden }: ChosenGpu) => ({
  script: program(),
  args: ['farm', 'renderer', ...(name === undefined ? [] : ['--gpu', name])],
  prefix: hiding(hidden),
});

/** Renders jobs on one GPU, and ends. */
export interface GpuRenderer extends Pick<JobRenderer, 'render'> {
  close(): void;
}

/**
 * A renderer for a GPU: in this process, or in one of its own where only that distinguishes it from others of its name.
 *
 * @throws {CliError} `cli/gpu-isolation`
 */
export async function gpuRenderer(gpu: ChosenGpu, io: CliIo, backend: Backend): Promise<GpuRenderer> {
  if (gpu.hidden.length === 0) return { ...farmRenderer(io, backend, gpu.name), close: () => undefined };
  await checkHiding(gpu.hidden);
  const child = new RendererProcess(rendererOf(gpu));
  return {
    async render(message, signal, onProgress) {
      const stop = () => child.stop();
      signal.addEventListener('abort', stop);
      try {
        const end = child.run(message, onProgress);
        if (signal.aborted) stop();
        const made = await end;
        return made.type === 'done' ? made : undefined;
      } finally {
        signal.removeEventListener('abort', stop);
      }
    },
    close: () => child.kill(),
  };
}
