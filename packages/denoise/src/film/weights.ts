import type { DenoiseQuality, FilmWeights } from './options';

/**
 * The archives of each quality, by their names in `@glanz/denoise-weights` and in Open Image Denoise.
 *
 * @example
 * const { color } = FILM_WEIGHTS.fast;
 * const denoiser = await FilmDenoiser.create(device, { color: await readWeights(color) });
 */
export const FILM_WEIGHTS = {
  fast: { color: 'rt_hdr_alb_nrm_small' },
  balanced: { color: 'rt_hdr_alb_nrm' },
  best: { color: 'rt_hdr_calb_cnrm_large', albedo: 'rt_alb_large', normal: 'rt_nrm_large' },
} as const satisfies Readonly<Record<DenoiseQuality, FilmWeights<string>>>;

/** The qualities, from the fastest to the best. */
export const DENOISE_QUALITIES = Object.keys(FILM_WEIGHTS) as readonly DenoiseQuality[];
