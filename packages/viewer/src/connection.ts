import { requestDevice } from '@glanz/renderer';
import type { ToneMapOptions } from '@glanz/tonemap';
import { Display } from './display';
import { destroyed, ViewerError } from './errors';
import { DeviceLossPolicy } from './device-loss-policy';

/** What a connection reports to its engine. */
export interface ConnectionEvents {
  /** There is no device, but it is asked for again for about two seconds. */
  readonly missing?: ((error: unknown) => void) | undefined;
  /** The device is gone; another one is asked for. */
  readonly lost: (reason: string) => void;
  /** Another attempt to get one begins. */
  readonly recovering: () => void;
  /** There is another one: what was lost with the former, at this time of `performance.now()`, is to be made again. */
  readonly back: (lostAt: number) => void;
  /** No other one could be had. */
  readonly failed: (error: unknown) => void;
  /** The device reports an error. */
  readonly error: (error: unknown) => void;
}

/** Pauses between attempts to get a device back. */
const RECONNECT_MS = [100, 300, 1000];

/** Codes of errors that do not pass. */
const FOR_GOOD: ReadonlySet<unknown> = new Set(['renderer/no-webgpu', 'viewer/no-canvas']);

/** A canvas's device and display, and others in their place when they are lost. */
export class Connection {
  readonly #canvas: HTMLCanvasElement;
  readonly #events: ConnectionEvents;
  readonly #request: () => Promise<GPUDevice>;
  readonly #lossPolicy = new DeviceLossPolicy();
  #view: ToneMapOptions;
  #ready: Promise<void>;
  #device: GPUDevice | undefined;
  /** A device whose display is being made. */
  #coming: GPUDevice | undefined;
  #display: Display | undefined;
  #recovery: Promise<void> | undefined;
  /** A request for a device that is no recovery. */
  #connecting: Promise<void> | undefined;
  #destroyed = false;

  constructor(
    canvas: HTMLCanvasElement,
    view: ToneMapOptions,
    events: ConnectionEvents,
    request: () => Promise<GPUDevice> = requestDevice,
  ) {
    this.#canvas = canvas;
    this.#view = view;
    this.#events = events;
    this.#request = request;
    this.#ready = this.#begin();
  }

  get device(): GPUDevice | undefined {
    return this.#device;
  }

  get display(): Display | undefined {
    return this.#display;
  }

  /** Settles when a recovery that is under way has ended; `undefined` where none is. */
  get recovery(): Promise<void> | undefined {
    return this.#recovery;
  }

  /** When there was a first device; rejects with what kept it from coming. */
  get ready(): Promise<void> {
    return this.#ready;
  }

  /**
   * Makes sure that there is a device: the one in use, the one that a recovery brings, or else a new one, however often
   * the GPU was lost before.
   *
   * @throws {DeviceError} {ViewerError} where no device can be had.
   */
  async again(): Promise<void> {
    for (;;) {
      if (this.#destroyed) throw destroyed();
      if (this.#device) return;
      if (!this.#recovery) break;
      await this.#recovery;
    }
    if (!this.#connecting) {
      this.#lossPolicy.reset();
      this.#ready = this.#begin();
    }
    await this.#connecting;
  }

  /** Exposure and tone map that are in use, and that a new device will have. */
  get view(): ToneMapOptions {
    return this.#view;
  }

  /**
   * Sets exposure and tone map, of this display and of those to come.
   *
   * @param view Checked by the caller.
   * @throws {ToneMapError} `tonemap/pipeline`; what was refused is not kept.
   */
  async setView(view: ToneMapOptions): Promise<void> {
    this.#view = { ...this.#view, ...view };
    const display = this.#display;
    try {
      await display?.setView(view);
    } catch (error) {
      // A shader that does not compile must not keep the next device from coming.
      if (display && display === this.#display) this.#view = { ...this.#view, toneMap: display.toneMap };
      throw error;
    }
  }

  /** Forgets former losses and, where there is no device, asks for one. @returns Whether one is asked for. */
  retry(): boolean {
    this.#lossPolicy.reset();
    if (this.#device || this.#destroyed) return false;
    if (!this.#recovery && !this.#connecting) this.#recover('retry');
    return true;
  }

  destroy(): void {
    this.#destroyed = true;
    this.#display?.destroy();
    this.#device?.destroy();
    this.#coming?.destroy();
    this.#display = this.#device = this.#coming = undefined;
  }

  #begin(): Promise<void> {
    const connecting = this.#first().finally(() => (this.#connecting = undefined));
    // Callers that wait for it get the error; a page without a model does not.
    connecting.catch(() => undefined);
    return (this.#connecting = connecting);
  }

  /**
   * The GPU process may crash before there is a device that could be lost; it is started again then, as after a loss.
   */
  async #first(): Promise<void> {
    try {
      await this.#connect();
    } catch (error) {
      if (this.#destroyed || FOR_GOOD.has((error as { code?: unknown }).code)) throw error;
      this.#events.missing?.(error);
      await this.#reconnect();
    }
  }

  async #connect(): Promise<void> {
    const device = (this.#coming = await this.#request());
    try {
      if (this.#destroyed) throw destroyed();
      const display = (this.#display = await Display.create(this.#canvas, device, this.#view, () => !this.#destroyed));
      if (this.#destroyed) throw destroyed();
      // What was changed while it was made.
      await display.setView(this.#view);
    } catch (error) {
      // The canvas releases the device first: a browser may give no adapter for a while otherwise.
      this.#display?.destroy();
      this.#display = undefined;
      device.destroy();
      throw error;
    }
    this.#device = device;
    this.#coming = undefined;
    device.addEventListener('uncapturederror', (event) => {
      event.preventDefault();
      if (device === this.#device)
        this.#events.error(new ViewerError('viewer/gpu', `The GPU reports: ${event.error.message}`));
    });
    void device.lost.then(({ reason, message }) => {
      if (device !== this.#device || this.#destroyed) return;
      this.#device = undefined;
      this.#events.lost(`${reason}${message ? `: ${message}` : ''}`);
      this.#recover(reason);
    });
  }

  /** After a loss a browser may have no adapter for a while. */
  async #reconnect(): Promise<void> {
    for (const wait of RECONNECT_MS) {
      try {
        return await this.#connect();
      } catch {
        if (this.#destroyed) break;
        await new Promise((resolve) => setTimeout(resolve, wait));
      }
    }
    return this.#connect();
  }

  /** A new device in place of a lost one. */
  #recover(reason: string): void {
    const lostAt = performance.now();
    const attempt = async () => {
      this.#display?.destroy();
      this.#display = undefined;
      this.#events.recovering();
      // A device that the page destroyed does not come back by waiting.
      if (reason !== 'retry') await this.#lossPolicy.next();
      await this.#reconnect();
      // Unless that device is gone already: then another recovery has begun.
      if (recovery !== this.#recovery) return;
      this.#recovery = undefined;
      this.#events.back(lostAt);
    };
    // Set before the attempt runs, for it asks.
    const recovery = (this.#recovery = Promise.resolve()
      .then(attempt)
      .catch((error: unknown) => {
        this.#recovery = undefined;
        if (!this.#destroyed) this.#events.failed(error);
      }));
  }
}
