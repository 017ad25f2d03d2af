import { fileURLToPath } from 'node:url';
import { quads, servePage, watch, type Served } from '@glanz/browser';
import { expect, test, type Page } from '@playwright/test';
import type { PreviewMode } from '@glanz/viewer';
import { front, sky } from './open';

let served: Served;
test.beforeAll(async () => void (served = await servePage(fileURLToPath(new URL('page', import.meta.url)))));
test.afterAll(() => served.close());
test.use({ viewport: { width: 640, height: 480 } });

let complaints: string[] = [];
test.beforeEach(({ page }) => void (complaints = watch(page, served.origin)));
test.afterEach(() => expect(complaints).toEqual([]));

// Two walls in a half-shadow of a third one, whose light is noisy.
const shadowed = quads([
  { name: 'left', colour: [0.9, 0.02, 0.02], at: [-1.2, 0, 0] },
  { name: 'right', colour: [0.02, 0.8, 0.02], at: [1.2, 0, 0] },
  { name: 'front', colour: [0.5, 0.5, 0.5], at: [0, 0, 0.7] },
]).toString('base64');
const options = {
  maxDepth: 3,
  camera: front!,
  environment: sky,
  controls: false,
  pixelRatio: 0.25,
  samples: 8,
  damping: 0,
};

/** What a viewer has shown on its way through a turn, and where it came to rest. */
interface Turn {
  /** Of each frame while the view moved: whether it was filtered. */
  readonly frames: boolean[];
  /** Codes of the last frame that moved, RGBA, and of the same view after 128 samples, if it was filtered. */
  readonly moving: number[];
  readonly final: number[];
  readonly width: number;
  readonly film: number[];
  readonly samples: number;
}

/** Turns the view back and forth, if asked to, then to its final place, where it rests. */
const turn = (page: Page, mode: PreviewMode, turns: boolean): Promise<Turn> =>
  page.evaluate(
    async ([bytes, given, preview, steps]) => {
      // The window holds it, as in other tests: without that this promise was once collected before it was settled.
      const viewer = (window.viewer = window.make({
        ...given,
        preview: { mode: preview, budgetMs: 1000, settleMs: 0 },
      }));
      const codes = () => {
        const { width, height } = viewer.canvas;
        const context = new OffscreenCanvas(width, height).getContext('2d')!;
        context.drawImage(viewer.canvas, 0, 0);
        return [...context.getImageData(0, 0, width, height).data];
      };
      const frames: boolean[] = [];
      let [moving, final]: [number[], number[]] = [[], []];
      const until = async (met: () => boolean) => {
        for (let i = 0; !met() && i < 3000; i++) await new Promise((resolve) => setTimeout(resolve, 10));
        if (!met()) throw new Error(`the viewer is ${viewer.state}, after ${frames.length} frames`);
      };
      // A frame is left out where kernels that come restart its film.
      const step = async (theta: number) => {
        const seen = frames.length;
        viewer.setOrbit({ theta }, { immediate: true });
        for (let i = 0; frames.length === seen && i < 100; i++) await new Promise((resolve) => setTimeout(resolve, 10));
      };
      await viewer.load(window.file(bytes, 'model.glb'));
      await until(() => viewer.state === 'done');
      let whole = false;
      viewer.on('frame', ({ preview: moves, denoised, width }) => {
        if (!moves) final = codes();
        if (!moves) return;
        frames.push(denoised);
        // Smaller ones come first: the frame rate is not known yet.
        whole = width === viewer.canvas.width;
        moving = codes();
      });
      // Until frames are whole and the filter has come, and a few more.
      let good = 0;
      const end = performance.now() + 60_000;
      for (let i = 0; steps && good < 8; i++) {
        // However many frames there are while it is compiled.
        if (performance.now() > end) throw new Error('the filter has not come');
        await step(0.2 + 0.002 * (i % 50));
        if (whole && (preview === 'raw' || frames.at(-1))) good++;
      }
      await step(0.3);
      await until(() => viewer.state === 'done');
      const film = [...(await viewer.tracer!.read('beauty'))];
      const { sampleCount } = viewer;
      if (preview === 'filtered') viewer.samples = 128;
      await until(() => viewer.state === 'done' && viewer.sampleCount === viewer.samples);
      await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
      const result = {
        frames,
        moving,
        final,
        width: viewer.canvas.width,
        film,
        samples: sampleCount,
      };
      viewer.destroy();
      return result;
    },
    [shadowed, options, mode, turns] as const,
  );

test('frames of a moving view have less noise, and the image at rest is that of a view that never moved', async ({
  page,
}) => {
  await page.goto(served.origin);
  const still = await turn(page, 'raw', false);
  const raw = await turn(page, 'raw', true);
  const filtered = await turn(page, 'filtered', true);
  expect(raw.frames.some(Boolean)).toBe(false);
  expect(filtered.frames.slice(-4)).toEqual([true, true, true, true]);
  for (const { film, samples } of [raw, filtered]) {
    expect(samples).toBe(8);
    expect(film).toEqual(still.film);
  }
  // On the walls, away from their edges.
  const { final, width } = filtered;
  const error = ({ moving }: Turn) => {
    let [sum, count] = [0, 0];
    for (let i = 4 * (width + 1); i < final.length - 4 * (width + 1); i++) {
      const around = [-4 * width, -4, 4, 4 * width].map((step) => Math.abs(final[i]! - final[i + step]!));
      if (i % 4 === 3 || final[i]! < 20 || final[i]! > 240 || Math.max(...around) > 3) continue;
      sum += (moving[i]! - final[i]!) ** 2;
      count++;
    }
    expect(count).toBeGreaterThan(500);
    return Math.sqrt(sum / count);
  };
  // A small film has up to 8 samples a frame, so there is little noise to take.
  expect(error(filtered)).toBeLessThan(0.85 * error(raw));
});

test('the mode can be changed while the view moves, and software adapters show raw frames by default', async ({
  page,
}) => {
  await page.goto(served.origin);
  const { modes, frames, film, expected } = await page.evaluate(
    async ([bytes, given]) => {
      const viewer = window.make({ ...given, preview: { budgetMs: 1000 } });
      const frames: boolean[] = [];
      viewer.on('frame', ({ preview, denoised }) => void (preview && frames.push(denoised)));
      const until = async (met: () => boolean) => {
        for (let i = 0; !met() && i < 3000; i++) await new Promise((resolve) => setTimeout(resolve, 10));
        if (!met()) throw new Error(`the viewer is ${viewer.state}, after ${frames.length} frames`);
      };
      const step = async (theta: number) => {
        const seen = frames.length;
        viewer.setOrbit({ theta }, { immediate: true });
        for (let i = 0; frames.length === seen && i < 100; i++) await new Promise((resolve) => setTimeout(resolve, 10));
      };
      await viewer.load(window.file(bytes, 'model.glb'));
      await until(() => viewer.state === 'done');
      const modes = [viewer.previewMode];
      for (let i = 0; i < 12; i++) await step(0.01 * i);
      const auto = frames.splice(0);
      viewer.previewMode = 'filtered';
      modes.push(viewer.previewMode);
      const end = performance.now() + 60_000;
      const inTime = () => performance.now() < end;
      for (let i = 0; !frames.at(-1) && inTime(); i++) await step(0.2 + 0.002 * (i % 50));
      const filtered = frames.splice(0).at(-1);
      viewer.previewMode = 'raw';
      // The first one may have been on its way; kernels of the others may take long to come.
      for (let i = 0; frames.length < 2 && inTime(); i++) await step(-0.02 - 0.01 * (i % 50));
      const raw = frames.at(-1);
      await until(() => viewer.state === 'done');
      const film = [...(await viewer.tracer!.read('beauty'))];
      // The same view without a movement before it.
      viewer.tracer!.reset({ firstSample: 0 });
      for await (const progress of viewer.tracer!.render({ samples: viewer.samples })) void progress;
      const expected = [...(await viewer.tracer!.read('beauty'))];
      viewer.destroy();
      return { modes, frames: { auto: auto.some(Boolean), filtered, raw }, film, expected };
    },
    [shadowed, options] as const,
  );
  expect(modes).toEqual(['auto', 'filtered']);
  expect(frames).toEqual({ auto: false, filtered: true, raw: false });
  expect(film).toEqual(expected);
});

test('modes that there are not are refused', async ({ page }) => {
  await page.goto(served.origin);
  const codes = await page.evaluate(() => {
    const codeOf = (call: () => unknown) => {
      try {
        call();
        return 'none';
      } catch (error) {
        return (error as { code: string }).code;
      }
    };
    const viewer = window.make({ preview: 'raw' });
    const mode = viewer.previewMode;
    const codes = [
      codeOf(() => window.make({ preview: 'smooth' as never })),
      codeOf(() => window.make({ preview: { mode: 1 as never } })),
      codeOf(() => (viewer.previewMode = 'none' as never)),
    ];
    viewer.destroy();
    return [mode, ...codes];
  });
  expect(codes).toEqual(['raw', 'viewer/option', 'viewer/option', 'viewer/option']);
});
