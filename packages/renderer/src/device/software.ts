/** Names of rasterisers that run on the CPU: SwiftShader, Mesa's llvmpipe/lavapipe, Windows' WARP. */
const CPU_NAMES = /swiftshader|llvmpipe|lavapipe|basic render|warp/i;

/**
 * Whether the CPU does the work of a GPU, as far as the adapter tells.
 *
 * @param info Of `GPUAdapter.info` or `GPUDevice.adapterInfo`.
 */
export function isSoftware(info: GPUAdapterInfo): boolean {
  return info.isFallbackAdapter === true || CPU_NAMES.test(`${info.architecture} ${info.device} ${info.description}`);
}

/**
 * Whether the GPU itself says how many threads a kernel shall have: only as many as there are paths left. A CPU, for
 * which each group of threads is work, gains by that. Elsewhere the number is fixed, and threads that outnumber the
 * paths end at once; WebGPU checks a number that is on the GPU before it believes it, which is slow there: a path of
 * 256 edges takes 22 times as long on an H200.
 */
export function countsThreads({ adapterInfo }: { readonly adapterInfo?: GPUAdapterInfo }): boolean {
  return adapterInfo !== undefined && isSoftware(adapterInfo);
}
