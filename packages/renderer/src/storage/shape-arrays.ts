/** Arrays of a scene's shapes that grow with its triangles. */
export type ShapeArray = 'nodes' | 'triangles' | 'attributes';

/** A part of one of them. */
export interface ShapeSlice {
  readonly buffer: ShapeArray;
  /** Where in the buffer, in bytes. */
  readonly offset: number;
  readonly data: ArrayBufferView<ArrayBuffer>;
}

/** Bytes that each takes. */
export type ShapeBytes = Readonly<Record<ShapeArray, number>>;
