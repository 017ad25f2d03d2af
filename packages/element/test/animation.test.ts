import type { SceneAnimation } from '@glanz/scene';
import type { AnimationPlayer, Viewer } from '@glanz/viewer';
import { expect, it } from 'vitest';
import { ElementAnimation } from '../src/animation';

const animations = (name: string): readonly SceneAnimation[] => [{ name, duration: 2 } as SceneAnimation];

it('plays the next model, although the player of the former one fails after that', async () => {
  const opening: { resolve: (player: AnimationPlayer) => void; reject: (error: Error) => void }[] = [];
  const failed: unknown[] = [];
  const viewer = { animation: () => new Promise((resolve, reject) => opening.push({ resolve, reject })) };
  const animation = new ElementAnimation({
    viewer: () => viewer as unknown as Viewer,
    name: () => null,
    autoplay: () => true,
    fail: (error) => void failed.push(error),
  });
  animation.begin(animations('former'));
  animation.begin(animations('next'));
  opening[0]!.reject(new Error('another model is shown'));
  await new Promise((resolve) => setTimeout(resolve));
  expect(animation.paused).toBe(false);
  let plays = 0;
  opening[1]!.resolve({ paused: false, play: () => plays++ } as unknown as AnimationPlayer);
  await expect.poll(() => plays).toBe(1);
  expect(animation.paused).toBe(false);
  // Of what is still to come, the player that is there is asked, and no further one.
  animation.currentTime = 1;
  expect(opening).toHaveLength(2);
  expect(failed).toEqual([]);
});

it('is paused, and can play again, where its player fails', async () => {
  let asked = 0;
  const failed: unknown[] = [];
  const viewer = { animation: () => Promise.reject(new Error(`the file is broken ${++asked}`)) };
  const animation = new ElementAnimation({
    viewer: () => viewer as unknown as Viewer,
    name: () => null,
    autoplay: () => true,
    fail: (error) => void failed.push((error as Error).message),
  });
  animation.begin(animations('only'));
  await expect.poll(() => failed).toEqual(['the file is broken 1']);
  expect(animation.paused).toBe(true);
  animation.play();
  await expect.poll(() => failed).toEqual(['the file is broken 1', 'the file is broken 2']);
});
