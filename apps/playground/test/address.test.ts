import { expect, test, vi } from 'vitest';
import { stateFromQuery } from '../src/state/address';

test('images are denoised unless the address says otherwise', () => {
  expect(stateFromQuery('').state.denoise).toBe(true);
  expect(stateFromQuery('?denoise=off').state.denoise).toBe(false);
});

test('the tone map has the name of the command line option; the former name works and warns', () => {
  const warn = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
  expect(stateFromQuery('?tone-map=agx&exposure=1').state).toMatchObject({ toneMap: 'agx', exposure: 1 });
  expect(warn).not.toHaveBeenCalled();
  expect(stateFromQuery('?tonemap=aces').state.toneMap).toBe('aces');
  expect(warn.mock.calls).toEqual([[expect.stringContaining('"?tone-map="')]]);
  expect(stateFromQuery('?tonemap=aces&tone-map=agx').state.toneMap).toBe('agx');
  warn.mockRestore();
});

test('samples without a ground stand on a floor, unless the address says otherwise; files stand on what they bring', () => {
  const floor = (query: string) => stateFromQuery(query).state.floor;
  expect([floor(''), floor('?model=push-button-low'), floor('?floor=off')]).toEqual([true, true, false]);
  expect([floor('?model=cornell-box'), floor('?model=ring'), floor('?model=ring&floor=on')]).toEqual([
    false,
    false,
    true,
  ]);
  expect([floor('?model=models/box.glb'), floor('?model=models/box.glb&floor=on')]).toEqual([false, true]);
});
