import { existsSync } from 'node:fs';
import { sceneBounds, validateScene, type Scene } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { loadGltfFile } from '../src/node';
import { presence, sharedIndex, sharedPath } from './shared';

interface Asset {
  readonly name: string;
  readonly main: string;
  readonly kind: string;
  /** Counted by another program: triangles of all meshes, and of all their places. */
  readonly tris: number;
  readonly instTris: number;
  readonly ext: readonly string[];
}

const { present, note } = presence('assets/index.json');
const assets = sharedIndex<Asset>('assets/index.json').filter(
  ({ kind, main }) => kind === 'gltf' && existsSync(sharedPath(`assets/${main}`)),
);
const load = (name: string) => loadGltfFile(sharedPath(`assets/${assets.find((asset) => asset.name === name)!.main}`));

const count = (scene: Scene) =>
  scene.instances.reduce((sum, { mesh }) => sum + scene.meshes[mesh]!.indices.length / 3, 0);
const allFinite = (values: ArrayLike<number> | undefined) =>
  !values || Array.prototype.every.call(values, Number.isFinite);

/** The index counts all scenes of this file; the loader shows the default one. */
const OTHER_COUNT: Readonly<Record<string, number>> = { MultipleScenes: 2 };

/** Warnings about a sound file: what it holds beyond triangles and the materials that are mapped. */
const EXPECTED_WARNINGS = new Set(['gltf/ignored-extension', 'gltf/primitive']);

/** Material extensions that a model's warnings name. */
const ignored = new Set<string>();

describe.skipIf(!present)(`real models${note}`, () => {
  test.each(assets.map((asset) => [asset.name, asset] as const))('%s', async (name, asset) => {
    const scene = await loadGltfFile(sharedPath(`assets/${asset.main}`));
    expect(count(scene)).toBe(OTHER_COUNT[name] ?? asset.instTris);
    expect(scene.warnings.filter(({ code }) => !EXPECTED_WARNINGS.has(code))).toEqual([]);
    for (const { message } of scene.warnings)
      for (const [extension] of message.matchAll(/KHR_materials_\w+/g)) ignored.add(extension);
    for (const { code, message } of scene.warnings)
      if (code === 'gltf/primitive')
        expect(message).toMatch(
          name === 'blenderio-01_vertex_count_32bit'
            ? /normals point to the back of all of its triangles/
            : /points and lines are left out/,
        );
    validateScene(scene);
    for (const mesh of scene.meshes)
      expect([mesh.positions, mesh.normals, mesh.tangents, mesh.colors, ...(mesh.uvs ?? [])].every(allFinite)).toBe(
        true,
      );
    // One expectation for all: one for each takes longer than the model.
    let worst = 0;
    for (const { normals = [] } of scene.meshes)
      for (let i = 0; i < normals.length; i += 3)
        worst = Math.max(worst, Math.abs(Math.hypot(normals[i]!, normals[i + 1]!, normals[i + 2]!) - 1));
    expect(worst).toBeLessThan(1e-5);
  });

  // Of all models, which the tests above have loaded.
  test('no material extension is left out', () => {
    expect(assets.some(({ ext }) => ext.some((name) => name.startsWith('KHR_materials_')))).toBe(true);
    // Variants are alternatives among materials, not a material.
    ignored.delete('KHR_materials_variants');
    expect([...ignored]).toEqual([]);
  });

  test('a mesh in many places is held once', async () => {
    const scene = await load('InstanceTest');
    expect(scene.instances.length / scene.meshes.length).toBeGreaterThan(1000);
  });

  test('CesiumMan stands upright, at the size of a man, with his feet on the ground', async () => {
    const { min, max } = sceneBounds(await load('CesiumMan'));
    expect(max[1] - min[1]).toBeGreaterThan(1.4);
    expect(max[1] - min[1]).toBeLessThan(1.6);
    expect(Math.abs(min[1])).toBeLessThan(0.02);
    // Wider than deep in his pose, and centred.
    expect(Math.abs(min[0] + max[0])).toBeLessThan(0.2);
  });

  test('Draco, quantised and embedded ducks are the plain duck', async () => {
    const plain = sceneBounds(await load('Duck'));
    const size = Math.max(...[0, 1, 2].map((k) => plain.max[k]! - plain.min[k]!));
    for (const [name, tolerance] of [
      ['Duck-Embedded', 1e-6],
      ['Duck-Draco', 2e-3],
      ['Duck-Quantized', 2e-3],
    ] as const) {
      const { min, max } = sceneBounds(await load(name));
      for (const k of [0, 1, 2] as const) {
        expect(Math.abs(min[k] - plain.min[k])).toBeLessThanOrEqual(tolerance * size);
        expect(Math.abs(max[k] - plain.max[k])).toBeLessThanOrEqual(tolerance * size);
      }
    }
  });

  test('an image that serves two textures is decoded once', async () => {
    const { images, textures } = await load('FlightHelmet');
    expect(images.length).toBe(15);
    expect(textures.length).toBe(15);
    expect(new Set(textures.map(({ color_space }) => color_space))).toEqual(new Set(['srgb', 'linear']));
  });
});
