import { existsSync } from 'node:fs';
import type { Mesh } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { loadGltfFile } from '../src/node';
import { withTangents } from '../src/tangents';
import { presence, sharedIndex, sharedPath } from './shared';

/** A wavy sheet of n × n quads whose image is mirrored along the middle, as symmetrical models are. */
function sheet(n: number): Mesh {
  const positions: number[] = [],
    normals: number[] = [],
    uv: number[] = [],
    indices: number[] = [];
  const height = (x: number, y: number) => 0.1 * Math.sin(5 * x) * Math.cos(4 * y);
  for (let j = 0; j <= n; j++) {
    for (let i = 0; i <= n; i++) {
      const x = i / n,
        y = j / n;
      const dx = 0.5 * Math.cos(5 * x) * Math.cos(4 * y),
        dy = -0.4 * Math.sin(5 * x) * Math.sin(4 * y);
      const length = Math.hypot(dx, dy, 1);
      positions.push(x, y, height(x, y));
      normals.push(-dx / length, -dy / length, 1 / length);
      uv.push(Math.abs(x - 0.5), 0.3 * x + y);
      if (i < n && j < n) {
        const a = j * (n + 1) + i;
        indices.push(a, a + 1, a + n + 2, a, a + n + 2, a + n + 1);
      }
    }
  }
  return {
    name: 'sheet',
    positions: new Float32Array(positions),
    normals: new Float32Array(normals),
    uvs: [new Float32Array(uv)],
    indices: new Uint32Array(indices),
  };
}

/** Tangents of a mesh, corner by corner, as meshoptimizer makes them: another implementation of MikkTSpace. */
async function reference(mesh: Mesh): Promise<Float32Array> {
  const { MeshoptTangents } = await import('meshoptimizer/tangents');
  await MeshoptTangents.ready;
  return MeshoptTangents.generateTangents(mesh.indices, mesh.positions, 3, mesh.normals!, 3, mesh.uvs![0]!, 2, [
    'Compatible',
  ]);
}

/** Largest angle between tangents at corners (degrees), and how many handednesses differ. */
async function difference(mesh: Mesh) {
  const made = withTangents(mesh);
  const expected = await reference(mesh);
  expect(made.indices.length).toBe(mesh.indices.length);
  let worst = 0,
    turned = 0;
  for (let c = 0; c < made.indices.length; c++) {
    const v = made.indices[c]!;
    let dot = 0;
    for (let k = 0; k < 3; k++) dot += made.tangents![4 * v + k]! * expected[4 * c + k]!;
    worst = Math.max(worst, (Math.acos(Math.min(Math.max(dot, -1), 1)) * 180) / Math.PI);
    // MikkTSpace has v run up, glTF down.
    if (made.tangents![4 * v + 3] !== -expected[4 * c + 3]!) turned++;
    for (let k = 0; k < 3; k++) expect(made.positions[3 * v + k]).toBe(mesh.positions[3 * mesh.indices[c]! + k]);
  }
  return { worst, turned, vertices: made.positions.length / 3 };
}

describe('tangents are those of another implementation of MikkTSpace, corner by corner', () => {
  test('a sheet with a mirrored image: vertices in the middle are doubled', async () => {
    const mesh = sheet(8);
    const { worst, turned, vertices } = await difference(mesh);
    expect(worst).toBeLessThan(0.1);
    expect(turned).toBe(0);
    expect(vertices).toBe(81 + 9);
  });

  test('vertices of their own for every triangle are welded', async () => {
    const mesh = sheet(6);
    const spread = (values: Float32Array, stride: number) =>
      Float32Array.from(
        Array.from(mesh.indices).flatMap((v) => Array.from(values.subarray(stride * v, stride * v + stride))),
      );
    const soup: Mesh = {
      name: 'soup',
      positions: spread(mesh.positions, 3),
      normals: spread(mesh.normals!, 3),
      uvs: [spread(mesh.uvs![0]!, 2)],
      indices: mesh.indices.map((_, i) => i),
    };
    const { worst, turned } = await difference(soup);
    expect(worst).toBeLessThan(0.1);
    expect(turned).toBe(0);
  });
});

test('triangles without area, in space or in the image, get unit tangents at right angles to the normal', () => {
  const mesh = sheet(3);
  mesh.indices = new Uint32Array([...mesh.indices, 0, 0, 1, 2, 2, 2]);
  mesh.uvs![0]!.fill(0.5, 0, 12);
  const { tangents, normals } = withTangents(mesh);
  for (let v = 0; v < tangents!.length / 4; v++) {
    const t = tangents!.subarray(4 * v, 4 * v + 3),
      n = normals!.subarray(3 * v, 3 * v + 3);
    expect(Math.hypot(...t)).toBeCloseTo(1, 5);
    expect(t[0]! * n[0]! + t[1]! * n[1]! + t[2]! * n[2]!).toBeCloseTo(0, 5);
    expect(Math.abs(tangents![4 * v + 3]!)).toBe(1);
  }
});

test('a mesh without normals or images stays as it is', () => {
  const { normals: _, ...flat } = sheet(2);
  expect(withTangents(flat)).toBe(flat);
  const { uvs: __, ...plain } = sheet(2);
  expect(withTangents(plain)).toBe(plain);
});

const { present, note } = presence('assets/index.json');
const assets = sharedIndex<{ name: string; main: string }>('assets/index.json');

describe.skipIf(!present)(`real models${note}`, () => {
  test.each(['DamagedHelmet', 'NormalTangentTest', 'FlightHelmet'])('%s', async (name) => {
    const main = assets.find((asset) => asset.name === name)?.main;
    if (!main || !existsSync(sharedPath(`assets/${main}`))) throw new Error(`${name} is missing`);
    const { meshes } = await loadGltfFile(sharedPath(`assets/${main}`));
    let compared = 0;
    for (const mesh of meshes) {
      if (!mesh.normals || !mesh.uvs) continue;
      const { tangents: _, ...bare } = mesh;
      // Where the sums nearly cancel out the order of adding decides: corners by the dozen in a hundred thousand.
      const made = withTangents(bare),
        expected = await reference(bare);
      let off = 0;
      for (let c = 0; c < bare.indices.length; c++) {
        const v = made.indices[c]!;
        const dot = [0, 1, 2].reduce((sum, k) => sum + made.tangents![4 * v + k]! * expected[4 * c + k]!, 0);
        if (dot < Math.cos(Math.PI / 180) || made.tangents![4 * v + 3] !== -expected[4 * c + 3]!) off++;
      }
      expect(off / bare.indices.length).toBeLessThan(2e-3);
      compared += bare.indices.length;
    }
    expect(compared).toBeGreaterThan(1000);
  });
});
