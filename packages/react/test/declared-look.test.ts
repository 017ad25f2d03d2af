import { expect, it } from 'vitest';
import { LookKeeper, type MaterialEdit } from '../src/declared-look';

it('edits in the order of its calls, although defaults are fetched for one of them', async () => {
  const own: MaterialEdit = { base_metalness: 0.25 };
  let parameters: MaterialEdit = own;
  const edits: MaterialEdit[] = [];
  const viewer = {
    scene: { materials: [{ name: 'seat', parameters: own }], instances: [] },
    setMaterial: async (_: string, edit: MaterialEdit) => {
      edits.push(edit);
      parameters = { ...parameters, ...edit };
    },
  };
  const errors: unknown[] = [];
  const keeper = new LookKeeper(viewer as never, (error) => void errors.push(error));
  keeper.apply({ materials: { seat: { coat_weight: 1 } } });
  // The file has no coat_weight: its default is fetched.
  keeper.apply({ materials: { seat: { base_metalness: 1 } } });
  keeper.apply({});
  await expect.poll(() => edits).toHaveLength(3);
  expect(parameters).toEqual({ base_metalness: 0.25, coat_weight: 0 });
  expect(errors).toEqual([]);
});
