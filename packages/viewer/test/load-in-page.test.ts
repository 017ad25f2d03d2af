import { quads } from '@glanz/browser';
import { describe, expect, it } from 'vitest';
import { loadModel } from '../src/load';

/** A worker whose loads end with an error. */
class FailingWorker extends EventTarget {
  readonly #code: string;

  constructor(code: string) {
    super();
    this.#code = code;
    queueMicrotask(() => this.#say({ kind: 'ready' }));
  }

  postMessage(): void {
    this.#say({ kind: 'error', code: this.#code, message: 'the worker does not read it' });
  }

  terminate(): void {}

  #say(data: object): void {
    this.dispatchEvent(new MessageEvent('message', { data }));
  }
}

const load = (code: string) =>
  loadModel(new File([new Uint8Array(quads([{ name: 'left', colour: [1, 0, 0] }]))], 'model.glb'), {
    createWorker: () => new FailingWorker(code) as unknown as Worker,
  });

describe('a worker that fails', () => {
  it.each(['gltf/worker', 'gltf/missing-decoder', 'wgsl/chunk'])('with %s: the page reads the file', async (code) => {
    expect((await load(code)).meshes.length).toBe(1);
  });

  it('because of the file: its error is reported', async () => {
    await expect(load('gltf/truncated')).rejects.toMatchObject({ code: 'gltf/truncated' });
  });
});
