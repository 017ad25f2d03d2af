import { GlanzError } from '@glanz/wgsl/error';

/**
 * Thrown where a MaterialX document cannot be read. Codes: `openpbr/materialx-syntax` (not well-formed XML),
 * `openpbr/materialx-limit` (a document that is larger or deeper than the reader allows),
 * `openpbr/materialx-reference` (a name that does not exist, or a circular reference), `openpbr/materialx-value` (a
 * value of another type), `openpbr/materialx-no-surface` (there is no `open_pbr_surface`). `location.line` says where.
 */
export class MaterialXError extends GlanzError {}

/** A {@link MaterialXError} at a line. */
export function failure(
  what: 'limit' | 'no-surface' | 'reference' | 'syntax' | 'value',
  message: string,
  line: number,
): MaterialXError {
  return new MaterialXError(`openpbr/materialx-${what}`, `MaterialX document, line ${line}: ${message}`, {
    location: { line },
  });
}

/** A piece of the document in a message: short, and on one line. */
export function quote(text: string): string {
  const line = text.replaceAll(/[\s\p{C}]+/gu, ' ');
  return `"${line.length > 60 ? `${line.slice(0, 60)}…` : line}"`;
}
