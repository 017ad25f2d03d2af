import { setTimeout as wait } from 'node:timers/promises';
import type { Page } from 'playwright';

/** What a canvas showed during a drag, by the page's clock. */
export interface Turned {
  /** Milliseconds from one frame's call for the canvas to the next. */
  readonly intervals: number[];
  /** Milliseconds from that call until the GPU had done what the frame asked of it. */
  readonly costs: number[];
  /** Width of the film over that of the canvas, each frame. */
  readonly scales: number[];
}

interface Frame {
  readonly at: number;
  done?: number;
  readonly scale: number;
}

/** What {@link watchFrames} leaves in the page. */
interface Seen {
  readonly frames: Frame[];
  /** The latest pointer movement, by the same clock as frames. */
  moved: number;
}

/**
 * Has the page note each frame that it draws to a canvas, and when the GPU was done with it. Call before it is opened.
 */
export async function watchFrames(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const seen: Seen = { frames: [], moved: 0 };
    Object.assign(globalThis, { seen });
    addEventListener('pointermove', (event) => (seen.moved = event.timeStamp), true);
    let open: Frame | undefined;
    const { getCurrentTexture } = GPUCanvasContext.prototype;
    GPUCanvasContext.prototype.getCurrentTexture = function () {
      const { dataset, width } = this.canvas as HTMLCanvasElement;
      open = { at: performance.now(), scale: Number(dataset['film']?.split(' ')[0] ?? width) / width };
      seen.frames.push(open);
      return getCurrentTexture.call(this);
    };
    const { submit } = GPUQueue.prototype;
    GPUQueue.prototype.submit = function (commands) {
      submit.call(this, commands);
      const frame = open;
      open = undefined;
      if (frame) void this.onSubmittedWorkDone().then(() => (frame.done = performance.now()));
    };
  });
}

const clear = (page: Page) =>
  page.evaluate(() => (globalThis as unknown as { seen: Seen }).seen.frames.splice(0).length);
const frames = (page: Page) => page.evaluate(() => (globalThis as unknown as { seen: Seen }).seen);

/** Turns the model by a drag of some time, one movement for each frame of a screen. */
export async function turn(page: Page, at: readonly [x: number, y: number], milliseconds: number): Promise<Turned> {
  const [x, y] = at;
  await page.mouse.move(x, y);
  await page.mouse.down();
  // The first frames are those of an image that comes to move.
  await page.mouse.move(x + 2, y, { steps: 2 });
  await wait(200);
  await clear(page);
  const begun = performance.now();
  for (let i = 0; performance.now() - begun < milliseconds; i++) {
    const from = performance.now();
    await page.mouse.move(x + 60 * Math.sin(i / 40), y + 10 * Math.sin(i / 25));
    await wait(Math.max(0, 1000 / 60 - (performance.now() - from)));
  }
  const { frames: drawn } = await frames(page);
  await page.mouse.up();
  const settled = drawn.filter(({ done }) => done !== undefined);
  return {
    intervals: settled.slice(1).map(({ at: now }, i) => now - settled[i]!.at),
    costs: settled.map(({ at: now, done }) => done! - now),
    scales: settled.map(({ scale }) => scale),
  };
}

/** Milliseconds from a pointer movement, at rest, until the GPU has drawn the first image that follows it. */
export async function latency(page: Page, at: readonly [x: number, y: number], rest: number): Promise<number> {
  const [x, y] = at;
  await page.mouse.move(x, y);
  await page.mouse.down();
  await wait(rest);
  await page.mouse.move(x + 12, y);
  try {
    const found = await page.waitForFunction(
      () => {
        const { frames, moved } = (globalThis as unknown as { seen: Seen }).seen;
        const frame = frames.find(({ at: when, done }) => when >= moved && done !== undefined);
        return frame ? frame.done! - moved : undefined;
      },
      undefined,
      { polling: 20, timeout: 30_000 },
    );
    return Number(await found.jsonValue());
  } finally {
    await page.mouse.up();
  }
}
