import { SceneError } from './error';
import { STEP } from './slices';

/** @throws {SceneError} always. */
export const fail = (code: 'reference' | 'length' | 'not-finite' | 'value', message: string): never => {
  throw new SceneError(`scene/${code}`, message);
};

/** What a message is about; a function where there may be a million of them. */
export type What = string | (() => string);

export const textOf = (what: What): string => (typeof what === 'string' ? what : what());

/** @throws {SceneError} `scene/reference` where an index is not one of a list. */
export function reference(index: number, list: readonly unknown[], what: What, kind: string): void {
  if (!(Number.isInteger(index) && index >= 0 && index < list.length))
    fail('reference', `${textOf(what)} refers to ${kind} ${index}; the scene has ${list.length}.`);
}

/** @throws {SceneError} `scene/not-finite` where a number from `from` up to `end` is not finite. */
export function finite(values: ArrayLike<number>, what: What, from = 0, end = values.length): void {
  if (values instanceof Float32Array) {
    // x − x is 0 only for finite x, so sums check all of them; two, because an addition waits for the one before.
    let [even, odd] = [0, 0];
    for (let i = from; i < end; i += 2) {
      const first = values[i] as number,
        second = values[Math.min(i + 1, end - 1)] as number;
      even += first - first;
      odd += second - second;
    }
    if (even + odd === 0) return;
  }
  for (let i = from; i < end; i++) {
    if (!Number.isFinite(values[i]))
      fail('not-finite', `${textOf(what)} holds ${values[i]} at ${i}; every number must be finite.`);
  }
}

/** {@link finite}, in steps. */
export function* finiteSteps(values: ArrayLike<number>, what: string): Generator<void> {
  for (let from = 0; from < values.length; from += STEP) {
    finite(values, what, from, Math.min(values.length, from + STEP));
    yield;
  }
}

/** @throws {SceneError} `scene/length` where there are not so many numbers. */
export function length(values: ArrayLike<number>, expected: number, what: What): void {
  if (values.length !== expected)
    fail('length', `${textOf(what)} has ${values.length} numbers; it must have ${expected}.`);
}
