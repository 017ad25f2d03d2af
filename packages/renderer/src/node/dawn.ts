import { isAbsolute } from 'node:path';
import { pathToFileURL } from 'node:url';
import { DeviceError } from '../errors';
import { parseAdapterList } from './adapter-info';

/** The part of the `webgpu` package that is used. */
export interface Dawn {
  create(options: string[]): GPU;
  /** `GPUBufferUsage`, `GPUMapMode`, … as a browser has them globally. */
  readonly globals: object;
}

/** An adapter name that nothing has; asking for it makes Dawn list its adapters. */
const NOBODY = 'glanz-lists-adapters';

/**
 * Loads Dawn. `GPU_WEBGPU` in the environment, a file or URL, replaces the `webgpu` package: bundles use it
 * on machines that have no node_modules.
 */
export async function loadDawn(): Promise<Dawn> {
  const override = process.env['GPU_WEBGPU'];
  try {
    if (!override) return withGlobals((await import('webgpu')) as Dawn);
    const specifier = isAbsolute(override) ? pathToFileURL(override).href : override;
    return withGlobals((await import(/* @vite-ignore */ specifier)) as Dawn);
  } catch (cause) {
    const what = override
      ? `GPU_WEBGPU points to "${override}", which does not load`
      : 'the package "webgpu" (Dawn for Node) is not installed or does not load: run `npm install webgpu`';
    throw new DeviceError('renderer/no-webgpu', `WebGPU in Node: ${what} (${firstLine(cause)}).`, { cause });
  }
}

/** Defines WebGPU's constants and classes globally, where they are missing. */
function withGlobals(dawn: Dawn): Dawn {
  for (const [name, value] of Object.entries(dawn.globals)) {
    if (!(name in globalThis)) Object.defineProperty(globalThis, name, { value, configurable: true, writable: true });
  }
  return dawn;
}

/** First line of an error's message, for messages that quote it. */
export function firstLine(error: unknown): string {
  return String((error as Error)?.message ?? error)
    .split('\n', 1)[0]!
    .trim();
}

const PINNED = Symbol.for('glanz.dawn');

/**
 * Calls Dawn's `create` and keeps the result for the rest of the process: devices do not hold on to it, and once it is
 * collected they crash.
 */
export function createPinned(dawn: Dawn, options: readonly string[]): GPU {
  const gpu = dawn.create([...options]);
  const holder = globalThis as { [PINNED]?: GPU[] };
  (holder[PINNED] ??= []).push(gpu);
  return gpu;
}

/** Names and backends of all adapters that the Vulkan, Metal or D3D drivers now in effect offer. */
export async function listAdapters(dawn: Dawn): Promise<{ readonly backend: string; readonly name: string }[]> {
  try {
    // With no adapter at all this gives null instead of throwing.
    await createPinned(dawn, [`adapter=${NOBODY}`]).requestAdapter();
    return [];
  } catch (error) {
    return parseAdapterList(String((error as Error).message));
  }
}
