import type { ScenePoser } from '@glanz/gltf/animation';
import { expect, test } from 'vitest';
import { AnimationPlayer } from '../src/animation-player';

/** A player whose poses and events are written down; `run` advances it in steps. */
function player(duration = 2) {
  const heard: string[] = [];
  const poses: (readonly [string | undefined, number])[] = [];
  const still = { transforms: [], visibility: [], meshes: [], lights: [] };
  const poser = {
    animations: [
      { name: 'walk', duration },
      { name: 'jump', duration: 1 },
    ],
    pose: (name: string | undefined, time: number) => {
      poses.push([name, time]);
      return still;
    },
  } as unknown as ScenePoser;
  const made = new AnimationPlayer(
    {
      place: () => undefined,
      reopen: () => Promise.reject(new Error('not for other tracers')),
      edit: async (change) => change(undefined as never),
      wake: () => heard.push('wake'),
      emit: (type, { name, ...rest }) => heard.push([type, name, ...Object.values(rest)].join(' ')),
      failed: (error) => void heard.push(String(error)),
    },
    poser,
  );
  const run = (...steps: number[]) =>
    steps.map((seconds) => {
      made.step(seconds);
      return Math.round(made.currentTime * 1e6) / 1e6;
    });
  return { made, heard, poses, run };
}

test('plays the first animation repeatedly, and says so', () => {
  const { made, heard, poses, run } = player();
  expect([made.paused, made.name, made.duration]).toEqual([true, undefined, 0]);
  made.play();
  expect([made.paused, made.name, made.duration]).toEqual([false, 'walk', 2]);
  expect(run(0.5, 1, 1, 0.75, 0.75)).toEqual([0.5, 1.5, 0.5, 1.25, 2]);
  expect(poses.at(-1)).toEqual(['walk', 2]);
  expect(heard).toEqual(['play walk', 'loop walk 1']);
  expect(run(0.25)).toEqual([0.25]);
  expect(heard).toEqual(['play walk', 'loop walk 1', 'loop walk 2']);
});

test.each([
  // Three rounds of two seconds: forwards, back, forwards.
  [{ repetitions: 3, pingpong: true }, 1, [0.75, 1.5, 1.75, 1, 0.25, 0.5, 1.25, 2, 2], 'loop 1,loop 2,finished'],
  [{ repetitions: 2, pingpong: true }, 1, [0.75, 1.5, 1.75, 1, 0.25, 0, 0], 'loop 1,finished'],
  [{ repetitions: 1 }, 1, [0.75, 1.5, 2, 2], 'finished'],
  [{ repetitions: 1 }, 2, [1.5, 2, 2], 'finished'],
  [{ repetitions: 2 }, -1, [1.25, 0.5, 1.75, 1, 0.25, 0, 0], 'loop 1,finished'],
])('%j at %d times the speed', (options, timeScale, times, events) => {
  const { made, heard, run } = player();
  made.timeScale = timeScale;
  made.name = 'walk';
  made.play(options);
  expect(run(...times.map(() => 0.75))).toEqual(times);
  expect(made.paused).toBe(true);
  expect(
    heard
      .slice(1)
      .map((line) => line.replace('walk ', '').replace(' walk', ''))
      .join(),
  ).toBe(events);
  // From the start again.
  made.play(options);
  expect(made.currentTime).toBe(timeScale < 0 ? 2 : 0);
});

test('many rounds within one step count, and an animation without a length ends at once', () => {
  const { made, heard, run } = player(0.1);
  made.play();
  expect(run(0.95)).toEqual([0.05]);
  expect(heard).toEqual(['play walk', 'loop walk 9']);
  const short = player(0);
  short.made.play();
  expect(short.run(0.5)).toEqual([0]);
  expect([short.heard, short.made.paused]).toEqual([['play walk', 'finished walk'], true]);
});

test('a time, a name and a pause pose the model; another model does not move', () => {
  const { made, heard, poses, run } = player();
  made.currentTime = 1.25;
  expect(poses).toEqual([['walk', 1.25]]);
  made.currentTime = 99;
  expect(made.currentTime).toBe(2);
  made.name = 'jump';
  expect(poses.at(-1)).toEqual(['jump', 0]);
  made.play();
  run(0.25);
  made.pause();
  expect(run(0.5)).toEqual([0.25]);
  expect(heard).toEqual(['play jump', 'pause jump', 'wake']);
  made.name = undefined;
  expect(poses.at(-1)).toEqual([undefined, 0]);
  made.destroy();
  made.play();
  expect([made.paused, heard.length]).toEqual([true, 3]);
});

test('what it cannot be is refused', () => {
  const { made } = player();
  const option = expect.objectContaining({ code: 'viewer/option' });
  expect(() => (made.currentTime = NaN)).toThrow(option);
  expect(() => (made.timeScale = Infinity)).toThrow(option);
  expect(() => made.play({ repetitions: 0.5 })).toThrow(option);
  expect(() => (made.name = 'dance')).toThrow(expect.objectContaining({ code: 'viewer/animation' }));
  expect(made.paused).toBe(true);
});
