// three.js comes without types; only what the tests use is described.
interface Attribute {
  readonly count: number;
  readonly array: Float32Array;
  getX(i: number): number;
  getY(i: number): number;
  getZ(i: number): number;
}
interface Geometry {
  getAttribute(name: 'position'): Attribute;
}
declare module 'three/examples/jsm/loaders/OBJLoader.js' {
  export class OBJLoader {
    parse(text: string): { traverse(visit: (object: { readonly geometry?: Geometry }) => void): void };
  }
}
declare module 'three/examples/jsm/loaders/STLLoader.js' {
  export class STLLoader {
    parse(bytes: ArrayBuffer): Geometry;
  }
}
