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
  instances: [{ name: '', mesh: 0, material: 0, transform: identity }],
};

const MOVED = { translation: [3, 0, 0], rotation: [0, 0, 0], scale: [1, 1, 1] } as const;
const moved = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1];

type Apply = (tracer: PathTracer, merged: object) => void | Promise<void>;

/** A page with a model of some parts, whose edits wait for {@link frame}. */
function page(parts: number) {
  const model: Scene = { ...scene, instances: Array.from({ length: parts }, () => scene.instances[0]!) };
  const asked: unknown[][] = [];
  const note =
    (name: string) =>
    (...args: unknown[]) =>
      Promise.resolve(void asked.push([name, ...args]));
  const tracer = {
    setInstanceTransforms: note('move'),
    setVisibility: note('visible'),
  } as unknown as PathTracer;
  const waiting = new Map<string, { readonly apply: Apply; readonly value: object }>();
  const show = vi.fn<() => Promise<void>>();
  let state = initialState('none');
  const host = {
    session: {
      // As the viewer's engine: of edits with one key the last counts, and the fields of their values add up.
      edit: (key: string, apply: Apply, value: object = {}) =>
        waiting.set(key, { apply, value: { ...waiting.get(key)?.value, ...value } }),
      show,
    },
    rig: { boundsOf: () => sceneBounds(model) },
    scene: () => model,
    state: () => state,
    environment: () => undefined,
    onError: (error: unknown) => {
      throw error as Error;
    },
  } as unknown as EffectsHost;
  return {
    asked,
    show,
    set(change: Partial<State>): void {
      const before = state;
      state = { ...state, ...change };
      applyChange(state, before, host);
    },
    async frame(): Promise<unknown[][]> {
      for (const { apply, value } of waiting.values()) await apply(tracer, value);
      waiting.clear();
      return asked.splice(0);
    },
  };
}

test('moved parts are one edit a frame, however many; the scene is not made again', async () => {
  const { set, frame, show } = page(1000);
  const all = Object.fromEntries(Array.from({ length: 1000 }, (_, i) => [i, MOVED]));
  set({ moves: all });
  const [[name, list] = [], ...others] = await frame();
  expect([name, others]).toEqual(['move', []]);
  expect(list).toEqual(Array.from({ length: 1000 }, (_, i) => [i, moved]));
  // Back again, as undo does it.
  set({ moves: {} });
  expect(await frame()).toEqual([['move', Array.from({ length: 1000 }, (_, i) => [i, identity])]]);
  expect(show).not.toHaveBeenCalled();
});

test('what changes between two frames adds up: no part is left where it was', async () => {
  const { set, frame } = page(4);
  set({ moves: { 1: MOVED } });
  set({ moves: { 1: MOVED, 2: MOVED } });
  set({ moves: { 2: MOVED } });
  expect(await frame()).toEqual([
    [
      'move',
      [
        [1, identity],
        [2, moved],
      ],
    ],
  ]);
});

test('any number of parts is hidden and shown by one edit each, shown ones first', async () => {
  const { set, frame, show } = page(200);
  const first = Array.from({ length: 150 }, (_, i) => i);
  set({ hidden: first });
  expect(await frame()).toEqual([['visible', first, false]]);
  set({ hidden: [0, 199] });
  expect(await frame()).toEqual([
    ['visible', first.slice(1), true],
    ['visible', [199], false],
  ]);
  expect(show).not.toHaveBeenCalled();
});
