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
