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
}
