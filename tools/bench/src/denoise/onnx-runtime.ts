import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { BenchError } from '../error';
import { randomArchive, type NetworkSize } from './networks';
import { onnxModel } from './onnx';

/** What is used of ONNX Runtime Web, whose types would come with 130 MB of files. */
interface OrtTensor {
  readonly data: Float32Array;
  dispose(): void;
}
interface OrtSession {
  run(inputs: { readonly input: OrtTensor }): Promise<{ readonly output: OrtTensor }>;
  release(): Promise<void>;
}
interface Ort {
  readonly env: {
    logLevel: string;
    readonly versions: { readonly web?: string };
    readonly wasm: Record<string, unknown>;
  };
  readonly InferenceSession: {
    create(model: Uint8Array, options: Readonly<Record<string, unknown>>): Promise<OrtSession>;
  };
  readonly Tensor: {
    new (type: 'float32', data: Float32Array, shape: readonly number[]): OrtTensor;
    fromGpuBuffer(
      buffer: GPUBuffer,
      options: { readonly dataType: 'float32'; readonly dims: readonly number[] },
    ): OrtTensor;
  };
}

/** ONNX Runtime Web on a device of Dawn, in Node: it is made for browsers. */
export class OnnxRuntime {
  readonly #ort: Ort;
  readonly #device: GPUDevice;
  readonly #alive = setInterval(() => undefined, 1000);

  private constructor(ort: Ort, device: GPUDevice) {
    this.#ort = ort;
    this.#device = device;
  }

  /** @param folder Where the npm package onnxruntime-web lies. */
  static async load(folder: string, gpu: GPU, device: GPUDevice): Promise<OnnxRuntime> {
    const file = join(folder, 'dist/ort.webgpu.bundle.min.mjs');
    const binary = join(folder, 'dist/ort-wasm-simd-threaded.asyncify.wasm');
    Object.defineProperty(globalThis, 'navigator', {
      configurable: true,
      value: { gpu, hardwareConcurrency: 1, userAgent: 'Node' },
    });
    // Its WebAssembly has shared memory, which Dawn's binding for Node refuses as a source.
    const prototype = Object.getPrototypeOf(device.queue) as { writeBuffer: GPUQueue['writeBuffer'] };
    const { writeBuffer } = prototype;
    prototype.writeBuffer = function write(this: GPUQueue, buffer, offset, data, ...rest) {
      const shared = ArrayBuffer.isView(data) && data.buffer instanceof SharedArrayBuffer;
      return writeBuffer.call(
        this,
        buffer,
        offset,
        shared ? (data as Uint8Array<ArrayBuffer>).slice() : (data as BufferSource),
        ...rest,
      );
    };
    let ort: Ort;
    try {
      ort = (await import(pathToFileURL(file).href)) as Ort;
      ort.env.wasm['wasmBinary'] = readFileSync(binary).buffer;
    } catch (cause) {
      throw new BenchError(
        'bench/option',
        `--onnxruntime ${folder}: ${(cause as Error).message}. Give the folder of the npm package onnxruntime-web.`,
        { cause },
      );
    }
    ort.env.wasm['numThreads'] = 1;
    ort.env.logLevel = 'error';
    return new OnnxRuntime(ort, device);
  }

  get version(): string {
    return this.#ort.env.versions.web ?? 'unknown';
  }

  /** The largest difference between its WebGPU and its CPU for a small image, where values are about 1. */
  async difference(network: NetworkSize): Promise<number> {
    const [width, height] = [32, 32];
    const model = onnxModel(network, randomArchive(network), width, height);
    const data = Float32Array.from({ length: 9 * width * height }, (_, i) => ((i * 7919) % 1000) / 1000);
    const results: Float32Array[] = [];
    for (const provider of [{ name: 'webgpu', device: this.#device }, 'wasm']) {
      const session = await this.#ort.InferenceSession.create(model, { executionProviders: [provider] });
      const { output } = await session.run({ input: new this.#ort.Tensor('float32', data, [1, 9, height, width]) });
      results.push(output.data.slice());
      await session.release();
    }
    const [a, b] = results as [Float32Array, Float32Array];
    return a.reduce((largest, value, i) => Math.max(largest, Math.abs(value - b[i]!)), 0);
  }

  /** Gives what evaluates a network on an image in GPU memory, and destroys it after `use`. */
  async with<T>(
    network: NetworkSize,
    width: number,
    height: number,
    use: (run: () => Promise<void>) => Promise<T>,
  ): Promise<T> {
    const model = onnxModel(network, randomArchive(network), width, height);
    const session = await this.#ort.InferenceSession.create(model, {
      executionProviders: [{ name: 'webgpu', device: this.#device }],
      preferredOutputLocation: 'gpu-buffer',
    });
    const dims = [1, 9, height, width];
    const buffer = this.#device.createBuffer({
      size: 4 * 9 * width * height,
      usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC | GPUBufferUsage.COPY_DST,
    });
    const input = this.#ort.Tensor.fromGpuBuffer(buffer, { dataType: 'float32', dims });
    try {
      return await use(async () => {
        const { output } = await session.run({ input });
        await this.#device.queue.onSubmittedWorkDone();
        output.dispose();
      });
    } finally {
      await session.release();
      buffer.destroy();
    }
  }

  destroy(): void {
    clearInterval(this.#alive);
  }
}
