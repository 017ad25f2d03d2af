import { describe, expect, it } from 'vitest';
import { plot } from '../../src/equal-time/plot';

const series = {
  name: 'a & b',
  colour: '#123456',
  points: [
    [0.1, 1],
    [1, 0.1],
    [10, 0.01],
  ] as const,
};
const coordinates = (svg: string) =>
  [.../<polyline points="([^"]+)"/.exec(svg)![1]!.matchAll(/([\d.]+),([\d.]+)/g)].map(
    ([, x, y]) => [Number(x), Number(y)] as const,
  );

describe('plot', () => {
  it('draws powers of ten at equal distances, smaller values lower', () => {
    const [a, b, c] = coordinates(plot([{ title: 't', series: [series] }], { title: 'T', x: 'x', y: 'y' })) as [
      readonly [number, number],
      readonly [number, number],
      readonly [number, number],
    ];
    expect(b[0] - a[0]).toBeCloseTo(c[0] - b[0], 0);
    expect(b[1] - a[1]).toBeCloseTo(c[1] - b[1], 0);
    expect(c[1]).toBeGreaterThan(a[1]);
  });

  it('keeps to its frame, whatever the values', () => {
    const wild = {
      ...series,
      points: [
        [3e-4, 2e5],
        [7e3, 4e-9],
      ] as const,
    };
    const svg = plot([{ title: 't', series: [wild] }], { title: 'T', x: 'x', y: 'y' });
    const [width, height] = /viewBox="0 0 (\d+) (\d+)"/.exec(svg)!.slice(1).map(Number) as [number, number];
    for (const [x, y] of coordinates(svg)) expect(x > 0 && x < width && y > 0 && y < height).toBe(true);
  });

  it('escapes names, and closes what it opens', () => {
    const svg = plot(
      [
        { title: '<t>', series: [series] },
        { title: 'u', series: [series] },
      ],
      { title: 'T', x: 'x', y: 'y', columns: 1 },
    );
    expect(svg).toContain('a &#38; b');
    expect(svg).toContain('&#60;t&#62;');
    const open: string[] = [];
    for (const [tag, end, name, empty] of svg.matchAll(/<(\/?)([a-z]+)[^>]*?(\/?)>/g)) {
      if (end) expect(open.pop(), tag).toBe(name);
      else if (!empty) open.push(name!);
    }
    expect(open).toEqual([]);
  });

  it('leaves out what a logarithm has no place for, and refuses to draw nothing', () => {
    expect(
      coordinates(
        plot(
          [
            {
              title: 't',
              series: [
                {
                  ...series,
                  points: [
                    [1, 1],
                    [2, 0],
                    [4, 2],
                  ],
                },
              ],
            },
          ],
          { title: 'T', x: 'x', y: 'y' },
        ),
      ),
    ).toHaveLength(2);
    expect(() => plot([], { title: 'T', x: 'x', y: 'y' })).toThrow(RangeError);
  });
});
