import { expect, test } from 'vitest';
import { Store } from '../src/state/store';

interface Little {
  readonly a: number;
  readonly b: string;
  readonly view: number;
}

function make() {
  let time = 0;
  const store = new Store<Little>({ a: 0, b: '', view: 0 }, ['view'], () => time);
  return { store, wait: (ms: number) => (time += ms) };
}

test('undo takes back one step after the other, redo brings them again, and a new step ends redo', () => {
  const { store } = make();
  store.set({ a: 1 }, { label: 'A' });
  store.set({ b: 'x' }, { label: 'B' });
  expect([store.undo(), store.state]).toEqual(['B', { a: 1, b: '', view: 0 }]);
  expect([store.undo(), store.state]).toEqual(['A', { a: 0, b: '', view: 0 }]);
  expect(store.undo()).toBeUndefined();
  expect([store.redo(), store.state.a]).toEqual(['A', 1]);
  store.set({ a: 5 }, { label: 'A' });
  expect(store.redo()).toBeUndefined();
  expect([store.undo(), store.state.a]).toEqual(['A', 1]);
});

test('changes of one kind in a row are one step, with a pause between them two', () => {
  const { store, wait } = make();
  for (let a = 1; a <= 10; a++) {
    store.set({ a }, { label: 'Slider' });
    wait(100);
  }
  store.undo();
  expect(store.state.a).toBe(0);
  store.set({ a: 1 }, { label: 'Slider' });
  wait(5000);
  store.set({ a: 2 }, { label: 'Slider' });
  store.undo();
  expect(store.state.a).toBe(1);
});

test('what is no step, and where one looks from, stays when a step is taken back', () => {
  const { store } = make();
  store.set({ a: 1 }, { label: 'A' });
  store.set({ view: 7 });
  expect(store.undoLabel).toBe('A');
  store.undo();
  expect(store.state).toEqual({ a: 0, b: '', view: 7 });
  store.redo();
  expect(store.state).toEqual({ a: 1, b: '', view: 7 });
});

test('listeners hear of changes only, with what was before and why', () => {
  const { store } = make();
  const heard: unknown[] = [];
  const stop = store.subscribe((next, before, source) => heard.push([next.a, before.a, source]));
  store.set({ a: 0 }, { label: 'Nothing' });
  expect(store.undoLabel).toBeUndefined();
  store.set({ a: 3 }, { label: 'A' });
  store.undo();
  store.load({ a: 9, b: '', view: 0 });
  stop();
  store.set({ a: 4 });
  expect(heard).toEqual([
    [3, 0, 'change'],
    [0, 3, 'undo'],
    [9, 0, 'load'],
  ]);
  expect(store.undoLabel).toBeUndefined();
});
