import type { OpenPbrParameters } from '@glanz/openpbr';

/** The OpenPBR parameters that a texture may drive in a {@link Material}. */
export type TexturedParameter = Exclude<keyof OpenPbrParameters, 'geometry_thin_walled'>;

/** Which texel channels a {@link TextureBinding} reads. `rgb` for colours and normals, one letter for a number. */
export type TextureChannels = 'rgb' | 'r' | 'g' | 'b' | 'a';

/** A texture driving one parameter. */
export interface TextureBinding {
  /** Index into `Scene.textures`. */
  texture: number;
  channels: TextureChannels;
  /** Which of the mesh's UV sets; default 0. */
  uv?: number;
  /**
   * Affine map of uv before look-up, `[a, b, c, d, x, y]`: u' = a·u + c·v + x, v' = b·u + d·v + y. Default identity.
   */
  transform?: readonly [number, number, number, number, number, number];
  /**
   * For `geometry_normal` and `geometry_coat_normal`: scales the tangent-plane components before normalising; default
   * 1.
   */
  scale?: number;
  /**
   * What texel values 0 and 1 map to, before they multiply the parameter; default `[0, 1]`. Not for normals and
   * tangents.
   */
  range?: readonly [at0: number, at1: number];
}

/**
 * An OpenPBR surface. A parameter's value is `parameters[name] × texel` where a texture is bound (the texel decoded to
 * linear by the texture's colour space), and `parameters[name]` alone elsewhere. `geometry_normal` textures hold
 * tangent-space normals as 0..1, `geometry_tangent` textures a direction in the tangent plane (red along the tangent,
 * green along the bitangent) as 0..1, which the parameter's own direction then rotates further. Missing parameters have
 * the spec's defaults.
 */
export interface Material {
  name: string;
  /** Values that differ from the defaults of OpenPBR, under the spec's names. */
  parameters: Partial<OpenPbrParameters>;
  textures?: Partial<Record<TexturedParameter, TextureBinding>>;
  /**
   * Whether the back side emits as the front does (glTF `doubleSided`). Default false: emission leaves from the front
   * (counter-clockwise) side only. Reflection is still two-sided; whether the camera sees the back of a material
   * that is not double-sided is the renderer's option `backFaceCulling`.
   */
  double_sided?: boolean;
  /**
   * Opacity below this counts as 0 and from it on as 1 (glTF alphaMode MASK). Absent: `geometry_opacity` is a coverage.
   */
  opacity_threshold?: number;
  /** Light group that the material's emission is added to. */
  light_group?: string;
  /**
   * Where interiors overlap, the one with the highest priority counts, an integer in 0..255; default 0. Of equal
   * priorities, the one that a ray entered last counts. A liquid's mesh may thus overlap the glass around it (glass 1,
   * liquid 0).
   */
  dielectric_priority?: number;
  /** The source file's own extra data, passed through untouched. */
  extras?: unknown;
}
