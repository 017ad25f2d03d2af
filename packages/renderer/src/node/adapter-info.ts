/** One adapter as {@link listGpus} shows it. */
export interface GpuDescription {
  /** What `createGpu({ gpu })` and `--gpu` match, ignoring case, by any part of it. */
  readonly name: string;
  /** Graphics interface below WebGPU: `vulkan`, `metal`, `d3d12`, … */
  readonly backend: string;
  /** Vendor as WebGPU names it, e.g. `nvidia`. */
  readonly vendor: string;
  /** Name and version of the driver, as far as it tells. */
  readonly driver: string;
  /** Whether the CPU does the work. */
  readonly software: boolean;
}

/**
 * Mesa's major version where the adapter is one of Mesa's software rasterisers, e.g. 25; `undefined` for any other
 * adapter.
 */
export function lavapipeVersion(info: GPUAdapterInfo): number | undefined {
  if (!/llvmpipe|lavapipe/i.test(`${info.device} ${info.description}`)) return undefined;
  const version = /mesa (\d+)\./i.exec(info.description)?.[1];
  return version === undefined ? undefined : Number(version);
}

/** Dawn's message when no adapter has the requested name: one line for each adapter. */
const LISTED = /backend: '([^']*)', name: '(.*)'$/;

/** Reads the adapters out of the message that Dawn gives for an unknown name. Two GPUs may have the same. */
export function parseAdapterList(message: string): { readonly backend: string; readonly name: string }[] {
  return message.split('\n').flatMap((line) => {
    const match = LISTED.exec(line.trim());
    return match ? [{ backend: match[1] as string, name: match[2] as string }] : [];
  });
}
