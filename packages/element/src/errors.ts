import { GlanzError } from '@glanz/scene';

/**
 * Thrown or reported for an invalid value of a property or an attribute of `<glanz-viewer>`, or a decoder or denoiser
 * that cannot be started. Codes: `element/property`, `element/attribute`, `element/no-model` (an image is requested
 * before a model), `element/decoder`, `element/denoise`.
 */
export class ElementError extends GlanzError {}
