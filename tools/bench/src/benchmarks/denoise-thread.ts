import { resolve } from 'node:path';
import { servePage } from '@glanz/browser';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { launchChromium } from '../browser/chromium';
import { BenchError } from '../error';
import type { Stage } from '../main-thread/denoise-page/main';

const SIZES: Readonly<Record<string, readonly [number, number]>> = { '512': [512, 512], '1080p': [1920, 1080] };
const LIMIT = { value: 50, relation: '<=', source: 'a long task begins' } as const;

/** How long a page's own thread is not free while it denoises, in Chromium. */
export const benchmark: Benchmark = {
  description: "the longest task of a page's own thread while the small network denoises an image",
  options: {
    sizes: { type: 'string', help: '512,1080p: which of these; both' },
    hardware: { type: 'string', help: '"yes": on the GPU of the machine' },
  },
  async run({ log, quick, values }) {
    const sizes = (values['sizes'] ?? (quick ? '512' : Object.keys(SIZES).join())).split(',');
    const unknown = sizes.find((size) => !Object.hasOwn(SIZES, size));
    if (unknown !== undefined)
      throw new BenchError('bench/option', `--sizes takes ${Object.keys(SIZES).join()}, not ${unknown}.`);
    const gpu = values['hardware'] === 'yes' ? 'hardware' : 'software';
    const images = quick ? 1 : 3;
    const served = await servePage(resolve('tools/bench/src/main-thread/denoise-page'));
    const { browser } = await launchChromium(gpu);
    const figures: Figure[] = [];
    let adapter = '';
    try {
      for (const size of sizes) {
        const [width, height] = SIZES[size]!;
        const page = await browser.newPage();
        await page.goto(served.origin);
        await page.waitForFunction(() => 'denoise' in globalThis);
        const result = await page.evaluate(
          ([w, h, count]) =>
            (
              globalThis as unknown as {
                denoise: (...given: number[]) => Promise<{ adapter: string; stages: Stage[] }>;
              }
            ).denoise(w, h, count),
          [width, height, images] as const,
        );
        await page.close();
        adapter = result.adapter;
        for (const name of ['creation', 'first image', 'image']) {
          const stages = result.stages.filter((stage) => stage.name === name);
          const longest = stages.map(({ longTasks }) => Math.max(0, ...longTasks));
          const what = `${width} × ${height}, ${name}`;
          figures.push(
            timed(`${what}: longest task of 50 ms and more, 0 for none`, 'ms', longest, LIMIT),
            timed(
              `${what}: longest gap between messages`,
              'ms',
              stages.map(({ longestGap }) => longestGap),
            ),
            timed(
              `${what}: all of it`,
              'ms',
              stages.map(({ ms }) => ms),
            ),
          );
          for (const { ms, longestGap, longTasks } of stages)
            log(
              `${what}: ${ms.toFixed(0)} ms, longest gap ${longestGap.toFixed(1)} ms, tasks of 50 ms and more: ${longTasks.map((task) => task.toFixed(0)).join(', ') || 'none'}`,
            );
        }
      }
    } finally {
      await browser.close();
      await served.close();
    }
    return {
      settings: {
        network: 'small',
        images,
        variance: 'given',
        browser: `Chromium ${browser.version()}, headless`,
        gpu,
      },
      gpu: { name: adapter, software: gpu === 'software' },
      figures,
      notes: [
        `By the clock, with what else the machine does${gpu === 'software' ? '; the GPU is software and shares the processor' : ''}.`,
      ],
    };
  },
};
