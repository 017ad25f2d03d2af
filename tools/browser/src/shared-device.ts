import { expect, type Browser, type Page, type ViewportSize } from '@playwright/test';
import { test as base } from './context-options';
import { watch } from './page';

declare global {
  interface Window {
    /** Set by a test's init script: this page's devices are its own. */
    ownDevices?: boolean;
    /** Of the page that opened this one, where that lends its devices. `onLost` is called if the device is lost. */
    lendDevice?: (
      descriptor: GPUDeviceDescriptor | undefined,
      onLost: (info: GPUDeviceLostInfo) => void,
    ) => Promise<GPUDevice>;
    /** Of a page with a borrowed device: draws nothing more to its canvases. */
    stopDrawing?: () => void;
    /** Of the page that lends: waits until its devices have done what they were given. */
    idleDevices?: () => Promise<void>;
    /** Of the page that lends: forgets whatever the documents that borrowed its devices have added to them. */
    takeBackDevices?: () => Promise<void>;
  }
}

/** The page of a worker that holds the devices which its tests' pages share. */
class DeviceHost {
  /** Origin of the pages that share devices: set it before the first test. Where it changes, the devices are new. */
  origin = '';
  #page: Page | undefined;
  #contextKey = '';
  #hasCrashed = false;
  #complaints: string[] = [];

  /**
   * A new page that the host has opened: both can use the same objects.
   * @returns Nothing where the test's options are not those with which the host was opened: a context keeps them.
   */
  async open(browser: Browser, viewport: ViewportSize | null, contextKey: string): Promise<Page | undefined> {
    const host = await this.#at(browser, contextKey);
    if (this.#contextKey !== contextKey) return undefined;
    // What the test before was allowed and has stored is not for this one.
    await host.context().clearPermissions();
    await host.context().clearCookies();
    const [page] = await Promise.all([
      host.waitForEvent('popup'),
      host.evaluate(async () => {
        localStorage.clear();
        for (const name of await caches.keys()) await caches.delete(name);
        for (const { name } of await indexedDB.databases()) if (name) indexedDB.deleteDatabase(name);
        window.open('about:blank', '_blank', 'popup');
      }),
    ]);
    if (viewport) await page.setViewportSize(viewport);
    await page.addInitScript(borrowDevice);
    return page;
  }

  /**
   * Closes a page and those that its test has opened besides. Drops what its device reports after that, as the browser
   * does when a device goes with its page.
   * @returns Errors and warnings of the shared devices: the browser reports them to the host's console.
   */
  async end(page: Page): Promise<readonly string[]> {
    const host = this.#page;
    // The test may have closed the context.
    if (!host || host.isClosed()) return this.#complaints;
    await host.evaluate(() => window.idleDevices?.());
    const complaints = this.#complaints.splice(0);
    // A test may have closed it, or navigated to a page that renders nothing.
    await page.evaluate(() => window.stopDrawing?.()).catch(() => undefined);
    for (const opened of host.context().pages()) if (opened !== host) await opened.close();
    await host.evaluate(async () => {
      await window.takeBackDevices?.();
      await window.idleDevices?.();
    });
    this.#complaints.length = 0;
    return complaints;
  }

  async close(): Promise<void> {
    await this.#page?.context().close();
    this.#page = undefined;
  }

  async #at(browser: Browser, contextKey: string): Promise<Page> {
    if (!this.origin) throw new Error('deviceHost.origin is not set: set it in test.beforeAll, as the example shows.');
    const address = `${this.origin}/device-host.html`;
    if (this.#page?.url() === address && !this.#page.isClosed() && !this.#hasCrashed) return this.#page;
    await this.close();
    // The context takes the options of the test that runs.
    const page = (this.#page = await (await browser.newContext()).newPage());
    this.#contextKey = contextKey;
    this.#hasCrashed = false;
    page.once('crash', () => (this.#hasCrashed = true));
    await page.route(address, (route) => route.fulfill({ contentType: 'text/html', body: '<title>Devices</title>' }));
    this.#complaints = watch(page, this.origin);
    await page.goto(address);
    await page.evaluate(lendDevices);
    return page;
  }
}

/** Runs in the host. */
function lendDevices(): void {
  const devices = new Map<string, Promise<GPUDevice>>();
  const pipelines = new Set<object>();
  // Whatever reacts to `device.lost` stays reachable while the device lives, so borrowers listen here until they close.
  const lossListeners = new Map<string, Set<(info: GPUDeviceLostInfo) => void>>();
  let loan = new AbortController();
  const request = async (descriptor: GPUDeviceDescriptor | undefined, key: string) => {
    const adapter = await navigator.gpu.requestAdapter({ powerPreference: 'high-performance' });
    if (!adapter) throw new Error('no adapter for the shared device');
    const device = await adapter.requestDevice(descriptor);
    void device.lost.then((info) => {
      devices.delete(key);
      for (const listener of lossListeners.get(key) ?? []) listener(info);
      lossListeners.delete(key);
    });
    const listen = device.addEventListener.bind(device) as EventTarget['addEventListener'];
    Object.defineProperty(device, 'addEventListener', {
      value: (...[type, listener, options]: Parameters<EventTarget['addEventListener']>) =>
        listen(type, listener, { ...(typeof options === 'object' ? options : {}), signal: loan.signal }),
    });
    // Dawn answers a request for a pipeline that still exists with that one, without compiling.
    for (const name of ['createComputePipelineAsync', 'createRenderPipelineAsync'] as const) {
      const create = device[name].bind(device) as (given: never) => Promise<object>;
      Object.defineProperty(device, name, {
        value: async (given: never) => {
          const pipeline = await create(given);
          pipelines.add(pipeline);
          return pipeline;
        },
      });
    }
    return device;
  };
  window.lendDevice = (descriptor, onLost) => {
    const key = JSON.stringify(descriptor ?? {});
    lossListeners.set(key, (lossListeners.get(key) ?? new Set()).add(onLost));
    const device = devices.get(key) ?? request(descriptor, key);
    devices.set(key, device);
    device.catch(() => devices.delete(key));
    return device;
  };
  window.idleDevices = async () => {
    for (const device of devices.values()) await (await device).queue.onSubmittedWorkDone();
  };
  window.takeBackDevices = async () => {
    lossListeners.clear();
    loan.abort();
    loan = new AbortController();
    for (const device of devices.values()) {
      const lent = await device;
      Reflect.deleteProperty(lent, 'lost');
      Reflect.deleteProperty(lent, 'destroy');
    }
  };
}

/** Runs in each document of a test's page: its first device is one of the host's, others are its own. */
function borrowDevice(): void {
  if (!('GPUAdapter' in window)) return;
  // Bound again below.
  // eslint-disable-next-line @typescript-eslint/unbound-method
  const { requestDevice } = GPUAdapter.prototype;
  // A page of another origin cannot read its opener.
  const lender = () => {
    try {
      return (window.opener as Window | null)?.lendDevice;
    } catch {
      return undefined;
    }
  };
  let isFirst = true;
  GPUAdapter.prototype.requestDevice = async function (descriptor) {
    const lend = isFirst && !window.ownDevices ? lender() : undefined;
    if (!lend) return requestDevice.call(this, descriptor);
    isFirst = false;
    let resolveLost: (info: GPUDeviceLostInfo) => void = () => undefined;
    const lost = new Promise<GPUDeviceLostInfo>((resolve) => (resolveLost = resolve));
    const device = await lend(descriptor, resolveLost);
    // Only this document sees it lost when it destroys it: the pages to come use it again. These are its own members;
    // without them the device has those of its prototype.
    const destroy = () => resolveLost({ reason: 'destroyed', message: '' } as GPUDeviceLostInfo);
    Object.defineProperty(device, 'lost', { configurable: true, value: lost });
    Object.defineProperty(device, 'destroy', { configurable: true, value: destroy });
    // The device still settles the promises that a closed document awaits. To draw to its canvases is an error then.
    window.stopDrawing = () => {
      GPUCanvasContext.prototype.getCurrentTexture = () => {
        throw new DOMException('The page is closed.', 'InvalidStateError');
      };
    };
    addEventListener('pagehide', window.stopDrawing);
    return device;
  };
}

/**
 * Playwright's `test` for pages that render: their device, with the programs that it has compiled, is kept from test to
 * test. A new device would compile the same programs again, which takes a quarter of the processor time of short tests.
 * Each test has a new page without stored data all the same. The pages of a spec file are windows that one page has
 * opened, which lends each document its device. A failed test ends its worker, and with it the device.
 *
 * The first device that a document requests is the shared one, others are its own. All are its own after
 * `injectFaults`, where an init script sets `window.ownDevices` (because it replaces functions of
 * `GPUDevice.prototype`, say).
 *
 * The pages share a context, which takes the `use` options of the first test of an origin. A test has a context and
 * devices of its own where its options are others (`colorScheme`, `hasTouch`, `locale` …; not the viewport), and always
 * with `contextOptions`, `permissions` or `storageState`.
 *
 * @example
 * test.beforeAll(async ({ deviceHost }) => {
 *   served = await servePage(folder);
 *   deviceHost.origin = served.origin;
 * });
 */
export const test = base.extend<object, { deviceHost: DeviceHost }>({
  deviceHost: [
    // Playwright reads the names of fixtures from the pattern.
    // eslint-disable-next-line no-empty-pattern
    async ({}, use) => {
      const host = new DeviceHost();
      await use(host);
      await host.close();
    },
    { scope: 'worker' },
  ],
  page: async ({ browser, deviceHost, viewport, contextKey, contextOptions, permissions, storageState }, use) => {
    // The host removes permissions and storage before each test.
    const isAlone = Object.keys(contextOptions).length > 0 || permissions !== undefined || storageState !== undefined;
    const page = isAlone ? undefined : await deviceHost.open(browser, viewport, contextKey);
    if (page) {
      await use(page);
      expect(await deviceHost.end(page)).toEqual([]);
      return;
    }
    const context = await browser.newContext();
    await use(await context.newPage());
    await context.close();
  },
});
