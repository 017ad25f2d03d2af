import { loadGltf } from '@glanz/gltf/node';
import { defaultParameters } from '@glanz/openpbr';
import type { Scene } from '@glanz/scene';
import { validateScene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { GALLERY_MODELS } from '../src/gallery-models';
import { sceneToGlb } from '../src/to-gltf';
import { inspect } from './solids';

const defaults = defaultParameters();
const isDielectric = ({ parameters: p }: Scene['materials'][number]) =>
  ((p.transmission_weight ?? 0) > 0 && !p.geometry_thin_walled) || (p.subsurface_weight ?? 0) > 0;

describe.each(Object.keys(GALLERY_MODELS))('gallery model %s', (name) => {
  const scene = GALLERY_MODELS[name]!();

  it('is valid, and keeps within a budget of triangles', () => {
    validateScene(scene);
    const triangles = scene.instances.reduce((sum, { mesh }) => sum + scene.meshes[mesh]!.indices.length / 3, 0);
    expect(triangles).toBeGreaterThan(5_000);
    expect(triangles).toBeLessThan(2_000_000);
  });

  it('has interiors that are closed and face outwards', () => {
    for (const { mesh: index, material, name: part } of scene.instances) {
      if (!isDielectric(scene.materials[material]!)) continue;
      const { openEdges, volume } = inspect(scene.meshes[index]!);
      expect({ part, openEdges }).toEqual({ part, openEdges: 0 });
      expect(volume, part).toBeGreaterThan(0);
    }
  });

  it('has normals on the side of the triangles', () => {
    for (const mesh of scene.meshes) expect(inspect(mesh).worstNormal, mesh.name).toBeGreaterThan(-0.3);
  });

  it('is read by the loader of glTF without warnings, with its parts, cameras, variants and materials', async () => {
    const read = await loadGltf(await sceneToGlb(scene));
    expect(read.warnings).toEqual([]);
    expect(read.instances.map((instance) => instance.name)).toEqual(scene.instances.map((instance) => instance.name));
    expect(read.cameras.map((camera) => camera.name)).toEqual(scene.cameras.map((camera) => camera.name));
    expect(read.variants ?? []).toEqual(scene.variants ?? []);
    const byName = (from: Scene) => new Map(from.materials.map((material) => [material.name, material.parameters]));
    const made = byName(scene);
    for (const [material, parameters] of byName(read))
      for (const [parameter, value] of Object.entries(made.get(material)!)) {
        const key = parameter as keyof typeof defaults;
        const got = parameters[key] ?? defaults[key];
        const where = `${material}: ${parameter}`;
        if (typeof value === 'number') expect(got, where).toBeCloseTo(value, 4);
        else if (Array.isArray(value))
          for (const [k, x] of value.entries())
            expect((got as unknown as number[])[k], where).toBeCloseTo(x as number, 4);
      }
  });
});
