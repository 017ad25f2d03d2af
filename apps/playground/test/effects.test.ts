import '../src/viewer/moves';
import { expect, test, vi } from 'vitest';
import type { PathTracer } from '@glanz/renderer';
import { sceneBounds, type Scene } from '@glanz/scene';
import { initialState, type State } from '../src/state/state';
import { applyChange, type EffectsHost } from '../src/viewer/effects';

const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const scene: Scene = {
  meshes: [{ name: 'box', positions: Float32Array.of(0, 0, 0, 2, 2, 2), indices: Uint32Array.of() }],
  materials: [],
  images: [],
  textures: [],
  lights: [],
  cameras: [],
  warnings: [],
  instances: [0, 1, 2].map(() => ({ name: '', mesh: 0, material: 0, transform: identity })),
};

test('moved parts are edits of their transforms, each by itself; the scene is not made again', async () => {
  const asked: unknown[][] = [];
  const tracer = { setInstanceTransform: (...args: unknown[]) => void asked.push(args) } as unknown as PathTracer;
  const show = vi.fn<() => Promise<void>>();
  const edit = (_key: string, apply: (one: PathTracer) => void | Promise<void>) => apply(tracer);
  const before = initialState('none');
  const next: State = {
    ...before,
    moves: { 1: { translation: [3, 0, 0], rotation: [0, 0, 0], scale: [1, 1, 1] } },
  };
  const host = {
    session: { edit, show },
    rig: { boundsOf: () => sceneBounds(scene) },
    scene: () => scene,
    state: () => next,
    environment: () => undefined,
    onError: (error: unknown) => {
      throw error as Error;
    },
  } as unknown as EffectsHost;
  applyChange(next, before, host);
  // Back again, as undo does it.
  applyChange(before, next, host);
  expect(asked).toEqual([
    [1, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1]],
    [1, identity],
  ]);
  expect(show).not.toHaveBeenCalled();
});
