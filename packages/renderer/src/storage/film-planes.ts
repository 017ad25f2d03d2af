import { wgslModule, type WgslModule } from '@glanz/wgsl';

/**
 * The sums of light that paths carry and the film keeps, see `path.wesl`: `FILM_PLANES`, their number, and
 * `FILM_GROUPS`, that of the light groups.
 */
export const filmPlanes = (planes: number, catcher: boolean): WgslModule =>
  wgslModule(
    'renderer/film-planes',
    `const FILM_PLANES=${planes}u;const FILM_GROUPS=${catcher ? planes / 4 : planes}u;`,
  );
