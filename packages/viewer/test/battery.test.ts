import { afterEach, expect, it, vi } from 'vitest';
import { watchBattery } from '../src/battery';

afterEach(() => void vi.unstubAllGlobals());

it('is low where it is nearly empty and not charging, as it changes', async () => {
  const battery = { charging: false, level: 0.5 };
  vi.stubGlobal('navigator', { getBattery: () => Promise.resolve(battery) });
  const low = watchBattery();
  expect(low()).toBe(false);
  await Promise.resolve();
  expect(low()).toBe(false);
  battery.level = 0.1;
  expect(low()).toBe(true);
  battery.charging = true;
  expect(low()).toBe(false);
});

it('is not low where the browser does not tell, or may not', async () => {
  vi.stubGlobal('navigator', {});
  expect(watchBattery()()).toBe(false);
  vi.stubGlobal('navigator', { getBattery: () => Promise.reject(new Error('not allowed')) });
  const low = watchBattery();
  await new Promise((resolve) => setTimeout(resolve, 0));
  expect(low()).toBe(false);
});
