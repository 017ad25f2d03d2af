import { GlanzError } from '@glanz/scene';

/** A property or an attribute of `<glanz-viewer>` got a value that it does not take. Codes: `element/property`, `element/attribute`, `element/no-model`. */
export class ElementError extends GlanzError {}
