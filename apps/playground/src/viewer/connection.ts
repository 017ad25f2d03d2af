import { requestDevice } from '@glanz/renderer';
import type { ToneMapOptions } from '@glanz/tonemap';
import { PlaygroundError } from '../errors';
import { Display } from './display';
import { Losses } from './losses';

export interface ConnectionEvents {
  /** The device is gone; another one is asked for. */
  readonly onLost: () => void;
  /** There is another one. */
  readonly onBack: () => Promise<void>;
  /** None could be had; `retry` asks once more. */
  readonly onGivenUp: (error: unknown, retry: () => void) => void;
  readonly onError: (error: unknown) => void;
}

/** A canvas's device and display, and others in their place when they are lost. */
export class Connection {
  readonly #canvas: HTMLCanvasElement;
  readonly #events: ConnectionEvents;
  readonly #losses = new Losses();
  #device!: GPUDevice;
  #display!: Display;
  #recovery: Promise<void> | undefined;
  #view: ToneMapOptions;

  private constructor(canvas: HTMLCanvasElement, view: ToneMapOptions, events: ConnectionEvents) {
    this.#canvas = canvas;
    this.#view = view;
    this.#events = events;
  }

  /** @throws {DeviceError} without WebGPU. */
  static async create(canvas: HTMLCanvasElement, view: ToneMapOptions, events: ConnectionEvents): Promise<Connection> {
    const connection = new Connection(canvas, view, events);
    await connection.#connect();
    return connection;
  }

  get device(): GPUDevice {
    return this.#device;
  }

  get display(): Display {
    return this.#display;
  }

  /** Settles when a recovery that is under way has ended; undefined where none is. */
  get recovery(): Promise<void> | undefined {
    return this.#recovery;
  }

  /** What the GPU calls itself. */
  get adapterName(): string {
    const { description, device, architecture, vendor } = this.#device.adapterInfo;
    return description || device || [vendor, architecture].filter(Boolean).join(' ') || 'unnamed';
  }

  setView(view: ToneMapOptions): Promise<void> {
    this.#view = view;
    return this.#display.setView(view);
  }

  async #connect(): Promise<void> {
    const device = await requestDevice();
    try {
      this.#display = await Display.create(this.#canvas, device, this.#view);
    } catch (error) {
      device.destroy();
      throw error;
    }
    this.#device = device;
    device.addEventListener('uncapturederror', (event) => {
      event.preventDefault();
      if (device === this.#device) this.#events.onError(new PlaygroundError('playground/gpu', `The GPU reports: ${event.error.message}`));
    });
    void device.lost.then(() => {
      if (device === this.#device) this.#recover();
    });
  }

  #recover(): void {
    const attempt = async () => {
      this.#events.onLost();
      await this.#losses.next();
      await this.#connect();
      this.#recovery = undefined;
      await this.#events.onBack();
    };
    // Set before the attempt runs, for it asks.
    this.#recovery = Promise.resolve()
      .then(attempt)
      .catch((error: unknown) => {
        this.#recovery = undefined;
        this.#events.onGivenUp(error, () => {
          this.#losses.forgive();
          this.#recover();
        });
      });
  }
}
