import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { expect, test } from 'vitest';
import { loadGltf } from '@glanz/gltf';
import { createCornellBox } from '@glanz/models';
import { patchMaterials } from '../src/output/gltf-materials';
import { modelAsGltf } from '../src/output/model-as-gltf';
import { initialState } from '../src/state/state';
import { triangle } from '@glanz/browser/files';

const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);

test('the user’s file comes out with other values in one material, and nothing else changed', async () => {
  const extras = { order: 7 };
  const bytes = triangle([0.2, 0.3, 0.4], (json) => {
    (json['materials'] as object[]).push({ name: 'other', pbrMetallicRoughness: { roughnessFactor: 0.77 } });
    Object.assign((json['materials'] as Record<string, unknown>[])[0]!, { extras, doubleSided: true });
  });
  const scene = await loadGltf(new Uint8Array(bytes));
  const request = {
    kind: 'files',
    files: new Map([['sail.glb', new Blob([new Uint8Array(bytes)])]]),
    entry: 'sail.glb',
  } as const;
  const state = {
    ...initialState('studio'),
    materials: { 0: { base_color: [0.9, 0.1, 0.05], specular_roughness: 0.4, coat_weight: 0.5 } } as const,
  };
  const { bytes: written, extension } = await modelAsGltf({ scene, request, title: 'sail', name: 'sail.glb' }, state);
  expect(extension).toBe('glb');
  const document = await io.readBinary(written);
  const [cloth, other] = document.getRoot().listMaterials();
  cloth!.getBaseColorFactor().forEach((value, k) => expect(value).toBeCloseTo([0.9, 0.1, 0.05, 1][k]!, 6));
  expect(cloth!.getRoughnessFactor()).toBeCloseTo(0.4, 6);
  expect(cloth!.getDoubleSided()).toBe(true);
  expect(cloth!.getExtras()).toEqual(extras);
  expect(
    document
      .getRoot()
      .listExtensionsUsed()
      .map(({ extensionName }) => extensionName),
  ).toContain('KHR_materials_clearcoat');
  expect(other!.getRoughnessFactor()).toBeCloseTo(0.77, 6);
  const before = (await io.readBinary(new Uint8Array(bytes))).getRoot().listAccessors()[0]!.getArray();
  expect(document.getRoot().listAccessors()[0]!.getArray()).toEqual(before);
  // And the renderer reads back what was edited.
  const again = await loadGltf(written);
  expect(again.materials[0]!.parameters.specular_roughness).toBeCloseTo(0.4, 6);
  expect(again.materials[0]!.parameters.coat_weight).toBeCloseTo(0.5, 6);
});

test('textures stay where they were, factors beside them change', () => {
  const json = {
    materials: [
      {
        pbrMetallicRoughness: { baseColorTexture: { index: 3, texCoord: 1 }, roughnessFactor: 1 },
        normalTexture: { index: 4, scale: 0.5 },
        extensions: {
          KHR_materials_clearcoat: { clearcoatFactor: 1, clearcoatTexture: { index: 5 } },
          KHR_materials_sheen: { sheenColorFactor: [1, 1, 1] },
        },
        alphaMode: 'MASK',
        alphaCutoff: 0.3,
      },
    ],
  };
  const patched = patchMaterials(json, new Map([[0, { name: 'm', parameters: { base_color: [0.5, 0.5, 0.5] } }]]));
  expect(patched['materials']).toEqual([
    {
      name: 'm',
      pbrMetallicRoughness: {
        baseColorTexture: { index: 3, texCoord: 1 },
        baseColorFactor: [0.5, 0.5, 0.5, 1],
        metallicFactor: 0,
        roughnessFactor: 0.3,
      },
      normalTexture: { index: 4, scale: 0.5 },
      extensions: { KHR_materials_clearcoat: { clearcoatTexture: { index: 5 } } },
      alphaMode: 'MASK',
      alphaCutoff: 0.3,
    },
  ]);
});

test('a model that was no glTF becomes one, with the parts that are seen', async () => {
  const scene = createCornellBox();
  const state = { ...initialState('none'), hidden: [1], materials: { 0: { specular_roughness: 0.11 } } };
  const { bytes, extension } = await modelAsGltf(
    { scene, request: { kind: 'sample', name: 'cornell-box' }, title: 'Cornell box', name: 'cornell-box' },
    state,
  );
  expect(extension).toBe('glb');
  const root = (await io.readBinary(bytes)).getRoot();
  expect(root.listNodes()).toHaveLength(scene.instances.length - 1);
  expect(root.listMaterials()[0]!.getRoughnessFactor()).toBeCloseTo(0.11, 6);
});
