import { GlanzError } from '@glanz/wgsl/error';

/**
 * Thrown by all functions of this package. Codes: `denoise/weights` (bytes that are not an archive of a known
 * network), `denoise/option` (an option out of range), `denoise/input` (an image is missing, too small or used twice),
 * `denoise/size` (an invalid image size), `denoise/limit` (the device's limits are too low), `denoise/memory` (the GPU
 * has no memory left), `denoise/pipeline` (the driver does not compile a shader), `denoise/device` (the device was
 * lost), `denoise/destroyed` (create another denoiser).
 */
export class DenoiseError extends GlanzError {}
