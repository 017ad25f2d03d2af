import {
  DeviceError,
  PathTracer,
  requestDevice,
  type FilmState,
} from '@glanz/renderer';
import {
  decodeFilmState,
  encodeFilmState,
  mergeFilmStates,
  readFilmState,
} from '@glanz/renderer/film';
import type { Scene } from '@glanz/scene';

// #region progress
export async function render(
  tracer: PathTracer,
  report: (text: string) => void,
) {
  for await (const {
    samples,
    targetSamples,
    samplesPerSecond,
    remainingMs,
  } of tracer.render({ samples: 512 })) {
    const speed = samplesPerSecond.toFixed(1);
    const seconds = Math.ceil(remainingMs / 1000);
    report(`${samples}/${targetSamples}, ${speed} a second, ${seconds} s left`);
  }
}
// #endregion progress

// #region noise
export async function untilGood(
  tracer: PathTracer,
  report: (text: string) => void,
) {
  for await (const { noise, active, remainingMs } of tracer.render({
    noise: 0.01,
    samples: 4096,
  })) {
    if (noise === undefined) continue;
    const percent = (100 * noise).toFixed(1);
    const left = Math.round(100 * active);
    const seconds = Math.ceil(remainingMs / 1000);
    report(`noise ${percent} %, ${left} % of the image left, ${seconds} s`);
  }
}
// #endregion noise

// #region abort
export function renderUntilClicked(
  tracer: PathTracer,
  stop: HTMLButtonElement,
) {
  const abort = new AbortController();
  stop.addEventListener('click', () => abort.abort(), { once: true });
  return (async () => {
    for await (const _ of tracer.render({
      samples: 4096,
      signal: abort.signal,
    }));
    return tracer.read('beauty'); // the samples so far: an abort is no error
  })();
}
// #endregion abort

// #region edits
/**
 * Renders until the page is closed; edits restart the film, and the loop
 * continues with it.
 */
export async function keepRendering(
  tracer: PathTracer,
  signal: AbortSignal,
  draw: () => void,
) {
  while (!signal.aborted) {
    for await (const _ of tracer.render({ samples: 256, signal })) draw();
    if (tracer.samples >= 256)
      await new Promise((resolve) => setTimeout(resolve, 50));
  }
}
// #endregion edits

// #region film
export async function save(tracer: PathTracer): Promise<Uint8Array> {
  return encodeFilmState(await tracer.saveFilm());
}

export async function resume(tracer: PathTracer, bytes: Uint8Array) {
  await tracer.restoreFilm(decodeFilmState(bytes));
  for await (const _ of tracer.render({ samples: 1024 }));
}
// #endregion film

// #region merge
/** One of several workers: `count` samples, from `firstSample` on. */
export async function renderRange(
  tracer: PathTracer,
  firstSample: number,
  count: number,
) {
  tracer.reset({ firstSample });
  for await (const _ of tracer.render({ samples: count }));
  return encodeFilmState(await tracer.saveFilm());
}

/** Linear RGBA of all samples. */
export function mergedImage(films: readonly Uint8Array[]) {
  const merged = mergeFilmStates(films.map(decodeFilmState));
  return readFilmState(merged, 'beauty');
}
// #endregion merge

// #region lost
export async function renderThroughLosses(
  scene: Scene,
  size: { width: number; height: number },
  draw: (tracer: PathTracer) => void,
) {
  let saved: FilmState | undefined;
  for (let attempt = 0; ; attempt++) {
    const device = await requestDevice();
    try {
      const tracer = await PathTracer.create(device, scene, size);
      if (saved) await tracer.restoreFilm(saved);
      for await (const { samples } of tracer.render({ samples: 256 })) {
        draw(tracer);
        // Twice as many samples as at the last copy: few copies, and at most
        // half of the work is lost.
        if (samples >= 2 * (saved?.samples ?? 8))
          saved = await tracer.saveFilm();
      }
      return await tracer.read('beauty');
    } catch (error) {
      const lost =
        error instanceof DeviceError && error.code === 'renderer/device-lost';
      if (!lost || attempt === 2) throw error;
    } finally {
      device.destroy();
    }
  }
}
// #endregion lost

// #region edit-kinds
export async function rearrange(tracer: PathTracer) {
  await tracer.setInstanceTransform(
    'lid',
    [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.2, 0, 1],
  ); // all instances of that name
  await tracer.setVisibility('packaging', false);
  await tracer.setLight('key', { intensity: 40 });
  await tracer.adjustEnvironment({ rotation: Math.PI / 2 });
  await tracer.setVariant('matt black');
}
// #endregion edit-kinds
