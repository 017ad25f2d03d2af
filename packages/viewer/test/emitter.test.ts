import { expect, test } from 'vitest';
import { Emitter } from '../src/emitter';

interface Events {
  a: number;
  b: string;
}

test('calls the listeners of an event in their order, until they are removed, abort or have been called once', () => {
  const emitter = new Emitter<Events>();
  const calls: string[] = [];
  const listening = new AbortController();
  const off = emitter.on('a', (n) => calls.push(`removed ${n}`));
  emitter.on('a', (n) => calls.push(`aborted ${n}`), { signal: listening.signal });
  emitter.on('a', (n) => calls.push(`once ${n}`), { once: true });
  emitter.on('b', (text) => calls.push(text));
  emitter.emit('a', 1);
  expect(calls).toEqual(['removed 1', 'aborted 1', 'once 1']);
  off();
  emitter.emit('a', 2);
  listening.abort();
  emitter.emit('a', 3);
  emitter.emit('b', 'b');
  expect(calls.slice(3)).toEqual(['aborted 2', 'b']);
  expect([emitter.has('a'), emitter.has('b')]).toEqual([false, true]);
});

test('takes no listener whose signal has aborted, and none once it is closed', () => {
  const emitter = new Emitter<Events>();
  const calls: number[] = [];
  const off = emitter.on('a', (n) => calls.push(n), { signal: AbortSignal.abort() });
  emitter.emit('a', 1);
  off();
  emitter.on('a', (n) => calls.push(n));
  emitter.close();
  emitter.emit('a', 2);
  emitter.on('a', (n) => calls.push(n))();
  emitter.on('a', (n) => calls.push(n));
  emitter.emit('a', 3);
  expect([calls, emitter.has('a')]).toEqual([[], false]);
});

test('a listener that adds or removes others does not change who gets the present event', () => {
  const emitter = new Emitter<Events>();
  const calls: string[] = [];
  emitter.on('a', () => {
    calls.push('first');
    off();
    emitter.on('a', () => calls.push('added'));
  });
  const off = emitter.on('a', () => calls.push('second'));
  emitter.emit('a', 1);
  expect(calls).toEqual(['first', 'second']);
  emitter.emit('a', 2);
  expect(calls.slice(2)).toEqual(['first', 'added']);
});
