export { FilmDenoiser } from './film-denoiser';
export { DENOISE_QUALITIES, FILM_WEIGHTS } from './weights';
export type {
  DenoisableTracer,
  DenoisedFilm,
  DenoiseFilmOptions,
  DenoiseQuality,
  FilmDenoiserOptions,
  FilmImages,
  FilmWeights,
} from './options';
