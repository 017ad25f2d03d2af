/**
 * What an edit does to the samples that the film has.
 * - `keeps`: they are of the same image; the film goes on.
 * - `reprojects`: the same surfaces are seen from elsewhere or have moved; the film begins again, and the frame before is
 *   kept as history.
 * - `invalidates`: surfaces look different; the film begins again.
 */
export type EditEffect = 'keeps' | 'reprojects' | 'invalidates';
