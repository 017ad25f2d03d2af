/** Triangles that share one material. Triangles are counter-clockwise seen from the front. */
export interface Mesh {
  name: string;
  /** xyz per vertex, stride 3, metres, object space. */
  positions: Float32Array<ArrayBuffer>;
  /** Three per triangle, into the vertices. */
  indices: Uint32Array<ArrayBuffer>;
  /** xyz per vertex, stride 3, unit length. Absent: the mesh is shaded flat. */
  normals?: Float32Array<ArrayBuffer>;
  /** xyzw per vertex, stride 4: unit tangent along +u, and the handedness (±1) of the bitangent, as in glTF. */
  tangents?: Float32Array<ArrayBuffer>;
  /** UV sets, each uv per vertex, stride 2; the origin is the upper left corner of the image. */
  uvs?: Float32Array<ArrayBuffer>[];
  /**
   * RGBA per vertex, stride 4, linear; multiplies `base_color` and `geometry_opacity`, `transmission_color` where
   * `transmission_depth` is 0, and `emission_color` where `base_weight` and `specular_weight` are 0.
   */
  colors?: Float32Array<ArrayBuffer>;
  /**
   * What `poseMesh` of `@glanz/scene/pose` has made it from. Its positions, normals and tangents are computed when they
   * are first read; a renderer that poses the rig on the GPU does not read them. Not enumerable: a copy of the mesh, by
   * `structuredClone` for instance, has its vertices and no pose.
   */
  readonly pose?: MeshPose;
}

/** The joints that move each vertex. */
export interface MeshSkin {
  /** Number of joints, at most 65,536. */
  readonly jointCount: number;
  /**
   * Four joints for each vertex, vertex after vertex. For more than four joints a vertex, lists of the same length
   * follow: the fifth to eighth joint of each vertex, and so on.
   */
  readonly joints: Uint16Array<ArrayBuffer>;
  /** How much each of `joints` counts, as long. Weights of a vertex are scaled to a sum of 1; one without any does not move. */
  readonly weights: Float32Array<ArrayBuffer>;
}

/** What a morph target adds to the vertices at a weight of 1. Each is xyz per vertex, stride 3. */
export interface MorphTarget {
  readonly positions?: Float32Array<ArrayBuffer> | undefined;
  readonly normals?: Float32Array<ArrayBuffer> | undefined;
  readonly tangents?: Float32Array<ArrayBuffer> | undefined;
}

/** A mesh that can be posed. Made by `createRig` of `@glanz/scene/pose`; not to be changed. */
export interface MeshRig {
  /** The mesh in its bind pose, without morph targets. */
  readonly bind: Mesh;
  /** The joints that move each vertex. Absent: only targets do. */
  readonly skin?: MeshSkin | undefined;
  /** What can be blended in, in the order of a pose's weights. */
  readonly targets: readonly MorphTarget[];
}

/** A pose of a rig: targets are blended first, then the skin is applied, as in glTF. */
export interface MeshPose {
  readonly rig: MeshRig;
  /** Matrices of the joints from the bind pose to the pose, in object space: 16 numbers each, column-major. */
  readonly joints: Float64Array<ArrayBuffer>;
  /** Weights of the morph targets. */
  readonly weights: Float64Array<ArrayBuffer>;
}
