import { PathTracer, requestDevice } from '@glanz/renderer';
import type { Material } from '@glanz/scene';
import { ToneMapPass, type ToneMap } from '@glanz/tonemap';
import { createLiveScene, type LiveSceneName } from './scenes';

/** What a live image reports to its page. */
export interface LiveStatus {
  readonly stage: 'prepare' | 'render' | 'done';
  readonly samples: number;
  readonly target: number;
  readonly samplesPerSecond: number;
}

export interface LiveOptions {
  readonly scene: LiveSceneName;
  readonly samples: number;
  readonly toneMap: ToneMap;
  readonly exposure: number;
  readonly signal: AbortSignal;
  readonly onStatus: (status: LiveStatus) => void;
}

/** Pixels that a page path-traces at most; wider canvases are scaled up. */
const MAX_PIXELS = 960 * 640;

/** A path-traced canvas: prepares, renders until the target, starts again after edits. */
export class LiveSession {
  readonly #device: GPUDevice;
  readonly #tracer: PathTracer;
  readonly #pass: ToneMapPass;
  readonly #context: GPUCanvasContext;
  readonly #options: LiveOptions;
  #wake: () => void = () => undefined;

  private constructor(
    device: GPUDevice,
    tracer: PathTracer,
    pass: ToneMapPass,
    context: GPUCanvasContext,
    options: LiveOptions,
  ) {
    this.#device = device;
    this.#tracer = tracer;
    this.#pass = pass;
    this.#context = context;
    this.#options = options;
  }

  /** @throws {DeviceError} without WebGPU; and what `PathTracer.create` throws. */
  static async create(canvas: HTMLCanvasElement, options: LiveOptions): Promise<LiveSession> {
    options.onStatus({ stage: 'prepare', samples: 0, target: options.samples, samplesPerSecond: 0 });
    const device = await requestDevice();
    try {
      const { width, height } = filmSize(canvas);
      canvas.width = width;
      canvas.height = height;
      const tracer = await PathTracer.create(device, createLiveScene(options.scene), {
        width,
        height,
        maxDepth: 5,
        signal: options.signal,
      });
      const format = navigator.gpu.getPreferredCanvasFormat();
      const pass = await ToneMapPass.create(device, { format, toneMap: options.toneMap, exposure: options.exposure });
      const context = canvas.getContext('webgpu');
      if (!context) throw new Error('The canvas gave no WebGPU context.');
      context.configure({ device, format, alphaMode: 'premultiplied' });
      return new LiveSession(device, tracer, pass, context, options);
    } catch (error) {
      device.destroy();
      throw error;
    }
  }

  /** Adds samples, and waits for edits when there are enough. Ends when the signal aborts. */
  async run(): Promise<void> {
    const { signal, samples, onStatus } = this.#options;
    const stopped = new Promise<void>((resolve) => signal.addEventListener('abort', () => resolve(), { once: true }));
    while (!signal.aborted) {
      for await (const progress of this.#tracer.render({ samples, signal })) {
        this.draw();
        onStatus({
          stage: 'render',
          samples: progress.samples,
          target: samples,
          samplesPerSecond: progress.samplesPerSecond,
        });
      }
      if (signal.aborted || this.#tracer.samples < samples) continue;
      onStatus({ stage: 'done', samples, target: samples, samplesPerSecond: 0 });
      await Promise.race([stopped, new Promise<void>((resolve) => (this.#wake = resolve))]);
    }
  }

  /** Shows what the film holds. */
  draw(): void {
    const { width, height } = this.#tracer;
    const encoder = this.#device.createCommandEncoder();
    this.#pass.draw(
      encoder,
      this.#tracer.beautyBuffer,
      [width, height],
      this.#context.getCurrentTexture().createView(),
    );
    this.#device.queue.submit([encoder.finish()]);
  }

  async setView(view: { readonly toneMap: ToneMap; readonly exposure: number }): Promise<void> {
    await this.#pass.setOptions(view);
    if (this.#tracer.samples > 0) this.draw();
  }

  async setMaterial(name: string, parameters: Material['parameters']): Promise<void> {
    await this.#tracer.setMaterial(name, parameters);
    this.#wake();
  }

  /** Frees everything, the device too. */
  destroy(): void {
    this.#tracer.destroy();
    this.#pass.destroy();
    this.#context.unconfigure();
    this.#device.destroy();
  }
}

function filmSize(canvas: HTMLCanvasElement): { width: number; height: number } {
  const { clientWidth, clientHeight } = canvas;
  const scale = Math.min(window.devicePixelRatio || 1, Math.sqrt(MAX_PIXELS / Math.max(1, clientWidth * clientHeight)));
  return { width: Math.max(1, Math.round(clientWidth * scale)), height: Math.max(1, Math.round(clientHeight * scale)) };
}
