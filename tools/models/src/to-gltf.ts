import { Document, WebIO, type Material as GltfMaterial } from '@gltf-transform/core';
import { ALL_EXTENSIONS, KHRMaterialsVariants } from '@gltf-transform/extensions';
import type { Scene } from '@glanz/scene';
import { addMaterial } from './to-gltf-material';

/** Binds the materials of variants to a primitive. */
function addVariants(
  document: Document,
  scene: Scene,
  materials: readonly GltfMaterial[],
): (
  variants: Readonly<Record<number, number>> | undefined,
) => ReturnType<KHRMaterialsVariants['createMappingList']> | undefined {
  if (!scene.variants?.length) return () => undefined;
  const extension = document.createExtension(KHRMaterialsVariants);
  const variants = scene.variants.map((name) => extension.createVariant(name));
  return (indices) => {
    if (!indices) return undefined;
    const list = extension.createMappingList();
    for (const [variant, material] of Object.entries(indices))
      list.addMapping(
        extension.createMapping().setMaterial(materials[material]!).addVariant(variants[Number(variant)]!),
      );
    return list;
  };
}

/**
 * Turns a scene of the kind this package makes into a glTF document: meshes with one material each, shared by their
 * instances where the material is the same; cameras, variants, and the parameters of materials that glTF and its KHR
 * extensions can say. Textures, lights other than emitting meshes, lenses of cameras and the environment are not
 * written.
 */
export function sceneToGltf(scene: Scene): Document {
  const document = new Document();
  const buffer = document.createBuffer();
  const root = document.createScene(scene.name);
  document.getRoot().setDefaultScene(root);
  const materials = scene.materials.map((material) => addMaterial(document, material));
  const mappings = addVariants(document, scene, materials);
  const accessor = (
    type: 'VEC4' | 'VEC3' | 'SCALAR',
    array: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer> | Uint16Array<ArrayBuffer>,
  ) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const attributes = scene.meshes.map((mesh) => ({
    position: accessor('VEC3', mesh.positions),
    normal: mesh.normals ? accessor('VEC3', mesh.normals) : undefined,
    tangent: mesh.tangents ? accessor('VEC4', mesh.tangents) : undefined,
    indices: accessor('SCALAR', mesh.positions.length / 3 < 65535 ? Uint16Array.from(mesh.indices) : mesh.indices),
  }));
  const made = new Map<string, ReturnType<Document['createMesh']>>();
  for (const instance of scene.instances) {
    const key = JSON.stringify([instance.mesh, instance.material, instance.variants]);
    let mesh = made.get(key);
    if (!mesh) {
      const { position, normal, tangent, indices } = attributes[instance.mesh]!;
      const primitive = document
        .createPrimitive()
        .setAttribute('POSITION', position)
        .setIndices(indices)
        .setMaterial(materials[instance.material]!);
      if (normal) primitive.setAttribute('NORMAL', normal);
      if (tangent) primitive.setAttribute('TANGENT', tangent);
      const list = mappings(instance.variants);
      if (list) primitive.setExtension('KHR_materials_variants', list);
      mesh = document.createMesh(scene.meshes[instance.mesh]!.name).addPrimitive(primitive);
      made.set(key, mesh);
    }
    const node = document.createNode(instance.name).setMesh(mesh);
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
