import { WebIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS, type EmissiveStrength } from '@gltf-transform/extensions';
import { describe, expect, it } from 'vitest';
import { createPushButton } from '../src/index';
import { sceneToGltf } from '../src/to-gltf';

describe('sceneToGltf', () => {
  it('survives a .glb: parts, triangles, materials, camera', async () => {
    const scene = createPushButton({ level: 'low' });
    const io = new WebIO().registerExtensions(ALL_EXTENSIONS);
    const root = (await io.readBinary(await io.writeBinary(sceneToGltf(scene)))).getRoot();
    const parts = root.listNodes().filter((node) => node.getMesh());
    expect(parts.map((node) => node.getName())).toEqual(scene.instances.map((instance) => instance.name));
    let triangles = 0;
    for (const mesh of root.listMeshes())
      for (const primitive of mesh.listPrimitives()) triangles += primitive.getIndices()!.getCount() / 3;
    expect(triangles).toBe(scene.meshes.reduce((sum, mesh) => sum + mesh.indices.length / 3, 0));

    const ring = root.listMaterials().find((material) => material.getName() === 'halo light')!;
    const source = scene.materials.find((material) => material.name === 'halo light')!.parameters;
    expect(ring.getExtension<EmissiveStrength>('KHR_materials_emissive_strength')!.getEmissiveStrength()).toBeCloseTo(
      source.emission_luminance!,
      5,
    );
    const brass = root.listMaterials().find((material) => material.getName() === 'brass')!;
    expect(brass.getMetallicFactor()).toBe(1);
    expect(root.listCameras()[0]!.getYFov()).toBeCloseTo((scene.cameras[0] as { yfov: number }).yfov, 6);
  });
});
