import { createCornellBox } from '@glanz/models';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { createViewer } from '@glanz/viewer';
import { setTimeout as wait } from 'node:timers/promises';
import { expect, it } from 'vitest';
import { makeScreen } from '../../src/preview/screen';

it('is as much of a browser as a viewer needs', async () => {
  const { gpu } = await createGpu({ software: 'only' });
  const { canvas, close } = makeScreen(gpu, 16, 12);
  const before = Object.getOwnPropertyDescriptor(globalThis, 'matchMedia');
  expect(before).toBeDefined();
  const errors: string[] = [];
  const viewer = createViewer(canvas, {
    pixelRatio: 1,
    samples: 2,
    controls: false,
    requestDevice: () => requestDevice({ gpu }),
  });
  viewer.on('error', ({ message }) => errors.push(message));
  const converged = new Promise<void>((resolve) => void viewer.on('converged', () => resolve(), { once: true }));
  await viewer.load(createCornellBox());
  await converged;
  // A frame of the image before may still come.
  const preview = new Promise<void>((resolve) => void viewer.on('frame', (frame) => frame.preview && resolve()));
  viewer.setOrbit({ theta: 0.1 }, { immediate: true });
  await preview;
  expect(errors).toEqual([]);
  viewer.destroy();
  // Its loop takes a turn to end.
  await wait(50);
  close();
  expect('matchMedia' in globalThis).toBe(false);
});
