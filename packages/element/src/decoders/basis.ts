import create from 'three/examples/jsm/libs/basis/basis_transcoder.js';
import { wasmBytes } from './basis-wasm';
import { startWasm } from './start-wasm';

let started: Promise<unknown> | undefined;

/** The module of the Basis Universal transcoder, started once for all elements of a page. */
export default (): Promise<unknown> =>
  (started ??= startWasm(create, wasmBytes).catch((error: unknown) => {
    started = undefined;
    throw error;
  }));
