import { GlanzError } from '@glanz/wgsl/error';
import { describe, expect, it } from 'vitest';
import { resolveOptions } from '../src/option-checks';
import {
  MAX_ADAPTIVE_SAMPLES,
  RENDER_OPTION_TEXTS,
  RENDER_OPTIONS,
  takesOption,
  type RenderOption,
  type RenderOptionName,
} from '../src/render-options';

const rows = Object.entries(RENDER_OPTIONS) as [RenderOptionName, RenderOption][];
const numbers = rows.flatMap(([name, row]) => (row.type === 'number' || row.type === 'integer' ? [{ name, row }] : []));

/** The next single value beyond the end of a range: the next integer, or a number that differs by rounding. */
const beyond = (value: number, direction: 1 | -1, type: string) =>
  type === 'integer' ? value + direction : value + direction * Math.max(Number.MIN_VALUE, Math.abs(value) * 2 ** -52);

/** The error that a value of an option throws; `undefined` where it is taken. */
function thrown(name: RenderOptionName, value: unknown): GlanzError | undefined {
  try {
    resolveOptions({ [name]: value });
    return undefined;
  } catch (error) {
    return error as GlanzError;
  }
}

function expectRefusal(name: RenderOptionName, value: unknown): void {
  const error = thrown(name, value);
  expect(error, `${name}: ${String(value)}`).toBeInstanceOf(GlanzError);
  expect(error!.code).toMatch(/^renderer\/(option|samples|filter)$/);
  expect(error!.message).toMatch(new RegExp(`^${name} must be .+, not .+\\.`));
}

describe('the table of render options', () => {
  it.each(numbers)('$name: both ends of its range pass, the next value beyond each throws', ({ name, row }) => {
    const [low, high] = row.range;
    for (const value of [row.above ? beyond(low, 1, row.type) : low, high]) expect(thrown(name, value)).toBeUndefined();
    for (const value of [row.above ? low : beyond(low, -1, row.type), beyond(high, 1, row.type)])
      expectRefusal(name, value);
    if (row.type === 'integer') expectRefusal(name, low + 0.5);
  });

  it.each(rows.map(([name]) => ({ name })))('$name: NaN, infinities and other types throw', ({ name }) => {
    for (const value of [NaN, Infinity, -Infinity, '', '2', null, [1], { no: 1 }, 2n, Symbol('no'), () => 2])
      expectRefusal(name, value);
    if (RENDER_OPTIONS[name].type !== 'boolean') expectRefusal(name, true);
  });

  it('takes every name of an enum, and each default', () => {
    for (const [name, row] of rows) {
      if (row.type === 'enum') for (const value of row.values) expect(takesOption(name, value)).toBe(true);
      if (row.default !== undefined) expect(takesOption(name, row.default), name).toBe(true);
    }
    expect(resolveOptions({})).toEqual(
      Object.fromEntries(rows.flatMap(([name, row]) => (row.default === undefined ? [] : [[name, row.default]]))),
    );
  });

  it('takes filters with a radius, and limits of each kind', () => {
    const { range, radii } = RENDER_OPTIONS.filter;
    for (const type of Object.keys(radii) as (keyof typeof radii)[]) {
      for (const radius of [Number.MIN_VALUE, range[1]])
        expect(thrown('filter', { type, radius }), type).toBeUndefined();
      for (const radius of [range[0], beyond(range[1], 1, 'number'), NaN, '1', null])
        expectRefusal('filter', { type, radius });
    }
    const [low, high] = RENDER_OPTIONS.maxBounces.range;
    for (const kind of RENDER_OPTIONS.maxBounces.values) {
      for (const limit of [low, high, undefined]) expect(thrown('maxBounces', { [kind]: limit })).toBeUndefined();
      for (const limit of [low - 1, high + 1, 0.5, NaN, '1', null]) expectRefusal('maxBounces', { [kind]: limit });
    }
  });

  it('states the maximum number of adaptive samples in the text about samples', () =>
    expect(RENDER_OPTION_TEXTS.samples.doc).toContain(String(MAX_ADAPTIVE_SAMPLES)));

  it('has a text of one or two sentences for each, and a slider range inside of the range', () => {
    for (const [name, row] of rows) {
      const { doc, softRange } = RENDER_OPTION_TEXTS[name];
      expect(doc, name).toMatch(/^[A-Z].*\w+.*[.)]$/);
      expect(doc.length, name).toBeLessThan(200);
      if (!softRange || !('range' in row)) continue;
      expect(softRange[0], name).toBeGreaterThanOrEqual(row.range[0]);
      expect(softRange[1], name).toBeLessThanOrEqual(row.range[1]);
    }
  });
});
