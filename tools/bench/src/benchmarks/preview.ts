import { setTimeout as wait } from 'node:timers/promises';
import { createPushButton } from '@glanz/models';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { createViewer, type Viewer } from '@glanz/viewer';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { makeScreen, SCREEN_MS } from '../preview/screen';

/** Sizes of the image, pixels. */
const SIZES = [
  [640, 360],
  [1280, 720],
  [1920, 1080],
] as const;

interface Orbited {
  /** Milliseconds from one frame on the canvas to the next. */
  readonly intervals: number[];
  /** Milliseconds that the samples of a frame took. */
  readonly costs: number[];
  /** Width of the preview over that of the image, each frame. */
  readonly scales: number[];
}

/** Orbits for a while as a user does, an event for each frame of the screen. */
async function orbit(viewer: Viewer, milliseconds: number, width: number): Promise<Orbited> {
  const result: Orbited = { intervals: [], costs: [], scales: [] };
  let last: number | undefined;
  const off = viewer.on('frame', (frame) => {
    if (!frame.preview) return;
    const now = performance.now();
    if (last !== undefined) result.intervals.push(now - last);
    last = now;
    result.costs.push(frame.milliseconds);
    result.scales.push(frame.width / width);
  });
  const end = performance.now() + milliseconds;
  while (performance.now() < end) {
    viewer.setOrbit({ theta: (viewer.orbit?.theta ?? 0) + 0.02 });
    await wait(SCREEN_MS);
  }
  off();
  return result;
}

const done = (viewer: Viewer) =>
  new Promise<void>((resolve) => void viewer.on('converged', () => resolve(), { once: true }));
const nextFrame = (viewer: Viewer) =>
  new Promise<void>((resolve) => void viewer.on('frame', () => resolve(), { once: true }));

/** How long it takes from a pointer movement to its image, at rest and while refining. */
async function latency(viewer: Viewer, device: GPUDevice, rest: number): Promise<number> {
  await wait(rest);
  const from = performance.now();
  viewer.setOrbit({ theta: (viewer.orbit?.theta ?? 0) + 0.1 }, { immediate: true });
  await nextFrame(viewer);
  await device.queue.onSubmittedWorkDone();
  return performance.now() - from;
}

const spread = (values: readonly number[]) => [...values].sort((a, b) => a - b);
const quantile = (values: readonly number[], q: number) =>
  spread(values)[Math.min(values.length - 1, Math.floor(q * values.length))] as number;

/** The viewer's preview while the user orbits: frame times, resolution, and how soon a movement is seen. */
export const benchmark: Benchmark = {
  description:
    'the preview of the viewer while orbiting: frames, resolution, and latency, on a screen of 60 frames a second',
  async run({ log, quick, gpu: requested }) {
    const { gpu, adapterName, software } = await createGpu(requested ? { gpu: requested } : {});
    const figures: Figure[] = [];
    for (const [width, height] of quick ? SIZES.slice(0, 1) : SIZES) {
      const { canvas, close } = makeScreen(gpu, width, height);
      let viewer: Viewer | undefined;
      try {
        viewer = createViewer(canvas, {
          pixelRatio: 1,
          samples: 100_000,
          controls: false,
          requestDevice: () => requestDevice({ gpu }),
        });
        viewer.on('error', ({ message }) => log(message));
        await viewer.load(createPushButton({ level: 'medium' }));
        const device = viewer.device as GPUDevice;
        const size = `${width} × ${height}`;
        // The first second teaches the controller what the GPU can do.
        await orbit(viewer, quick ? 1500 : 2000, width);
        const { intervals, costs, scales } = await orbit(viewer, quick ? 3000 : 5000, width);
        figures.push(
          timed(
            `${size}: frame to frame while orbiting`,
            'ms',
            intervals,
            software ? undefined : { value: 1000 / 60 + 1, relation: '<=', source: '60 frames a second' },
          ),
        );
        figures.push({
          name: `${size}: frame to frame, 95 of 100`,
          unit: 'ms',
          runs: intervals.length,
          median: quantile(intervals, 0.95),
        });
        figures.push(timed(`${size}: samples of a frame`, 'ms', costs));
        figures.push(timed(`${size}: width of the preview over that of the image`, '1', scales));
        const starts: number[] = [];
        for (let i = 0; i < (quick ? 8 : 10); i++) starts.push(await latency(viewer, device, 700 + 37 * i));
        figures.push(
          timed(
            `${size}: from a movement to its image, in the midst of refining`,
            'ms',
            starts,
            software && width === 640
              ? { value: 100, relation: '<=', source: 'interaction on a software GPU' }
              : undefined,
          ),
        );
        viewer.samples = 1;
        viewer.setOrbit({ theta: 0 }, { immediate: true });
        const resting: number[] = [];
        for (let i = 0; i < (quick ? 1 : 5); i++) {
          if (viewer.state !== 'done') await done(viewer);
          resting.push(await latency(viewer, device, 100));
        }
        figures.push(timed(`${size}: from a movement to its image, at rest`, 'ms', resting));
        log(
          `${size}: ${quantile(intervals, 0.5).toFixed(1)} ms a frame at ${quantile(scales, 0.5).toFixed(2)} of the width, latency ${quantile(starts, 0.5).toFixed(0)} ms`,
        );
      } finally {
        viewer?.destroy();
        // Its loop takes a turn to end, and asks the window until then.
        await wait(50);
        close();
      }
    }
    return {
      settings: {
        model: 'push-button medium',
        environment: 'studio',
        maxDepth: 8,
        previewDepth: 4,
        budgetMs: 12,
        screen: '60 Hz, made of timers',
      },
      gpu: { name: adapterName, software },
      figures,
      notes: ['frames are drawn to a texture in place of a canvas: what a compositor adds is not in the figures'],
    };
  },
};
