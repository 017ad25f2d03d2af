import create from 'draco3dgltf/draco_decoder_gltf_nodejs.js';
import { wasmBytes } from './draco-wasm';
import { startWasm } from './start-wasm';

let started: Promise<unknown> | undefined;

/** The module of Draco's decoder, started once for all elements of a page. */
export default (): Promise<unknown> =>
  (started ??= startWasm(create, wasmBytes).catch((error: unknown) => {
    started = undefined;
    throw error;
  }));
