import { describe, expect, it } from 'vitest';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { convertCommand, parseConvert } from '../src/commands/convert';
import { parseCommand } from '../src/command';
import type { CliIo } from '../src/index';
import { temporaryFolder } from './fakes';

const io = (cwd: string) => {
  const out: string[] = [],
    err: string[] = [];
  return {
    out,
    err,
    io: {
      cwd,
      now: () => 5,
      stdout: (text: string) => out.push(text),
      stderr: (text: string) => err.push(text),
    } as unknown as CliIo,
  };
};

describe('the command line', () => {
  it('everything at once', () => {
    expect(
      parseCommand([
        'convert',
        'a/part.step',
        '-o',
        'out.glb',
        '--lod',
        '3',
        '--materials',
        'map.json',
        '--strip',
        '--tolerance',
        '0.1',
        '--json',
      ]),
    ).toEqual({
      kind: 'convert',
      json: true,
      quiet: false,
      options: {
        input: 'a/part.step',
        output: 'out.glb',
        levels: 3,
        materials: 'map.json',
        strip: true,
        tolerance: 0.0001,
      },
    });
  });
  it('nothing but the model', () => {
    expect(parseConvert(['a/part.v2.step']).options).toEqual({
      input: 'a/part.v2.step',
      output: 'part.v2.glb',
      levels: 1,
      materials: undefined,
      strip: false,
      tolerance: undefined,
    });
  });
  it.each([
    [[]],
    [['a', 'b']],
    [['a', '--lod', '0']],
    [['a', '--lod', 'x']],
    [['a', '--tolerance', '-1']],
    [['a', '-o', 'b.png']],
    [['a', '--no-such']],
  ])('wrong: %j', (argv) => {
    expect(() => parseConvert(argv)).toThrow(expect.objectContaining({ code: 'cli/usage' }) as Error);
  });
});

it('paths are those of the folder the user is in, and every file is reported', async () => {
  const cwd = temporaryFolder({ 'part.step': 'x', 'map.json': '{}' });
  const { io: own, err, out } = io(cwd);
  const asked: unknown[] = [];
  const code = await convertCommand(
    parseConvert(['part.step', '--materials', 'map.json', '--strip', '--lod', '2']),
    own,
    async (...given) => {
      asked.push(given);
      return [
        { path: join(cwd, 'part.glb'), bytes: 2500, triangles: 12, parts: 1, materials: 1 },
        { path: join(cwd, 'part.lod1.glb'), bytes: 1000, triangles: 4, parts: 1, materials: 1 },
      ];
    },
  );
  expect(code).toBe(0);
  expect(asked).toEqual([
    [join(cwd, 'part.step'), join(cwd, 'part.glb'), { levels: 2, strip: true, materials: join(cwd, 'map.json') }],
  ]);
  expect(err.join('')).toBe(
    'part.glb: 12 triangles, 1 parts, 1 materials, 2.5 kB\npart.lod1.glb: 4 triangles, 1 parts, 1 materials, 1.0 kB\n',
  );
  expect(out).toEqual([]);
});

it('files that are missing', async () => {
  const cwd = temporaryFolder({ 'part.step': 'x' });
  await expect(convertCommand(parseConvert(['none.step']), io(cwd).io)).rejects.toMatchObject({ code: 'cli/input' });
  await expect(
    convertCommand(parseConvert(['part.step', '--materials', 'none.json']), io(cwd).io),
  ).rejects.toMatchObject({ code: 'cli/input' });
  await expect(convertCommand(parseConvert(['part.step', '--json']), io(cwd).io)).rejects.toMatchObject({
    code: 'cad/format',
  });
  expect(existsSync(join(cwd, 'part.glb'))).toBe(false);
});
