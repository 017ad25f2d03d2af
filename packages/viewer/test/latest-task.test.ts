import { expect, test } from 'vitest';
import { isAbort } from '../src/aborts';
import { LatestTask } from '../src/latest-task';

/** A task that ends by resolve() or reject(), or when its signal aborts. */
function makeTask() {
  let signal!: AbortSignal;
  let resolve!: (value: string) => void;
  let reject!: (error: Error) => void;
  const task = (its: AbortSignal) =>
    new Promise<string>((yes, no) => {
      [signal, resolve, reject] = [its, yes, no];
      its.addEventListener('abort', () => no(its.reason as Error));
    });
  return { task, signal: () => signal, resolve: (value: string) => resolve(value), reject: (e: Error) => reject(e) };
}

test('a new task aborts the one that is running, with its reason, and goes on running', async () => {
  const tasks = new LatestTask();
  const [first, second] = [makeTask(), makeTask()];
  const one = tasks.run('first', undefined, first.task);
  const two = tasks.run('another one', undefined, second.task);
  await expect(one).rejects.toSatisfy((error) => isAbort(error) && (error as Error).message === 'another one');
  expect([tasks.running, second.signal().aborted]).toEqual([true, false]);
  second.resolve('result');
  await expect(two).resolves.toBe('result');
  expect(tasks.running).toBe(false);
});

test("the caller's signal and abort() end a task", async () => {
  const tasks = new LatestTask();
  const caller = new AbortController();
  const [first, second] = [makeTask(), makeTask()];
  const one = tasks.run('first', caller.signal, first.task);
  caller.abort(new Error('enough'));
  await expect(one).rejects.toThrow('enough');
  const two = tasks.run('second', undefined, second.task);
  tasks.abort('the end');
  await expect(two).rejects.toThrow('the end');
  expect(tasks.running).toBe(false);
});

test('what a task has started is aborted when it fails', async () => {
  const tasks = new LatestTask();
  const { task, signal, reject } = makeTask();
  const run = tasks.run('first', undefined, task);
  reject(new Error('failed'));
  await expect(run).rejects.toThrow('failed');
  expect([signal().aborted, tasks.running]).toEqual([true, false]);
});
