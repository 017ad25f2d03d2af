import { FilmDenoiser } from '@glanz/denoise/film';
import { smallUrl } from '@glanz/denoise-weights/small';

/** What the page's thread did during a stage, milliseconds by the clock. */
export interface Stage {
  readonly name: string;
  /** Tasks of 50 ms and more, as the browser reports them. */
  readonly longTasks: readonly number[];
  /** The longest time between two messages that the page sent itself. */
  readonly longestGap: number;
  readonly ms: number;
}

const wait = (ms: number) => new Promise((resolve) => setTimeout(resolve, ms));

async function staged<T>(name: string, stages: Stage[], work: () => Promise<T>): Promise<T> {
  const longTasks: number[] = [];
  const observer = new PerformanceObserver((list) =>
    longTasks.push(...list.getEntries().map(({ duration }) => duration)),
  );
  observer.observe({ type: 'longtask' });
  const { port1, port2 } = new MessageChannel();
  let running = true;
  let longestGap = 0;
  let last = performance.now();
  port1.onmessage = () => {
    const now = performance.now();
    longestGap = Math.max(longestGap, now - last);
    last = now;
    // Not at once, or the page would do nothing else.
    if (running) setTimeout(() => port2.postMessage(0), 1);
  };
  port2.postMessage(0);
  const started = performance.now();
  const result = await work();
  const ms = performance.now() - started;
  // The browser reports a task after its end.
  await wait(200);
  running = false;
  observer.disconnect();
  stages.push({ name, longTasks, longestGap, ms });
  return result;
}

/** Denoises a film of noise with its variance: makes the denoiser, an image that compiles shaders, and others. */
async function denoise(width: number, height: number, images: number): Promise<{ adapter: string; stages: Stage[] }> {
  const adapter = (await navigator.gpu.requestAdapter())!;
  const device = await adapter.requestDevice();
  const image = async (fill: (i: number) => number) => {
    const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC | GPUBufferUsage.COPY_DST;
    const buffer = device.createBuffer({ size: 16 * width * height, usage });
    device.queue.writeBuffer(
      buffer,
      0,
      Float32Array.from({ length: 4 * width * height }, (_, i) => fill(i)),
    );
    await device.queue.onSubmittedWorkDone();
    return buffer;
  };
  const film = {
    width,
    height,
    color: await image(Math.random),
    albedo: await image(() => 0.5),
    normal: await image((i) => (i % 4 === 2 ? 1 : 0)),
    variance: await image(() => 0.08),
  };
  const weights = await (await fetch(smallUrl())).arrayBuffer();
  const stages: Stage[] = [];
  await wait(500);
  const denoiser = await staged('creation', stages, () => FilmDenoiser.create(device, { color: weights }));
  await staged('first image', stages, () => denoiser.denoise(film));
  for (let i = 0; i < images; i++) await staged('image', stages, () => denoiser.denoise(film));
  const { vendor, architecture, device: name, description } = adapter.info;
  device.destroy();
  return { adapter: [vendor, architecture, name, description].filter(Boolean).join(' '), stages };
}

Object.assign(globalThis, { denoise });
