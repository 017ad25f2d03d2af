import { mkdtemp, mkdir, rm, symlink, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import sharp from 'sharp';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { isModelFile, loadModelFile } from '../src/node';

let folder: string;
beforeAll(async () => {
  folder = await mkdtemp(join(tmpdir(), 'glanz-formats-'));
  await mkdir(join(folder, 'model'));
  await writeFile(
    join(folder, 'outside.png'),
    await sharp(Buffer.from([1, 2, 3]), { raw: { width: 1, height: 1, channels: 3 } })
      .png()
      .toBuffer(),
  );
  await writeFile(
    join(folder, 'model/in side.png'),
    await sharp(Buffer.from([9, 8, 7]), { raw: { width: 1, height: 1, channels: 3 } })
      .png()
      .toBuffer(),
  );
  await symlink(join(folder, 'outside.png'), join(folder, 'model/link.png'));
  await writeFile(
    join(folder, 'model/a.mtl'),
    'newmtl a\nmap_Kd in side.png\nnewmtl b\nmap_Kd ../outside.png\nnewmtl c\nmap_Kd link.png\n',
  );
  await writeFile(
    join(folder, 'model/a.obj'),
    'mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\nusemtl c\nf 1/1 2/1 3/1\n',
  );
  await writeFile(
    join(folder, 'model/b.stl'),
    'solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid\n',
  );
});
afterAll(() => rm(folder, { recursive: true, force: true }));

it('an OBJ with what lies beside it, and nothing else, neither by its path nor by a link', async () => {
  const scene = await loadModelFile(join(folder, 'model/a.obj'));
  expect(scene.images.map(({ name, data }) => [name, ...data])).toEqual([['in side.png', 9, 8, 7, 255]]);
  expect(scene.materials.map(({ textures }) => textures?.base_color !== undefined)).toEqual([true, false, false]);
  expect(scene.warnings.map(({ code }) => code)).toEqual(['formats/image', 'formats/image']);
});

it('an STL by its name', async () => {
  expect((await loadModelFile(join(folder, 'model/b.stl'))).meshes[0]!.name).toBe('b');
});

it('missing files, or files of another kind', async () => {
  await expect(loadModelFile(join(folder, 'model/none.obj'))).rejects.toMatchObject({
    code: 'formats/missing-resource',
  });
  await expect(loadModelFile(join(folder, 'model/a.fbx'))).rejects.toMatchObject({ code: 'formats/unknown' });
  expect([isModelFile('A.OBJ'), isModelFile('b.stl'), isModelFile('c.glb')]).toEqual([true, true, false]);
});
