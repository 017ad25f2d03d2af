// three ships no types; the tests only hand bytes to its loaders, as readers written by others.
declare module 'three/examples/jsm/loaders/EXRLoader.js' {
  export class EXRLoader {
    type: number;
    parse(buffer: ArrayBuffer): { width: number; height: number; data: Float32Array };
  }
}
declare module 'three/examples/jsm/loaders/HDRLoader.js' {
  export class HDRLoader {
    type: number;
    parse(buffer: ArrayBuffer): { width: number; height: number; data: Float32Array };
  }
}
declare module 'three' {
  export const FloatType: number;
}
