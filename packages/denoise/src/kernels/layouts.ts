import { struct } from '@glanz/wgsl/struct';

/** Sizes and places of a convolution's sources, result and weights. Places are counted in vectors of four channels. */
export const layerStruct = struct('DenoiseLayer', {
  /** Pixels of the layer, before pooling. */
  size: 'vec2u',
  up_quads: 'u32',
  direct_quads: 'u32',
  /** What of the tensor lies before the part that is bound. */
  up_base: 'u32',
  direct_base: 'u32',
  result_base: 'u32',
  result_quads: 'u32',
  /** Vectors of output channels in the weights: `result_quads` rounded up to what workgroups compute. */
  output_quads: 'u32',
  up_weights: 'u32',
  direct_weights: 'u32',
});

/** Module of {@link layerStruct}, for shaders. */
export const DenoiseLayer = layerStruct.module;

/** A tile of the image, and where images lie in their buffers. */
export const tileStruct = struct('DenoiseTile', {
  /** Pixels of the whole image. */
  image_size: 'vec2u',
  /** The tile's first pixel in the image. */
  origin: 'vec2u',
  /** Pixels of the tile; those beyond the image are zeros. */
  size: 'vec2u',
  /** The part of the image that the tile's result is written to. */
  inner_from: 'vec2u',
  inner_to: 'vec2u',
  /** Quads of channels of the encoded images. */
  quads: 'u32',
  /** Floats before the first pixel, from pixel to pixel, from row to row; 1 where there is a fourth float. */
  main_image: 'vec4u',
  albedo_image: 'vec4u',
  normal_image: 'vec4u',
  output_image: 'vec4u',
});

/** Module of {@link tileStruct}, for shaders. */
export const DenoiseTile = tileStruct.module;
