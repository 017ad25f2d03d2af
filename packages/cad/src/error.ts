import { GlanzError } from '@glanz/scene';

/**
 * Thrown by this package. Codes: `cad/format` (not a file that is known), `cad/unreadable` (broken, or beyond what the
 * reader can), `cad/no-shapes`, `cad/materials` (a material map that makes no sense), `cad/option`,
 * `cad/missing-resource`.
 */
export class CadError extends GlanzError {}
