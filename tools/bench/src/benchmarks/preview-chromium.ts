import { launchChromium } from '../browser/chromium';
import { latency, turn, watchFrames, type Turned } from '../browser/drag';
import { firstFilm, servePlayground } from '../browser/playground';
import { timed, type Benchmark, type Figure } from '../benchmark';

/** Sizes of the image, pixels. */
const SIZES = [
  [640, 360],
  [1280, 720],
  [1920, 1080],
] as const;

const quantile = (values: readonly number[], q: number) =>
  [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(q * values.length))]!;

/** The playground in Chromium while the user turns the push-button. */
export const benchmark: Benchmark = {
  description: 'the playground in Chromium while the user turns the model: frames, resolution, and latency',
  options: { hardware: { type: 'string', help: '"yes": on the GPU of the machine' } },
  async run({ log, quick, values }) {
    const gpu = values['hardware'] === 'yes' ? 'hardware' : 'software';
    const { browser } = await launchChromium(gpu);
    const server = await servePlayground();
    const figures: Figure[] = [];
    let adapter = '';
    try {
      for (const [width, height] of quick || gpu === 'software' ? SIZES.slice(0, 1) : SIZES) {
        const page = await browser.newPage({ viewport: { width: width + 700, height: height + 300 } });
        await watchFrames(page);
        await page.goto(`${server.origin}/?model=push-button&floor=off&samples=100000`);
        const canvas = page.locator('#image');
        await firstFilm(page);
        // The panels take what they take; the image gets the rest.
        const box = (await canvas.boundingBox())!;
        await page.setViewportSize({
          width: Math.round(width + 700 + width - box.width),
          height: Math.round(height + 300 + height - box.height),
        });
        await page.waitForTimeout(1500);
        const place = (await canvas.boundingBox())!;
        const size = `${await canvas.evaluate((element: HTMLCanvasElement) => `${element.width} × ${element.height}`)}`;
        adapter ||= await page.evaluate(async () => {
          const { vendor, architecture, device, description } = (await navigator.gpu.requestAdapter())!.info;
          return [vendor, architecture, device, description].filter(Boolean).join(' ');
        });
        const at = [place.x + 0.5 * place.width, place.y + 0.55 * place.height] as const;
        // The first second teaches the controller what the GPU can do.
        await turn(page, at, 2000);
        const { intervals, costs, scales }: Turned = await turn(page, at, quick ? 2000 : 5000);
        figures.push(
          timed(
            `${size}: frame to frame while turning`,
            'ms',
            intervals,
            gpu === 'hardware' ? { value: 1000 / 60 + 1, relation: '<=', source: '60 frames a second' } : undefined,
          ),
          {
            name: `${size}: frame to frame, 95 of 100`,
            unit: 'ms',
            runs: intervals.length,
            median: quantile(intervals, 0.95),
          },
          timed(`${size}: from a frame's start until the GPU has drawn it`, 'ms', costs),
          timed(`${size}: width of the film over that of the canvas`, '1', scales),
        );
        const waits: number[] = [];
        for (let i = 0; i < (quick ? 4 : 10); i++) waits.push(await latency(page, at, 700 + 37 * i));
        figures.push(
          timed(
            `${size}: from a pointer movement to its image`,
            'ms',
            waits,
            gpu === 'software' ? { value: 100, relation: '<=', source: 'interaction on a software GPU' } : undefined,
          ),
        );
        log(
          `${size} on ${adapter}: ${quantile(intervals, 0.5).toFixed(1)} ms a frame at ${quantile(scales, 0.5).toFixed(2)} of the width, latency ${quantile(waits, 0.5).toFixed(0)} ms`,
        );
        await page.close();
      }
    } finally {
      await browser.close();
      await server.close();
    }
    return {
      settings: {
        model: 'push-button',
        browser: `Chromium ${browser.version()}, headless`,
        input: 'a drag, 60 movements a second',
        clock: "the page's: from a pointer event's time to the end of the GPU's work for the frame that follows it",
      },
      gpu: { name: adapter, software: gpu === 'software' },
      figures,
      notes: ['what the compositor and a screen add is not in the figures'],
    };
  },
};
