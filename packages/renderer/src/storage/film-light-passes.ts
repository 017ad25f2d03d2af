import { wgslModule, type WgslModule } from '@glanz/wgsl';

/**
 * The light passes that paths carry and the film keeps, see `path.wesl`: `FILM_PASSES`, their number, and
 * `FILM_GROUPS`, that of the light groups.
 */
export const filmLightPasses = (lightPasses: number, catcher: boolean): WgslModule =>
  wgslModule(
    'renderer/film-passes',
    `const FILM_PASSES=${lightPasses}u;const FILM_GROUPS=${catcher ? lightPasses / 4 : lightPasses}u;`,
  );
