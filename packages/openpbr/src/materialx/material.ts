import type { OpenPbrParameterName, OpenPbrParameters } from '../parameters/index';

/** A texture of a MaterialX document, driving one parameter: the parameter is its value times the texel. */
export interface MaterialXTexture {
  /** The path in the document, with its prefixes; relative to the document. The file is not read. */
  readonly file: string;
  readonly channels: 'rgb' | 'r' | 'g' | 'b' | 'a';
  /** `srgb`: RGB codes go through the sRGB curve (alpha never does). `linear`: as they are. */
  readonly colorSpace: 'srgb' | 'linear';
  /** UV set; default 0. */
  readonly uv?: number;
  /**
   * Affine map of uv before look-up, `[a, b, c, d, x, y]`: u' = a·u + c·v + x, v' = b·u + d·v + y. As everywhere in
   * these packages v runs down the image; in the document it runs up. Default identity.
   */
  readonly transform?: readonly [number, number, number, number, number, number];
  /** Parameter values of the texel values 0 and 1; default 0 and 1. */
  readonly range?: readonly [number, number];
  /** Of a normal map: factor on its tangent-plane components; default 1. */
  readonly scale?: number;
  /** Default `repeat`. */
  readonly wrapU?: 'repeat' | 'mirror' | 'clamp';
  /** Default `repeat`. */
  readonly wrapV?: 'repeat' | 'mirror' | 'clamp';
  /** Default `linear`. */
  readonly filter?: 'linear' | 'nearest';
}

/** A material as MaterialX documents hold it, in OpenPBR's names and this package's units and colours. */
export interface MaterialXMaterial {
  readonly name: string;
  /** What differs from the defaults. Colours are linear Rec.709. */
  readonly parameters: Partial<OpenPbrParameters>;
  readonly textures?: { readonly [Name in OpenPbrParameterName]?: MaterialXTexture };
}

/** Something that {@link readMaterialX} or {@link writeMaterialX} left out or took otherwise than it was meant. */
export interface MaterialXWarning {
  /**
   * Beside the codes of `OpenPbrWarning`: `openpbr/materialx-unsupported`: a node, an input or a texture without a
   * place; `openpbr/materialx-color-space`: an unknown or unfit one.
   */
  readonly code: string;
  /** One line: what, where, and what is used instead. */
  readonly message: string;
  /** Line in the document that was read. */
  readonly line?: number;
}
