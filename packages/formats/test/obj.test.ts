import { validateScene, type Scene } from '@glanz/scene';
import { OBJLoader } from 'three/examples/jsm/loaders/OBJLoader.js';
import { describe, expect, it } from 'vitest';
import { FormatError, readObj } from '../src/index';

const bytes = (text: string) => new TextEncoder().encode(text);
const QUAD = 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n';

/** Corners of all triangles, sorted: what two readers must agree on whatever their vertices. */
function soup(scene: Scene): string[] {
  return scene.instances
    .flatMap(({ mesh }) => {
      const { positions, indices } = scene.meshes[mesh]!;
      return Array.from({ length: indices.length / 3 }, (_, t) =>
        [0, 1, 2]
          .map((k) => Array.from(positions.subarray(3 * indices[3 * t + k]!, 3 * indices[3 * t + k]! + 3)).join(','))
          .join(' '),
      );
    })
    .sort();
}

describe('faces', () => {
  it('every way to name a corner, from the start and from the end', async () => {
    for (const face of [
      'f 1 2 3',
      'f 1/1 2/2 3/3',
      'f 1//1 2//1 3//1',
      'f 1/1/1 2/2/1 3/3/1',
      'f -4 -3 -2',
      'f 1 2\\\n 3',
    ]) {
      const scene = await readObj(bytes(`${QUAD}vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 2\n${face}\n`));
      expect(soup(scene)).toEqual(['0,0,0 1,0,0 1,1,0']);
      expect(validateScene(scene)).toEqual([]);
    }
  });

  it('normals have length 1, and v of texture coordinates is turned', async () => {
    const {
      meshes: [mesh],
    } = await readObj(bytes(`${QUAD}vt 0.25 0\nvt 1 0\nvt 1 0.75\nvn 0 0 2\nf 1/1/1 2/2/1 3/3/1\n`));
    expect(Array.from(mesh!.normals!)).toEqual([0, 0, 1, 0, 0, 1, 0, 0, 1]);
    expect(Array.from(mesh!.uvs![0]!)).toEqual([0.25, 1, 1, 1, 1, 0.25]);
  });

  it('polygons keep their area and their side, also where they are hollow', async () => {
    // An L, counter-clockwise from +z: a fan around its first corner would cover what lies outside.
    const {
      meshes: [mesh],
    } = await readObj(bytes('v 2 2 0\nv 0 2 0\nv 0 0 0\nv 3 0 0\nv 3 1 0\nv 2 1 0\nf 4 5 6 1 2 3\n'));
    let area = 0;
    for (let t = 0; t < mesh!.indices.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => 3 * mesh!.indices[t + k]!) as [number, number, number];
      const P = mesh!.positions;
      const double = (P[b]! - P[a]!) * (P[c + 1]! - P[a + 1]!) - (P[b + 1]! - P[a + 1]!) * (P[c]! - P[a]!);
      expect(double).toBeGreaterThan(0);
      area += double / 2;
    }
    expect(mesh!.indices.length).toBe(12);
    expect(area).toBeCloseTo(5, 12);
  });

  it('faces that name nothing are left out and reported once', async () => {
    const scene = await readObj(
      bytes(`${QUAD}v nan 0 0\nf 1 2 3\nf 1 2 9\nf 1 2 5\nf 0 1 2\nf a b c\nl 1 2\ncurv 1 2\n`),
    );
    expect(soup(scene)).toEqual(['0,0,0 1,0,0 1,1,0']);
    expect(scene.warnings.map(({ code }) => code)).toEqual(['formats/face', 'formats/ignored', 'formats/ignored']);
    expect(scene.warnings[0]!.message).toMatch(/line 7 and 3 more/);
  });

  it('a file of nothing', async () => {
    await expect(readObj(bytes('# nothing\n'))).rejects.toThrow(FormatError);
    await expect(readObj(new Uint8Array(0))).rejects.toMatchObject({ code: 'formats/no-triangles' });
  });
});

it('three.js finds the same triangles in a file of objects, groups, quads and materials', async () => {
  let text = '',
    base = 1;
  for (let o = 0; o < 4; o++) {
    text += `o part ${o}\nusemtl m${o % 2}\n`;
    for (let k = 0; k < 8; k++) text += `v ${o + (k & 1)} ${(k >> 1) & 1} ${k >> 2}\n`;
    for (const face of [
      [0, 2, 3, 1],
      [4, 5, 7, 6],
      [0, 1, 5, 4],
    ])
      text += `f ${face.map((k) => base + k).join(' ')}\n`;
    base += 8;
  }
  const ours = await readObj(bytes(text));
  expect(ours.instances.length).toBe(4);
  const theirs: string[] = [];
  new OBJLoader().parse(text).traverse((object) => {
    const position = object.geometry?.getAttribute('position');
    if (!position) return;
    for (let i = 0; i < position.count; i += 3)
      theirs.push(
        [0, 1, 2].map((k) => [position.getX(i + k), position.getY(i + k), position.getZ(i + k)].join(',')).join(' '),
      );
  });
  // Quads may be cut along either diagonal: compare what covers them.
  const covered = (list: string[]) => new Set(list.flatMap((triangle) => triangle.split(' ')));
  expect(covered(soup(ours))).toEqual(covered(theirs));
  expect(soup(ours).length).toBe(theirs.length);
});

it('smoothing groups are smoothed where a file has no normals, and no further', async () => {
  // Two triangles that meet at a right angle along the y axis.
  const corner = 'v 0 0 0\nv 0 1 0\nv 1 0 0\nv 0 0 1\n';
  const smooth = (await readObj(bytes(`${corner}s 1\nf 1 3 2\nf 1 2 4\n`))).meshes[0]!;
  const shared = Array.from(smooth.normals!).map((x) => Math.round(x * 1e6) / 1e6);
  expect(smooth.positions.length).toBe(12);
  expect(shared.slice(0, 3)).toEqual([Math.SQRT1_2, 0, Math.SQRT1_2].map((x) => Math.round(x * 1e6) / 1e6));
  expect((await readObj(bytes(`${corner}s off\nf 1 3 2\nf 1 2 4\n`))).meshes[0]!.normals).toBeUndefined();
  const apart = (await readObj(bytes(`${corner}s 1\nf 1 3 2\ns 2\nf 1 2 4\n`))).meshes[0]!;
  expect(apart.positions.length).toBe(18);
  expect(new Set(Array.from({ length: 6 }, (_, v) => apart.normals!.slice(3 * v, 3 * v + 3).join(',')))).toEqual(
    new Set(['0,0,1', '1,0,0']),
  );
});

describe('materials', () => {
  const MTL =
    'newmtl red\nKd 0.8 0.1 0.1\nNs 30\nd 0.5\nnewmtl lamp\nKd 0 0 0\nKe 4 2 0\nnewmtl metal\nKd 1 1 1\nPm 1\nPr 0.2\nmap_Kd -s 2 3 1 -clamp on tex/my image.png\nnewmtl glass\nillum 7\nNi 1.6\n';
  const OBJ = `mtllib a/b.mtl\n${QUAD}vt 0 0\nusemtl red\nf 1 2 3\nusemtl lamp\nf 1 2 4\nusemtl metal\nf 1/1 3/1 4/1\nusemtl glass\nf 2 3 4\nusemtl none\nf 1 2 3\n`;
  const asked: string[] = [];
  const read = async (path: string) => {
    asked.push(path);
    return path === 'a/b.mtl' ? bytes(MTL) : path === 'a/tex/my image.png' ? new Uint8Array([1]) : undefined;
  };
  const decodeImage = async () => ({ width: 1, height: 1, data: new Uint8Array([9, 8, 7, 255]) });

  it('Phong and physically based statements as OpenPBR, images by their paths', async () => {
    const scene = await readObj(bytes(OBJ), { read, decodeImage });
    const by = (name: string) => scene.materials.find((material) => material.name === name)!;
    expect(by('red').parameters).toEqual({
      base_color: [0.8, 0.1, 0.1],
      specular_roughness: (2 / 32) ** 0.25,
      geometry_opacity: 0.5,
    });
    expect(by('lamp').parameters).toMatchObject({ emission_color: [1, 0.5, 0], emission_luminance: 4 });
    expect(by('metal').parameters).toEqual({ base_color: [1, 1, 1], base_metalness: 1, specular_roughness: 0.2 });
    expect(by('glass').parameters).toEqual({ transmission_weight: 1, specular_ior: 1.6 });
    // v' = 1 − 3 (1 − v) = 3 v − 2, clamped.
    expect(by('metal').textures).toEqual({
      base_color: { texture: 0, channels: 'rgb', transform: [2, 0, 0, 3, 0, -2] },
    });
    expect(scene.textures).toEqual([{ image: 0, color_space: 'srgb', wrap_u: 'clamp', wrap_v: 'clamp' }]);
    expect(scene.warnings.map(({ code }) => code)).toEqual(['formats/missing-material']);
    expect(validateScene(scene)).toEqual([]);
  });

  it('nothing outside the folder is asked for', async () => {
    asked.length = 0;
    const scene = await readObj(
      bytes(`mtllib ../secret.mtl\nmtllib /etc/passwd\nmtllib http://example.org/a.mtl\n${QUAD}f 1 2 3\n`),
      { read },
    );
    expect(asked).toEqual([]);
    expect(scene.warnings.length).toBe(3);
  });
});

it('colours of vertices', async () => {
  const {
    meshes: [mesh],
  } = await readObj(bytes('v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n'));
  expect(Array.from(mesh!.colors!)).toEqual([1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1]);
});

it('broken files end in scenes or typed errors (seed 3, 3,000 files)', async () => {
  const words = [
    'v',
    'vt',
    'vn',
    'f',
    'o',
    'usemtl',
    's',
    'mtllib',
    '1',
    '-1',
    '0',
    '1/1',
    '1//1',
    '/',
    'NaN',
    '1e99',
    '-999999999',
    '',
    '\\',
    '#',
    '1/2/3/4',
    '__proto__',
  ];
  let state = 3;
  const below = (n: number) => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) % n;
  for (let i = 0; i < 3000; i++) {
    const text = `${QUAD}f 1 2 3\n${Array.from({ length: below(30) }, () => Array.from({ length: below(7) }, () => words[below(words.length)]).join(' ')).join('\n')}`;
    try {
      validateScene(await readObj(bytes(text), { read: async () => bytes(text) }));
    } catch (error) {
      if (!(error instanceof FormatError)) throw error;
    }
  }
});
