import { GlanzError } from '@glanz/scene';

/**
 * References are missing or do not fit. Codes: `reference/absent`, `reference/unknown-scene`,
 * `reference/unknown-variant`, `reference/channels`, `reference/size`, `reference/unsupported`.
 */
export class ReferenceError extends GlanzError {}
