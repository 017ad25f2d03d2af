/**
 * The effect of an edit on the samples of the film.
 * - `keeps`: they are of the same image; the film goes on.
 * - `reprojects`: the same surfaces are seen from elsewhere, in another resolution, or have moved; the film begins again,
 *   and the frame before stays known as history.
 * - `invalidates`: surfaces or lights look different, or there are others; the film begins again without history.
 */
export type EditEffect = 'keeps' | 'reprojects' | 'invalidates';

/** An instance that has moved. */
export interface Move {
  /** Index in `Scene.instances`. */
  readonly index: number;
  /** Transforms to the world, column-major. */
  readonly before: ArrayLike<number>;
  readonly after: ArrayLike<number>;
}
