import { GlanzError } from '@glanz/wgsl/error';

/**
 * Thrown by the farm. Codes: `farm/missing-package` (an optional package is needed), `farm/redis` (the queue cannot be
 * reached), `farm/store` (a file of the store cannot be read or written), `farm/missing-file` (the store does not have a
 * file, or it is damaged), `farm/store-access`
 * (the store's bucket does not exist, or its server denies access), `farm/renderer` (a renderer's process ended or does
 * not respond), `farm/option` (an option has an invalid value).
 */
export class FarmError extends GlanzError {}
