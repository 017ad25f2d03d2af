import { Document, WebIO, type Material as GltfMaterial } from '@gltf-transform/core';
import { ALL_EXTENSIONS, KHRMaterialsEmissiveStrength, KHRMaterialsSpecular } from '@gltf-transform/extensions';
import type { Material, Scene } from '@glanz/scene';

type Colour = [number, number, number];

function addMaterial(document: Document, material: Material): GltfMaterial {
  const p = material.parameters;
  const [r, g, b] = p.base_color ?? [0.8, 0.8, 0.8];
  const result = document
    .createMaterial(material.name)
    .setBaseColorFactor([r, g, b, 1])
    .setMetallicFactor(p.base_metalness ?? 0)
    .setRoughnessFactor(p.specular_roughness ?? 0.3);
  if (p.specular_weight !== undefined && p.specular_weight !== 1) {
    result.setExtension(
      'KHR_materials_specular',
      document.createExtension(KHRMaterialsSpecular).createSpecular().setSpecularFactor(p.specular_weight),
    );
  }
  const luminance = p.emission_luminance ?? 0;
  if (luminance > 0) {
    result.setEmissiveFactor([...(p.emission_color ?? [1, 1, 1])] as Colour);
    if (luminance !== 1)
      result.setExtension(
        'KHR_materials_emissive_strength',
        document.createExtension(KHRMaterialsEmissiveStrength).createEmissiveStrength().setEmissiveStrength(luminance),
      );
  }
  return result;
}

/**
 * Turns a scene of the kind this package makes into a glTF document: meshes with one material each, cameras, base
 * colour, metalness, roughness, specular weight and emission. Textures, lights and the environment are not written.
 */
export function sceneToGltf(scene: Scene): Document {
  const document = new Document();
  const buffer = document.createBuffer();
  const root = document.createScene(scene.name);
  document.getRoot().setDefaultScene(root);
  const materials = scene.materials.map((material) => addMaterial(document, material));
  for (const instance of scene.instances) {
    const mesh = scene.meshes[instance.mesh]!;
    const accessor = (type: 'VEC3' | 'SCALAR', array: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>) =>
      document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
    const primitive = document
      .createPrimitive()
      .setAttribute('POSITION', accessor('VEC3', mesh.positions))
      .setIndices(accessor('SCALAR', mesh.indices))
      .setMaterial(materials[instance.material]!);
    if (mesh.normals) primitive.setAttribute('NORMAL', accessor('VEC3', mesh.normals));
    const node = document.createNode(instance.name).setMesh(document.createMesh(mesh.name).addPrimitive(primitive));
    node.setMatrix(Array.from(instance.transform) as Parameters<typeof node.setMatrix>[0]);
    root.addChild(node);
  }
  for (const camera of scene.cameras) {
    if (camera.type !== 'perspective') continue;
    const lens = document
      .createCamera(camera.name)
      .setType('perspective')
      .setYFov(camera.yfov)
      .setZNear(0.001)
      .setZFar(100);
    if (camera.aspect !== undefined) lens.setAspectRatio(camera.aspect);
    const node = document.createNode(camera.name).setCamera(lens);
    node.setMatrix(Array.from(camera.transform) as Parameters<typeof node.setMatrix>[0]);
    root.addChild(node);
  }
  return document;
}

/** {@link sceneToGltf}, as the bytes of a .glb file. */
export function sceneToGlb(scene: Scene): Promise<Uint8Array<ArrayBuffer>> {
  return new WebIO().registerExtensions(ALL_EXTENSIONS).writeBinary(sceneToGltf(scene));
}
