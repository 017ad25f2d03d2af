import { expect, test } from 'vitest';
import type { Material } from '@glanz/scene';
import { chosenParts, toggled, withParts } from '../src/selection';
import { initialState, type Slot } from '../src/state/state';
import { Store } from '../src/state/store';
import { editMaterials, editSlots, replaceMaterials, resetMaterials } from '../src/ui/material/edits';
import { chosenMaterials } from '../src/viewer/assigned-material';

const materialOf = (part: number) => 10 + part;

test('parts are added and taken away; the last one is the one whose values are shown', () => {
  let chosen = withParts({ material: 0 }, [3], materialOf);
  expect(chosen).toEqual({ material: 13, instance: 3, others: [] });
  chosen = toggled(chosen, 5, materialOf);
  expect([chosen.material, chosenParts(chosen)]).toEqual([15, [5, 3]]);
  chosen = withParts(chosen, [1, 2, 3], materialOf);
  expect([chosen.material, chosenParts(chosen)]).toEqual([13, [3, 5, 1, 2]]);
  chosen = toggled(chosen, 3, materialOf);
  expect([chosen.material, chosenParts(chosen)]).toEqual([15, [5, 1, 2]]);
  for (const part of [5, 1, 2]) chosen = toggled(chosen, part, materialOf);
  expect(chosenParts(chosen)).toEqual([]);
});

test('the materials of all parts, each once, in the variant that is shown', () => {
  const part = (material: number, variants?: Record<number, number>) => ({
    name: '',
    mesh: 0,
    material,
    transform: [],
    ...(variants ? { variants } : {}),
  });
  const scene = { variants: ['night'], instances: [part(0), part(1, { 0: 2 }), part(0)] };
  const chosen = { material: 0, instance: 0, others: [1, 2] };
  expect(chosenMaterials(scene, chosen, null)).toEqual([0, 1]);
  expect(chosenMaterials(scene, chosen, 'night')).toEqual([0, 2]);
  expect(chosenMaterials(scene, { material: 7 }, null)).toEqual([7]);
});

test('edits of several materials are one step of undo', () => {
  const materials: Material[] = [
    { name: 'a', parameters: { base_weight: 0.5 } },
    { name: 'b', parameters: {} },
    { name: 'c', parameters: {} },
  ];
  const store = new Store(initialState('none'));
  editMaterials(store, materials, [0, 1], { base_weight: 0.5 }, 'Weight');
  // What a material has anyway is no edit.
  expect(store.state.materials).toEqual({ 1: { base_weight: 0.5 } });
  replaceMaterials(store, materials, [1, 2], { base_metalness: 1 }, 'Metal');
  expect(store.state.materials).toEqual({ 1: { base_metalness: 1 }, 2: { base_metalness: 1 } });
  resetMaterials(store, [1, 2]);
  expect(store.state.materials).toEqual({});
  expect([store.undo(), store.undo(), store.undo(), store.undo()]).toEqual([
    'Reset materials',
    'Metal',
    'Weight',
    undefined,
  ]);
  expect(store.state.materials).toEqual({});
});

test('an image goes on all chosen materials, and away from all, as one step of undo', () => {
  const binding = { texture: 0, channels: 'rgb' } as const;
  const materials: Material[] = [
    { name: 'a', parameters: {}, textures: { base_color: binding } },
    { name: 'b', parameters: {} },
    { name: 'c', parameters: {} },
  ];
  const store = new Store(initialState('none'));
  const slot: Slot = {
    image: { name: 'wood', width: 1, height: 1, data: new Uint8ClampedArray(4) },
    color_space: 'srgb',
    binding: { channels: 'rgb' },
  };
  editSlots(store, materials, [0, 1], 'base_color', slot);
  expect(store.state.slots).toEqual({ '0/base_color': slot, '1/base_color': slot });
  editSlots(store, materials, [0, 1, 2], 'base_color', null);
  // The one that the model brought is taken away; the others were never there.
  expect(store.state.slots).toEqual({ '0/base_color': null });
  expect([store.undo(), store.undo(), store.undo()]).toEqual(['Remove texture', 'Texture', undefined]);
  expect(store.state.slots).toEqual({});
});
