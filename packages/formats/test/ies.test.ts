import { validateScene, createScene } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { FormatError, readIes } from '../src/index';

/** A file of LM-63-2002; `body` from the line of the angles on. */
const file = (
  verticals: number,
  horizontals: number,
  body: string,
  { multiplier = 1, type = 1, ballast = 1, tilt = 'NONE' } = {},
) =>
  `IESNA:LM-63-2002\n[TEST] 1\n[MANUFAC] nobody\nTILT=${tilt}\n1 1000 ${multiplier} ${verticals} ${horizontals} ${type} 2 0.1 0.1 0\n${ballast} 1 10\n${body}`;

const degrees = (values: Float32Array) => [...values].map((angle) => Math.round((angle * 180e3) / Math.PI) / 1e3);

describe('readIes', () => {
  test('one plane: the same all around, with all factors', () => {
    const profile = readIes(file(3, 1, '0 45 90\n0\n100, 50\n0', { multiplier: 2, ballast: 0.5 }));
    expect(degrees(profile.vertical)).toEqual([0, 45, 90]);
    expect(degrees(profile.horizontal)).toEqual([0]);
    expect([...profile.intensities]).toEqual([100, 50, 0]);
  });

  test.each<[string, string, number[], number[]]>([
    ['a quarter', '0 45 90', [0, 45, 90, 135, 180, 225, 270, 315], [1, 2, 3, 2, 1, 2, 3, 2]],
    ['a half', '0 60 180', [0, 60, 180, 300], [1, 2, 3, 2]],
    ['the other half', '90 180 270', [0, 90, 180, 270], [3, 1, 3, 5]],
    // Between 60 (3) and 270 (5), which are 60 and 90 away.
    ['the other half, without a plane at 0', '90 120 270', [0, 60, 90, 120, 270], [3.8, 3, 1, 3, 5]],
    ['a whole turn', '0 120 360', [0, 120], [1, 3]],
    ['a whole turn without its end', '0 120 240', [0, 120, 240], [1, 3, 5]],
  ])('%s is completed', (what, horizontal, angles, firsts) => {
    const rows = what === 'a quarter' || what === 'a half' ? '1 10\n2 20\n3 30' : '1 10\n3 30\n5 50';
    const text = file(2, 3, `0 90\n${horizontal}\n${rows}`);
    const profile = readIes(text);
    expect(degrees(profile.horizontal)).toEqual(angles);
    [...profile.intensities]
      .filter((_, i) => i % 2 === 0)
      .forEach((value, i) => expect(value).toBeCloseTo(firsts[i]!, 5));
  });

  test('old files, tilted luminaires and bytes', () => {
    const old =
      'A LUMINAIRE OF 1986\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n1 1000 1 2 1 1 1 0 0 0\n1 1 50\n0 180\n0\n7 8\n';
    expect([...readIes(new TextEncoder().encode(old)).intensities]).toEqual([7, 8]);
  });

  test('the scene takes what it gives', () => {
    const scene = createScene();
    scene.lights.push({
      type: 'profile',
      name: 'downlight',
      color: [1, 1, 1],
      intensity: 1,
      position: [0, 2, 0],
      direction: [0, -1, 0],
      profile: readIes(file(3, 3, '0 45 90\n0 45 90\n1 2 3 4 5 6 7 8 9')),
    });
    expect(() => validateScene(scene)).not.toThrow();
  });

  test.each<[string, string, string, RegExp]>([
    ['no IES file', 'solid teapot', 'formats/malformed', /TILT=/],
    ['cut off', file(3, 1, '0 45 90\n0\n100 50'), 'formats/truncated', /an intensity/],
    ['a word for a number', file(3, 1, '0 45 90\n0\n100 fifty 0'), 'formats/malformed', /"fifty"/],
    ['type B', file(3, 1, '0 45 90\n0\n1 1 1', { type: 2 }), 'formats/unsupported', /type B/],
    ['more angles than memory', file(1e9, 1, '0'), 'formats/malformed', /1000000000/],
    ['no angles', file(0, 1, '0'), 'formats/malformed', /vertical angles is 0/],
    ['angles that fall', file(3, 1, '0 90 45\n0\n1 1 1'), 'formats/malformed', /vertical angles must rise/],
    ['a third of a turn', file(2, 2, '0 90\n0 120\n1 1 1 1'), 'formats/malformed', /0 to 120/],
    ['a negative intensity', file(2, 1, '0 90\n0\n1 -1'), 'formats/malformed', /negative/],
    ['infinity', file(2, 1, '0 90\n0\n1 1e999'), 'formats/malformed', /1e999/],
  ])('%s', (_, text, code, message) => {
    const read = () => readIes(text, { name: 'a.ies' });
    expect(read).toThrow(FormatError);
    expect(read).toThrow(message);
    try {
      read();
    } catch (error) {
      expect((error as FormatError).code).toBe(code);
    }
  });
});
