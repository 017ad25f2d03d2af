// What is read of three's objects, by shape: any version of the library will do, and nothing of it is imported.

/** A matrix of three: 16 numbers, column-major (9 of a Matrix3). */
export interface Matrix {
  readonly elements: ArrayLike<number>;
}

/** An object of three: a `THREE.Scene`, `Group`, `Mesh`, … */
export interface ThreeObject {
  readonly isObject3D: boolean;
  readonly name: string;
  readonly visible: boolean;
  readonly children: readonly ThreeObject[];
  readonly matrixWorld: Matrix;
  updateMatrixWorld(force?: boolean): void;
}

/** A camera of three: `THREE.PerspectiveCamera` or `THREE.OrthographicCamera`. */
export interface ThreeCamera extends ThreeObject {
  readonly isCamera: boolean;
}

/** Anything of three, to look into. */
export type Loose = Readonly<Record<string, unknown>>;

/** A buffer attribute, interleaved or not. */
export interface Attribute {
  readonly count: number;
  readonly itemSize: number;
  readonly normalized: boolean;
  readonly array?: ArrayLike<number>;
  readonly isInterleavedBufferAttribute?: boolean;
  getComponent(index: number, component: number): number;
}

/** A buffer geometry. */
export interface Geometry {
  readonly uuid: string;
  readonly name: string;
  readonly index: Attribute | null;
  readonly attributes: Readonly<Record<string, Attribute | undefined>>;
  readonly morphAttributes: Readonly<Record<string, readonly Attribute[] | undefined>>;
  readonly morphTargetsRelative: boolean;
  readonly groups: readonly { readonly start: number; readonly count: number; readonly materialIndex?: number }[];
  readonly drawRange: { readonly start: number; readonly count: number };
}

/** A colour, linear (three's working space). */
export interface Color {
  readonly r: number;
  readonly g: number;
  readonly b: number;
}

/** A texture. */
export interface ThreeTexture {
  readonly isTexture: true;
  readonly uuid: string;
  readonly name: string;
  readonly image: unknown;
  readonly source?: { readonly uuid: string; readonly data: unknown };
  readonly mapping: number;
  readonly wrapS: number;
  readonly wrapT: number;
  readonly magFilter: number;
  readonly type: number;
  readonly format: number;
  readonly colorSpace: string;
  readonly flipY: boolean;
  readonly channel: number;
  readonly matrixAutoUpdate: boolean;
  readonly matrix: Matrix;
  updateMatrix(): void;
}

/** A material. */
export type ThreeMaterial = Loose & { readonly uuid: string; readonly name: string; readonly type: string };

/** A mesh, instanced, batched or skinned perhaps. */
export interface ThreeMesh extends ThreeObject {
  readonly geometry: Geometry;
  readonly material: ThreeMaterial | readonly ThreeMaterial[];
  readonly isInstancedMesh?: boolean;
  readonly isBatchedMesh?: boolean;
  readonly isSkinnedMesh?: boolean;
  readonly morphTargetInfluences?: readonly number[];
}
