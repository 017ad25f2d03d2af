/** Arrays of a scene's shapes that grow with its triangles. */
export type ShapeArray = 'nodes' | 'triangles' | 'attributes';

/** Bytes that each takes. */
export type ShapeBytes = Readonly<Record<ShapeArray, number>>;
