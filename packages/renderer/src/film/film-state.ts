import type { SamplingState } from '../schedule/sampling';
import type { GroupWeights } from './layers';

/** The film's buffers that a {@link FilmState} holds, with vec4f per pixel: `lightPasses` of them, or one. */
export const FILM_SUMS = ['film_block', 'film_total', 'film_moment', 'beauty'] as const;

/** The samples of one chunk of 16, of which a film has a part. */
export interface FilmPart {
  /** The number of its first sample, divided by 16. */
  readonly chunk: number;
  /** Laid out like `film_total`, which contains them too. */
  readonly sums: Float32Array<ArrayBuffer>;
}

/**
 * The accumulated film and the state of its sampling, which `PathTracer.saveFilm()` returns and
 * `PathTracer.restoreFilm()` accepts. Plain data: it can be posted to a worker, kept while a device is replaced,
 * written to a file with `encodeFilmState`, or merged with films of other samples by `mergeFilmStates` of
 * `@glanz/renderer/film`.
 */
export interface FilmState {
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  /** Completed samples per pixel; after sampling to a noise target, those of the pixels that have most. */
  readonly samples: number;
  /**
   * The numbers of these samples: ranges from the first to the one after the last, in ascending order, with gaps
   * between them. A tracer makes one range; only merged films have more.
   */
  readonly ranges: readonly (readonly [first: number, end: number])[];
  /** Samples that were dropped because they were NaN, infinite or negative. */
  readonly badSamples: number;
  /** Light passes, which are sums of their own: one for each light group, four for each with catchers. */
  readonly lightPasses: number;
  /** Hash of the options, the camera and the scene that the samples are of. */
  readonly fingerprint: string;
  /** State from which sampling continues. */
  readonly sampling: SamplingState;
  /** Weights of the light groups when the film was begun, which its variance is of, and when it was saved. */
  readonly weights: { readonly first: GroupWeights; readonly last: GroupWeights };
  /** Chunks of which samples are missing, in ascending order, except the one that `film_block` holds. */
  readonly parts: readonly FilmPart[];
  /** The film's buffers, RGBA, stride 4, row-major, top row first; `film_block` and `film_total` one light pass after another. */
  readonly sums: Readonly<Record<(typeof FILM_SUMS)[number], Float32Array<ArrayBuffer>>>;
}
