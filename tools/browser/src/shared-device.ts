import { expect, test as base, type Browser, type Page, type ViewportSize } from '@playwright/test';
import { watch } from './page';

declare global {
  interface Window {
    /** Set by a test's init script: this page's devices are its own. */
    ownDevices?: boolean;
    /** Of the page that opened this one, where that lends its devices. */
    lendDevice?: (descriptor: GPUDeviceDescriptor | undefined) => Promise<GPUDevice>;
    /** Of a page with a borrowed device: draws nothing more to its canvases. */
    stopDrawing?: () => void;
    /** Of the page that lends: waits until its devices have done what they were given. */
    idleDevices?: () => Promise<void>;
  }
}

/** The page of a worker that holds the devices which its tests' pages share. */
class DeviceHost {
  /** Origin of the pages that share devices: set it before the first test. Where it changes, the devices are new. */
  origin = '';
  #page: Page | undefined;
  #complaints: string[] = [];

  /** A new page that the host has opened: both can use the same objects. */
  async open(browser: Browser, viewport: ViewportSize | null): Promise<Page> {
    const host = await this.#at(browser);
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

  /** Errors and warnings of the shared devices so far: the browser reports them to the host's console. */
  get complaints(): readonly string[] {
    return this.#complaints;
  }

  /** Closes a page, and drops what its device still reports, as the browser does when a device goes with its page. */
  async end(page: Page): Promise<void> {
    // A test may have closed it, or navigated to a page that renders nothing.
    await page.evaluate(() => window.stopDrawing?.()).catch(() => undefined);
    await page.close();
    await this.#page?.evaluate(() => window.idleDevices?.());
    this.#complaints.length = 0;
  }

  async close(): Promise<void> {
    await this.#page?.context().close();
    this.#page = undefined;
  }

  async #at(browser: Browser): Promise<Page> {
    const address = `${this.origin}/device-host.html`;
    if (this.#page?.url() === address) return this.#page;
    await this.close();
    const page = (this.#page = await (await browser.newContext()).newPage());
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
  const request = async (descriptor: GPUDeviceDescriptor | undefined, key: string) => {
    const adapter = await navigator.gpu.requestAdapter({ powerPreference: 'high-performance' });
    if (!adapter) throw new Error('no adapter for the shared device');
    const device = await adapter.requestDevice(descriptor);
    void device.lost.then(() => devices.delete(key));
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
  window.lendDevice = (descriptor) => {
    const key = JSON.stringify(descriptor ?? {});
    const device = devices.get(key) ?? request(descriptor, key);
    devices.set(key, device);
    device.catch(() => devices.delete(key));
    return device;
  };
  window.idleDevices = async () => {
    for (const device of devices.values()) await (await device).queue.onSubmittedWorkDone();
  };
}

/** Runs in each document of a test's page: its first device is one of the host's, others are its own. */
function borrowDevice(): void {
  if (!('GPUAdapter' in window)) return;
  // Bound again below.
  // eslint-disable-next-line @typescript-eslint/unbound-method
  const { requestDevice } = GPUAdapter.prototype;
  let isFirst = true;
  GPUAdapter.prototype.requestDevice = async function (descriptor) {
    const lend = isFirst && !window.ownDevices ? (window.opener as Window | null)?.lendDevice : undefined;
    if (!lend) return requestDevice.call(this, descriptor);
    isFirst = false;
    const device = await lend(descriptor);
    // Only this document sees it lost when it destroys it: the pages to come use it again. These are its own members;
    // without them the device has those of its prototype.
    Reflect.deleteProperty(device, 'lost');
    const reallyLost = device.lost;
    let resolveLost: (info: GPUDeviceLostInfo) => void = () => undefined;
    const destroyed = new Promise<GPUDeviceLostInfo>((resolve) => (resolveLost = resolve));
    const destroy = () => resolveLost({ reason: 'destroyed', message: '' } as GPUDeviceLostInfo);
    Object.defineProperty(device, 'lost', { configurable: true, value: Promise.race([destroyed, reallyLost]) });
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
 * `GPUDevice.prototype`, say), and with other `contextOptions`.
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
  page: async ({ browser, deviceHost, viewport, contextOptions }, use) => {
    if (Object.keys(contextOptions).length > 0) {
      const context = await browser.newContext({ viewport, ...contextOptions });
      await use(await context.newPage());
      await context.close();
      return;
    }
    const page = await deviceHost.open(browser, viewport);
    await use(page);
    const complaints = [...deviceHost.complaints];
    await deviceHost.end(page);
    expect(complaints).toEqual([]);
  },
});
