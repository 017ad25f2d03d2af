import { loadPart } from '@glanz/wgsl/error';
import { DenoiseError } from './error';
import { readNetwork } from './network';
import type { DenoiserInput, DenoiserOptions } from './options';
import type { NetworkOf } from './stages';
import type { StartedWasm } from './wasm/wasm-chain';

const INPUTS: readonly DenoiserInput[] = ['hdr', 'ldr', 'srgb', 'albedo', 'normal'];

/** Adapters that compute on the CPU. */
export const isSoftware = ({ adapterInfo }: GPUDevice): boolean =>
  adapterInfo?.isFallbackAdapter === true ||
  /swiftshader|llvmpipe|lavapipe|basic render|warp/i.test(
    `${adapterInfo?.architecture} ${adapterInfo?.device} ${adapterInfo?.description}`,
  );

/** @throws {DenoiseError} `denoise/option`. */
export function checkOptions({
  input = 'hdr',
  storage = 'f16',
  maxMemory = 1,
  maxSubmitMs = 1,
}: DenoiserOptions): void {
  if (!INPUTS.includes(input))
    throw new DenoiseError('denoise/option', `input "${String(input)}" is unknown: use ${INPUTS.join(', ')}.`);
  if (storage !== 'f16' && storage !== 'f32')
    throw new DenoiseError('denoise/option', `storage "${String(storage)}" is unknown: use f16 or f32.`);
  for (const [name, value] of Object.entries({ maxMemory, maxSubmitMs }))
    if (!(value > 0)) throw new DenoiseError('denoise/option', `${name} ${value} is not a positive number.`);
}

/**
 * The networks that are to be evaluated, in order.
 *
 * @throws {DenoiseError} `denoise/weights`.
 */
export function readNetworks(
  weights: Uint8Array | ArrayBuffer,
  { input = 'hdr', prefilter = {} }: DenoiserOptions,
): NetworkOf[] {
  const main = readNetwork(weights);
  const networks: NetworkOf[] = [];
  const guides = { albedo: 6, normal: 9 } as const;
  for (const kind of ['albedo', 'normal'] as const) {
    const bytes = prefilter[kind];
    if (!bytes) continue;
    if (main.channels < guides[kind])
      throw new DenoiseError(
        'denoise/option',
        `prefilter.${kind} is given, and the network takes ${main.channels} channels: it has no such guide.`,
      );
    networks.push([kind, readNetwork(bytes)]);
  }
  networks.push([input, main]);
  for (const [kind, { channels }] of networks)
    if ((kind === 'albedo' || kind === 'normal') && channels !== 3)
      throw new DenoiseError(
        'denoise/weights',
        `A network that denoises ${kind} takes 3 channels; this one takes ${channels}. Use ${kind === 'albedo' ? 'rt_alb' : 'rt_nrm'}.`,
      );
  return networks;
}

/**
 * WebAssembly that computes the layers of a denoiser with these options; `undefined` where shaders do.
 *
 * @throws {DenoiseError} `denoise/pipeline`. `GlanzError` `wgsl/chunk` where its file cannot be loaded.
 */
export async function wasmFor(
  device: GPUDevice,
  networks: readonly NetworkOf[],
  { webAssembly = isSoftware(device) }: Pick<DenoiserOptions, 'webAssembly'>,
): Promise<StartedWasm | undefined> {
  if (!webAssembly) return undefined;
  // Few devices want it: others do not load this.
  const { startWasm } = await loadPart('wasm-chain', import('./wasm/wasm-chain'));
  return startWasm(device, networks);
}
