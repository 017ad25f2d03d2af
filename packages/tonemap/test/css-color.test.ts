import { GlanzError } from '@glanz/wgsl/error';
import { describe, expect, it } from 'vitest';
import { cssColor } from '../src/css-color';

/** IEC 61966-2-1. */
const linear = (code: number) => (code / 255 <= 0.04045 ? code / 255 / 12.92 : ((code / 255 + 0.055) / 1.055) ** 2.4);

describe('cssColor', () => {
  // The equalities are those of CSS Color 4.
  it.each([
    ['#ff8000', [255, 128, 0]],
    ['#F80', [255, 136, 0]],
    ['#ff8000ff', [255, 128, 0]],
    ['rebeccapurple', [0x66, 0x33, 0x99]],
    ['RebeccaPurple ', [0x66, 0x33, 0x99]],
    ['rgb(255, 128, 0)', [255, 128, 0]],
    ['rgb(255 128 0 / 1)', [255, 128, 0]],
    ['rgba(100% 50% 0%/100%)', [255, 127.5, 0]],
    ['rgb(300 -5 0)', [255, 0, 0]],
    ['hsl(120deg 100% 25%)', [0, 127.5, 0]],
    ['hsl(270, 60%, 70%)', [178.5, 132.6, 224.4]],
    ['hsl(-0.25turn 60% 70%)', [178.5, 132.6, 224.4]],
    ['hsl(0 0% 50%)', [127.5, 127.5, 127.5]],
  ] as const)('%s', (text, codes) => {
    cssColor(text).forEach((value, k) => expect(value).toBeCloseTo(linear(codes[k]!), 7));
  });

  const complaint = (text: string, what?: string) => {
    try {
      cssColor(text, what);
    } catch (error) {
      expect(error).toBeInstanceOf(GlanzError);
      expect((error as GlanzError).code).toBe('tonemap/color');
      return (error as Error).message;
    }
    return 'no error';
  };

  it.each([
    '',
    '#ff80',
    '#12',
    '#ggg',
    'rgb(1 2)',
    'rgb(1 2 3 4)',
    'rgb(1deg 2 3)',
    'rgb(1, 2, 3',
    'hsl(10% 20% 30%)',
    'hsl(10 20% 30deg)',
    'var(--x)',
    'url(x)',
    'constructor',
  ])('refuses %j', (text) => {
    expect(complaint(text)).toMatch(
      /^The colour is ".*(must be a CSS colour: a name, #rgb, #rrggbb, rgb\(\) or hsl\(\)|must be opaque)/,
    );
  });

  it('names what was meant, and the value; alpha has no place in it', () => {
    expect(complaint('rebecapurple', 'base_color')).toContain(
      'base_color is "rebecapurple"; did you mean "rebeccapurple"?',
    );
    expect(complaint('zzzzzzzz')).not.toContain('did you mean');
    for (const text of ['#ff800080', 'rgb(1 2 3 / 50%)', 'rgba(1, 2, 3, 0.5)'])
      expect(complaint(text)).toContain('must be opaque');
  });
});
