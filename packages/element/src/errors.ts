import { GlanzError } from '@glanz/scene';

/**
 * A property or an attribute of `<glanz-viewer>` got a value that it does not take, or a decoder or denoiser does not
 * start. Codes: `element/property`, `element/attribute`, `element/no-model`, `element/decoder`, `element/denoise`.
 */
export class ElementError extends GlanzError {}
