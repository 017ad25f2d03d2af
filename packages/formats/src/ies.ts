import type { LightProfile } from '@glanz/scene';
import { FormatError } from './error';

/** Options for {@link readIes}. */
export interface IesOptions {
  /** What messages call the file. Default "IES". */
  readonly name?: string;
}

const RADIANS = Math.PI / 180;
/** More angles than any photometer measures; a file that says more is broken, or wants memory. */
const MAX_ANGLES = 4096;

/**
 * Reads a photometric file (ANSI/IES LM-63 of 1986 to 2019, type C) as the profile of a luminaire, for a `ProfileLight` of a
 * scene. Candela with all factors of the file; symmetric ones are completed to all directions.
 *
 * @param source The file's text or bytes (Latin-1, as only its numbers count).
 * @throws {FormatError} `formats/malformed`, `formats/truncated`, `formats/unsupported` for photometry of type A and B.
 * @example
 * scene.lights.push({ type: 'profile', name: 'downlight', color: [1, 1, 1], intensity: 0.01, position: [0, 2.4, 0],
 * direction: [0, -1, 0], profile: readIes(bytes) });
 */
export function readIes(source: string | Uint8Array, { name = 'IES' }: IesOptions = {}): LightProfile {
  const text = typeof source === 'string' ? source : new TextDecoder('latin1').decode(source);
  const location = { file: name };
  const tilt = /^[ \t]*TILT[ \t]*=[ \t]*(.*?)[ \t]*$/im.exec(text);
  if (!tilt)
    throw new FormatError('formats/malformed', `${name} is not an IES file: it has no line "TILT=".`, { location });
  const words = text
    .slice(tilt.index + tilt[0].length)
    .split(/[\s,]+/)
    .filter((word) => word !== '');
  let at = 0;
  const next = (what: string): number => {
    const word = words[at++];
    if (word === undefined) throw new FormatError('formats/truncated', `${name} ends before ${what}.`, { location });
    const value = Number(word);
    if (!Number.isFinite(value))
      throw new FormatError('formats/malformed', `${name}: ${what} is "${word.slice(0, 40)}", which is not a number.`, {
        location,
      });
    return value;
  };
  const count = (what: string): number => {
    const value = next(what);
    if (!(Number.isInteger(value) && value >= 1 && value <= MAX_ANGLES))
      throw new FormatError(
        'formats/malformed',
        `${name}: ${what} is ${value}; it must be a whole number of 1 to ${MAX_ANGLES}.`,
        { location },
      );
    return value;
  };
  if (/^INCLUDE$/i.test(tilt[1] as string)) {
    // Losses of a tilted luminaire: a number for the mounting, then as many angles and factors as it says.
    next('the mounting');
    for (let left = 2 * count('the number of tilts'); left > 0; left--) next('a tilt');
  }
  next('the number of lamps');
  next('the lumens of a lamp');
  const multiplier = next('the multiplier');
  const verticals = count('the number of vertical angles'),
    horizontals = count('the number of horizontal angles');
  const type = next('the photometric type');
  if (type !== 1)
    throw new FormatError(
      'formats/unsupported',
      `${name} has photometry of type ${type === 2 ? 'B' : type === 3 ? 'A' : type}; only type C is read. Convert it with a photometric editor.`,
      { location },
    );
  for (const what of ['the units', 'the width', 'the length', 'the height']) next(what);
  const factor = multiplier * next('the ballast factor');
  next('the ballast lamp factor');
  next('the watts');
  const angles = (n: number, what: string) => Array.from({ length: n }, () => next(what));
  const vertical = angles(verticals, 'a vertical angle');
  const horizontal = angles(horizontals, 'a horizontal angle');
  const rows = horizontal.map(() => angles(verticals, 'an intensity'));
  for (const [list, what, max] of [
    [vertical, 'vertical', 180],
    [horizontal, 'horizontal', 360],
  ] as const) {
    if (list.some((angle, i) => angle < 0 || angle > max || (i > 0 && angle <= (list[i - 1] as number))))
      throw new FormatError(
        'formats/malformed',
        `${name}: its ${what} angles must rise and lie within 0 to ${max} degrees.`,
        { location },
      );
  }
  if (verticals < 2) throw new FormatError('formats/malformed', `${name} has one vertical angle only.`, { location });
  if (!(factor >= 0) || rows.some((row) => row.some((value) => value * factor < 0)))
    throw new FormatError('formats/malformed', `${name} has negative intensities.`, { location });
  const around = complete(horizontal, rows, name);
  return {
    vertical: Float32Array.from(vertical, (angle) => angle * RADIANS),
    horizontal: Float32Array.from(around, ([angle]) => angle * RADIANS),
    intensities: Float32Array.from(
      around.flatMap(([, row]) => row),
      (value) => value * factor,
    ),
  };
}

type Plane = readonly [degrees: number, row: readonly number[]];

/** All planes around a luminaire by those that its file has: 0; 0 to 90; 0 to 180; 90 to 270; or 0 to 360 degrees. */
function complete(horizontal: readonly number[], rows: readonly (readonly number[])[], name: string): Plane[] {
  const given: Plane[] = horizontal.map((angle, i) => [angle, rows[i] as readonly number[]]);
  const [first, last] = [horizontal[0] as number, horizontal.at(-1) as number];
  if (given.length === 1) return [[0, rows[0] as readonly number[]]];
  const mirrored = (planes: readonly Plane[], about: number): Plane[] =>
    planes.map(([angle, row]): Plane => [(((2 * about - angle) % 360) + 360) % 360, row]);
  let planes = given;
  if (first === 0 && last === 90) planes = [...planes, ...mirrored(planes, 90)];
  if (first === 0 && (last === 90 || last === 180)) planes = [...planes, ...mirrored(planes, 180)];
  else if (first === 90 && last === 270) planes = [...planes, ...mirrored(planes, 90)];
  else if (!(first === 0 && last > 180))
    throw new FormatError(
      'formats/malformed',
      `${name}: its horizontal angles go from ${first} to ${last} degrees; 0, 0–90, 0–180, 90–270 and 0–360 are known.`,
      { location: { file: name } },
    );
  const whole = new Map<number, readonly number[]>();
  for (const [angle, row] of planes) if (!whole.has(angle % 360)) whole.set(angle % 360, row);
  const sorted = [...whole].sort(([a], [b]) => a - b);
  const [low, high] = [sorted[0] as Plane, sorted.at(-1) as Plane];
  if (low[0] === 0) return sorted;
  // None lies at 0: the ones before and after it say what would.
  const share = (360 - high[0]) / (360 - high[0] + low[0]);
  return [[0, low[1].map((value, i) => share * value + (1 - share) * (high[1][i] as number))], ...sorted];
}
