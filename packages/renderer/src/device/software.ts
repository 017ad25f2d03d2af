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
 * Whether kernels are dispatched indirectly, with only as many threads as there are paths left. Software adapters gain
 * by that, as each workgroup is work for the CPU. On GPUs the number of workgroups is chosen in advance, and their
 * threads loop over the queue: WebGPU implementations validate the sizes of indirect dispatches on the GPU, which takes
 * long there. A path of 256 edges took 22 times as long on an H200.
 */
export function usesIndirectDispatch({ adapterInfo }: { readonly adapterInfo?: GPUAdapterInfo }): boolean {
  return adapterInfo !== undefined && isSoftware(adapterInfo);
}
