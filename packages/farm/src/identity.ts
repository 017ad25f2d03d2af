import { createHash } from 'node:crypto';

/** The same text for equal values: keys in order of their code units, members that are `undefined` left out. */
export function canonicalJson(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map((item) => canonicalJson(item ?? null)).join(',')}]`;
  if (typeof value === 'object' && value !== null)
    return `{${Object.entries(value)
      .filter(([, member]) => member !== undefined)
      .sort(([a], [b]) => (a < b ? -1 : a > b ? 1 : 0))
      .map(([key, member]) => `${JSON.stringify(key)}:${canonicalJson(member)}`)
      .join(',')}}`;
  return JSON.stringify(value ?? null);
}

/**
 * The identity of something by its content: 40 hexadecimal digits of the SHA-256 of its canonical JSON. Equal content
 * has equal identity on every machine.
 */
export const contentId = (content: unknown): string =>
  createHash('sha256').update(canonicalJson(content)).digest('hex').slice(0, 40);
