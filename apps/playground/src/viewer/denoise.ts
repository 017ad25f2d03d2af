import { smallUrl } from '@glanz/denoise-weights/small';
import { denoising as denoisingBy } from '@glanz/viewer/denoise';
import type { Context } from '../ui/context';

/** The weights of the small network, fetched once. */
let weights: Promise<ArrayBuffer> | undefined;

async function fetchWeights(): Promise<ArrayBuffer> {
  try {
    const response = await fetch(smallUrl());
    if (!response.ok) throw new Error(`The denoiser’s weights cannot be fetched: status ${response.status}.`);
    return await response.arrayBuffer();
  } catch (error) {
    // Switched on again, it tries again.
    weights = undefined;
    throw error;
  }
}

/** The denoiser of the pages. Its kernels and weights are fetched when an image has its first sample. */
export const denoising = denoisingBy(async (device) => {
  const [{ FilmDenoiser }, color] = await Promise.all([import('@glanz/denoise/film'), (weights ??= fetchWeights())]);
  return FilmDenoiser.create(device, { color });
});

/** Switches the denoiser of the playground's image and the filter of its previews on or off, as the state says by now. */
export function applyDenoise({ session: { engine }, store, say }: Context): void {
  const { settings } = engine;
  const denoise = store.state.denoise ? denoising : undefined;
  settings.previewMode = denoise ? 'auto' : 'raw';
  if (denoise === settings.denoise?.source) return;
  settings.denoise?.destroy();
  settings.denoise = denoise?.(
    ({ message }) => say(message),
    () => engine.device,
  );
  engine.redraw();
}
