import { NAMED_COLORS } from './css-color-names';
import { ToneMapError, type Rgb } from './names';
import { srgbDecode } from './srgb';

/** Number of single-letter edits between two words. */
function distance(a: string, b: string): number {
  let row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    const next = [i];
    for (let j = 1; j <= b.length; j++) {
      const changed = (row[j - 1] as number) + (a[i - 1] === b[j - 1] ? 0 : 1);
      next.push(Math.min((row[j] as number) + 1, (next[j - 1] as number) + 1, changed));
    }
    row = next;
  }
  return row[b.length] as number;
}

/** The named colour that differs from a word by the fewest letters, if they are few. */
function nearest(word: string): string | undefined {
  const [best] = [...NAMED_COLORS.keys()]
    .map((name) => ({ name, letters: distance(word, name) }))
    .sort((a, b) => a.letters - b.letters);
  return best && best.letters <= Math.max(1, Math.floor(word.length / 4)) ? best.name : undefined;
}

const clamp = (value: number) => Math.min(Math.max(value, 0), 1);
const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?(%|deg|rad|turn|grad)?$/;
const DEGREES: Readonly<Record<string, number>> = { deg: 1, rad: 180 / Math.PI, turn: 360, grad: 0.9 };

/** sRGB codes 0..1 and alpha of `#rgb`, `#rgba`, `#rrggbb` or `#rrggbbaa` without the sign. */
function fromHex(hex: string): readonly number[] | undefined {
  if (!/^([0-9a-f]{3,4}|[0-9a-f]{6}|[0-9a-f]{8})$/.test(hex)) return undefined;
  const digits = hex.length < 6 ? [...hex].map((digit) => digit + digit) : (hex.match(/../g) as string[]);
  return digits.map((pair) => Number.parseInt(pair, 16) / 255);
}

/** sRGB codes 0..1 of a hue in degrees, a saturation and a lightness (CSS Color 4, section 7.1). */
function fromHsl(hue: number, saturation: number, lightness: number): readonly number[] {
  const amplitude = saturation * Math.min(lightness, 1 - lightness);
  return [0, 8, 4].map((n) => {
    const k = (((n + hue / 30) % 12) + 12) % 12;
    return lightness - amplitude * Math.max(-1, Math.min(k - 3, 9 - k, 1));
  });
}

/** sRGB codes 0..1 and alpha of `rgb()` or `hsl()`, with commas or spaces. */
function fromFunction(text: string): readonly number[] | undefined {
  const [, kind, inner = ''] = /^(rgb|hsl)a?\(([^()]*)\)$/.exec(text) ?? [];
  const separated = inner.includes(',')
    ? inner.split(',')
    : inner
        .replace('/', ' / ')
        .trim()
        .split(/\s+/)
        .filter((part, i) => !(part === '/' && i === 3));
  const parts = separated.map((part) => part.trim());
  if (kind === undefined || parts.length < 3 || parts.length > 4 || !parts.every((part) => NUMBER.test(part)))
    return undefined;
  const value = (at: number) => Number.parseFloat(parts[at] as string);
  const unit = (at: number) => NUMBER.exec(parts[at] as string)?.[3];
  const alpha = parts.length === 4 ? value(3) / (unit(3) === '%' ? 100 : 1) : 1;
  const shares = kind === 'rgb' ? [0, 1, 2] : [1, 2];
  if (parts.some((_, at) => (shares.includes(at) || at === 3) && (unit(at) ?? '%') !== '%')) return undefined;
  if (kind === 'rgb') return [...shares.map((at) => clamp(value(at) / (unit(at) === '%' ? 100 : 255))), alpha];
  if (unit(0) === '%') return undefined;
  return [
    ...fromHsl(value(0) * (DEGREES[unit(0) ?? 'deg'] as number), clamp(value(1) / 100), clamp(value(2) / 100)),
    alpha,
  ];
}

/**
 * A colour of CSS as linear light: a name (`rebeccapurple`), `#rgb`, `#rrggbb`, `rgb()` or `hsl()`, in upper or lower
 * case. sRGB codes out of range are clamped, as CSS does.
 *
 * @param text An opaque colour.
 * @param what Name of the value in errors.
 * @returns Linear Rec.709, 0..1.
 * @throws {ToneMapError} `tonemap/color` for any other text, and for a colour that is not opaque.
 * @example
 * cssColor('#ff8000'); // [1, 0.2158605, 0]
 */
export function cssColor(text: string, what = 'The colour'): Rgb {
  const word = text.trim().toLowerCase();
  const named = NAMED_COLORS.get(word);
  const [r, g, b, alpha = 1] =
    (named === undefined ? (word.startsWith('#') ? fromHex(word.slice(1)) : fromFunction(word)) : fromHex(named)) ?? [];
  const shown = JSON.stringify(text.slice(0, 60));
  if (r === undefined || g === undefined || b === undefined) {
    const meant = /^[a-z]+$/.test(word) ? nearest(word) : undefined;
    throw new ToneMapError(
      'tonemap/color',
      `${what} is ${shown}${meant ? `; did you mean "${meant}"? It` : '; it'} must be a CSS colour: a name, #rgb, #rrggbb, rgb() or hsl().`,
    );
  }
  if (alpha !== 1)
    throw new ToneMapError(
      'tonemap/color',
      `${what} is ${shown}, whose alpha is ${alpha}; it must be opaque. Opacity is a parameter of its own.`,
    );
  return [srgbDecode(r), srgbDecode(g), srgbDecode(b)];
}
