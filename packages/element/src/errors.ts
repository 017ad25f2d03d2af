import { GlanzError } from '@glanz/scene';

/**
 * Thrown or reported for an invalid value of a property or an attribute of `<glanz-viewer>`, or a decoder or denoiser
 * that cannot be started. Codes:
 *
 * - `element/property`: a property was set to an invalid value and stays as it was. Pass what the message asks for.
 * - `element/attribute`: an attribute has an invalid text, and its default is used. Write what the message asks for.
 * - `element/no-model`: an image is requested before a model. Set `src` first.
 * - `element/decoder`: a decoder cannot be fetched or started. Check its address and the content security policy.
 * - `element/denoise`: the module of `denoise` cannot be fetched. Check its address and the content security policy.
 */
export class ElementError extends GlanzError {}
