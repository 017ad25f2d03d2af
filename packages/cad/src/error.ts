import { GlanzError } from '@glanz/scene';

/**
 * Thrown by this package. Codes: `cad/format` (an unknown file format), `cad/unreadable` (an invalid file, or one that
 * the reader does not support), `cad/no-shapes` (nothing in the file has a surface), `cad/materials` (an invalid
 * material map), `cad/option` (an option out of its range), `cad/missing-resource` (a file that cannot be read).
 */
export class CadError extends GlanzError {}
