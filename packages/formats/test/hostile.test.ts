// Malicious files: small, and made to take much time or memory or to read other files.
import { validateScene } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { FormatError, readObj, readStl, type ObjOptions } from '../src/index';

const bytes = (text: string) => new TextEncoder().encode(text);
const TRIANGLE = 'v 0 0 0\nv 1 0 0\nv 0 1 0\n';

/** Reads an OBJ; what it asks for goes into `asked`, nothing is there but a given library. */
async function obj(text: string, options: Partial<ObjOptions> = {}, library?: string) {
  const asked: string[] = [];
  const scene = await readObj(bytes(text), {
    name: 'a.obj',
    read: async (path) => {
      asked.push(path);
      return path === 'm.mtl' && library !== undefined ? bytes(library) : undefined;
    },
    decodeImage: async () => ({ width: 1, height: 1, data: new Uint8Array([1, 2, 3, 255]) }),
    ...options,
  });
  validateScene(scene);
  return { scene, asked };
}

describe('OBJ', { timeout: 60_000 }, () => {
  test('libraries and images outside the folder are not asked for', async () => {
    const away = [
      '../secret',
      '../../etc/passwd',
      '/etc/passwd',
      'C:\\secret',
      '\\\\server\\share',
      'http://example.org/x',
      'file:///etc/passwd',
      'a/../../secret',
      '..\\secret',
    ];
    for (const path of away) {
      const library = await obj(`mtllib ${path}\n${TRIANGLE}f 1 2 3`);
      expect([path, library.asked, library.scene.warnings.length]).toEqual([path, [], 1]);
      const image = await obj(
        `mtllib m.mtl\nusemtl a\n${TRIANGLE}f 1 2 3`,
        {},
        `newmtl a\nmap_Kd ${path}\nmap_Bump -bm 1 ${path}`,
      );
      expect([path, image.asked]).toEqual([path, ['m.mtl']]);
    }
  });

  test('names of inherited properties are names', async () => {
    const { scene } = await obj(
      `mtllib m.mtl\n${TRIANGLE}usemtl __proto__\nf 1 2 3\nusemtl constructor\nf 1 3 2`,
      {},
      'newmtl __proto__\nKd 1 0 0\nnewmtl constructor\nKd 0 1 0',
    );
    expect(scene.instances.map(({ material }) => scene.materials[material]!.parameters.base_color)).toEqual([
      [1, 0, 0],
      [0, 1, 0],
    ]);
    expect('Kd' in {}).toBe(false);
  });

  test('a group or a material for each of a hundred thousand triangles', async () => {
    const count = 100_000;
    const { scene } = await obj(
      TRIANGLE + Array.from({ length: count }, (_, i) => `o part${i}\nusemtl m${i}\nf 1 2 3\n`).join(''),
    );
    expect(scene.instances.length).toBe(count);
  });

  test('numbers and indices beyond all bounds', async () => {
    const { scene } = await obj(
      `v 1e999 nan inf\n${TRIANGLE}f 1 2 3\nf 2 3 99999999999999999999\nf -1 -2 -99999999\nf 0 0 0\nf 2/9/9 3/-9/-9 4/x/y\nf 2 3 4`,
    );
    expect(scene.meshes[0]!.indices.length).toBeLessThanOrEqual(6);
    expect(scene.warnings.length).toBeGreaterThan(0);
  });

  test.each([
    ['a polygon of a million corners', `${TRIANGLE}f ${'1 2 3 '.repeat(300_000)}`],
    ['a line of thirty megabytes', `${TRIANGLE}# ${'x'.repeat(3e7)}\nf 1 2 3`],
  ])('%s', async (_, text) => {
    expect((await obj(text)).scene.instances.length).toBe(1);
  });

  test.each([
    ['nothing', ''],
    ['zeros', '\0'.repeat(1e6)],
    ['lines without an end', `${TRIANGLE}${'f 1 2 3 \\\n'.repeat(100_000)}`],
  ])('%s is an error', async (_, text) => {
    await expect(obj(text)).rejects.toBeInstanceOf(FormatError);
  });
});

describe('STL', { timeout: 60_000 }, () => {
  const head = (count: number, length: number, start = '') => {
    const made = new Uint8Array(length);
    made.set(bytes(start));
    new DataView(made.buffer).setUint32(80, count, true);
    return made;
  };

  test.each([
    ['more triangles than bytes', head(0xffffffff, 134), 'formats/truncated'],
    ['no triangles', head(0, 84), 'formats/no-triangles'],
    ['less than a head', new Uint8Array(10), 'formats/truncated'],
    ['nothing', new Uint8Array(0), 'formats/truncated'],
    ['corners without end', bytes(`solid\n${'vertex 0 0 0\n'.repeat(300_000)}`), 'formats/no-triangles'],
    [
      'a facet of four corners',
      bytes('solid\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendfacet'),
      'formats/malformed',
    ],
    [
      'corners that are no numbers',
      bytes('solid\nvertex a b c\nvertex 1 0 0\nvertex 0 1 0\nendfacet'),
      'formats/no-triangles',
    ],
    ['blanks', bytes(`solid${' '.repeat(2e6)}`), 'formats/no-triangles'],
  ])('%s', (_, file, code) => {
    expect(() => readStl(file)).toThrow(expect.objectContaining({ code }) as Error);
  });

  test('a binary file that begins like a text', () => {
    expect(readStl(head(1, 134, 'solid x')).meshes[0]!.indices.length).toBe(3);
  });
});
