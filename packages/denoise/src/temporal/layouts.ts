import { struct } from '@glanz/wgsl/struct';

/** What the kernels of the temporal filter know of a frame. */
export const temporalFrameStruct = struct('TemporalFrame', {
  size: 'vec2u',
  /** Samples that the film's image is the mean of. */
  samples: 'f32',
  /** Samples that the history counts for at most. */
  max_history: 'f32',
  /** Standard deviations around the mean of a pixel's neighbours that the history is kept within. */
  clamp_sigmas: 'f32',
  /** The share of the filtered image, 0 to 1. */
  share: 'f32',
  /** Where the frame is seen from, and the one before. */
  eye: 'vec3f',
  /** 1 where instances have moved since the frame before. */
  moved: 'u32',
  eye_before: 'vec3f',
  /** Pixels between the taps of the spatial filter. */
  step: 'u32',
  /** From the space of positions to clip space, of this frame and of the one before; see `projected`. */
  projection: 'mat4x4f',
  projection_before: 'mat4x4f',
  /** 1 where the projections are known. */
  projected: 'u32',
});

/** Module of {@link temporalFrameStruct}, for shaders. */
export const TemporalFrame = temporalFrameStruct.module;
