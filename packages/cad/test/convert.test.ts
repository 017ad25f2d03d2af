import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { WebIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { loadGltfFile } from '@glanz/gltf/node';
import { OPENPBR_PRESETS } from '@glanz/openpbr/presets';
import { sceneBounds, validateScene } from '@glanz/scene';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { convertCadFile } from '../src/node';
import { ASSEMBLY, stepFile } from './step';

let folder: string;
beforeAll(async () => {
  folder = await mkdtemp(join(tmpdir(), 'glanz-cad-'));
});
afterAll(() => rm(folder, { recursive: true, force: true }));

it('an assembly in three levels, with mapped materials and nothing of its origin', async () => {
  const map = join(folder, 'map.json');
  await writeFile(
    map,
    JSON.stringify({
      rules: [
        { part: '*bolt*', preset: 'brass' },
        { color: '#00ff00', preset: 'carpaint' },
      ],
      fallback: { keepColor: true },
    }),
  );
  const files = await convertCadFile(stepFile(ASSEMBLY), join(folder, 'out.glb'), {
    levels: 3,
    materials: map,
    strip: true,
    tolerance: { metres: 0.0001 },
  });
  expect(files.map(({ path }) => path)).toEqual(
    ['out.glb', 'out.lod1.glb', 'out.lod2.glb'].map((name) => join(folder, name)),
  );
  const [fine, middle, coarse] = files.map(({ triangles }) => triangles) as [number, number, number];
  // Flat faces and holes keep some: the ladder is as steep as the shape allows.
  expect(middle).toBeLessThan(0.5 * fine);
  expect(coarse).toBeLessThan(0.6 * middle);
  const [first, , last] = await Promise.all(files.map(({ path }) => loadGltfFile(path)));
  for (const scene of [first!, last!]) {
    expect(scene.warnings).toEqual([]);
    expect(validateScene(scene).filter(({ code }) => code !== 'scene/degenerate')).toEqual([]);
    expect(scene.instances.length).toBe(18);
    expect(scene.materials.length).toBe(5);
  }
  const brass = first!.materials.find(({ parameters }) => parameters.base_metalness === 1)!;
  OPENPBR_PRESETS.brass.base_color!.forEach((c, k) => expect(brass.parameters.base_color![k]).toBeCloseTo(c, 6));
  expect(
    first!.materials.some(({ parameters }) => parameters.coat_weight === 1 && parameters.coat_roughness === 0.02),
  ).toBe(true);
  // The coarsest has the place and the size of the finest.
  const [a, b] = [sceneBounds(first!), sceneBounds(last!)];
  for (const k of [0, 1, 2] as const) {
    expect(Math.abs(a.min[k] - b.min[k])).toBeLessThan(0.003);
    expect(Math.abs(a.max[k] - b.max[k])).toBeLessThan(0.003);
  }
  // It stands, +Z of the file points up: brackets of 60 mm on a plate of 20 mm, which is 150 mm wide along the file's Y.
  expect(a.max[1]).toBeCloseTo(0.08, 4);
  expect(a.max[2] - a.min[2]).toBeCloseTo(0.15, 4);
  // Normals are on the triangles' own side, however coarse they are.
  for (const { positions: P, normals: N, indices } of [...first!.meshes, ...last!.meshes]) {
    for (let t = 0; t < indices.length; t += 3) {
      const [p, q, r] = [0, 1, 2].map((k) => P.subarray(3 * indices[t + k]!, 3 * indices[t + k]! + 3)) as [
        Float32Array,
        Float32Array,
        Float32Array,
      ];
      const [u, v] = [q.map((x, k) => x - p[k]!), r.map((x, k) => x - p[k]!)];
      const cross = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!];
      const length = Math.hypot(...cross);
      if (length < 1e-12) continue;
      for (let k = 0; k < 3; k++)
        expect(cross.reduce((sum, x, i) => sum + (x / length) * N![3 * indices[t + k]! + i]!, 0)).toBeGreaterThan(
          0.499,
        );
    }
  }
  const text = (await readFile(files[0]!.path)).toString('latin1');
  expect(text).not.toMatch(/bolt|nut|bracket|plate|as1|oc-214|brass|carpaint|Open ?CASCADE/i);
});

it('another reader finds the same, names included where they are kept', async () => {
  const [file] = await convertCadFile(stepFile(ASSEMBLY), join(folder, 'named.glb'));
  const document = await new WebIO()
    .registerExtensions(ALL_EXTENSIONS)
    .readBinary(new Uint8Array(await readFile(file!.path)));
  const root = document.getRoot();
  expect(root.listNodes().map((node) => node.getName())).toContain('as1/rod-assembly/nut');
  expect(
    root
      .listMeshes()
      .reduce(
        (sum, mesh) =>
          sum + mesh.listPrimitives().reduce((n, primitive) => n + primitive.getIndices()!.getCount() / 3, 0),
        0,
      ),
  ).toBe(file!.triangles);
});

it('errors are typed', async () => {
  const convert = (input: string, output = join(folder, 'x.glb'), options = {}) =>
    convertCadFile(input, output, options);
  await expect(convert(join(folder, 'none.step'))).rejects.toMatchObject({ code: 'cad/missing-resource' });
  await expect(convert(stepFile(ASSEMBLY), join(folder, 'x.obj'))).rejects.toMatchObject({ code: 'cad/option' });
  await writeFile(join(folder, 'bad.json'), '{');
  await expect(convert(stepFile(ASSEMBLY), undefined, { materials: join(folder, 'bad.json') })).rejects.toMatchObject({
    code: 'cad/materials',
  });
  await expect(convert(stepFile(ASSEMBLY), undefined, { levels: 0 })).rejects.toMatchObject({ code: 'cad/option' });
});
