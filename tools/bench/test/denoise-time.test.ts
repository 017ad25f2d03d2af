import { expect, it } from 'vitest';
import { TIME_SCENES, checkTimeScenes } from '../src/denoise/time-scenes';

it('scenes of denoise-time are checked by name, all before the first is loaded', () => {
  expect(() => checkTimeScenes(TIME_SCENES)).not.toThrow();
  expect(() => checkTimeScenes(['room', 'push-button, sun'])).not.toThrow();
  for (const name of ['typo', '', 'toString'])
    expect(() => checkTimeScenes(['room', name])).toThrow(
      expect.objectContaining({ code: 'bench/option', message: expect.stringContaining(`there is no "${name}"`) }),
    );
});
