import type { Page } from '@playwright/test';

/**
 * Lets a test lose the GPU as drivers do, reason `unknown`, which `destroy()` alone cannot: `window.loseGpu()`. Call before
 * the page is opened.
 */
export async function injectFaults(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const losses: (() => void)[] = [];
    Object.assign(window, { loseGpu: () => losses.at(-1)?.() });
    if (!('GPUAdapter' in window)) return;
    const { requestDevice } = GPUAdapter.prototype;
    GPUAdapter.prototype.requestDevice = async function (...given) {
      const device = await requestDevice.apply(this, given);
      const real = device.lost;
      const injected = new Promise<GPUDeviceLostInfo>((resolve) => {
        losses.push(() => {
          resolve({ reason: 'unknown', message: 'injected loss' } as GPUDeviceLostInfo);
          device.destroy();
        });
      });
      Object.defineProperty(device, 'lost', { value: Promise.race([injected, real]) });
      return device;
    };
  });
}
