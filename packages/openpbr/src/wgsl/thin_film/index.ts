import { gated, wgslModule, type WgslModule } from '@glanz/wgsl/module';
import film from './film.wesl';
import filmSums from './film_sums.wesl';

/**
 * A thin film on the base, below the coat: compose it with `openpbr` where the flag OPENPBR_THIN_FILM is set,
 * that is, where materials have one. It is a module of its own so that hosts can load it then.
 *
 * Waves reflected by the film's two faces interfere; Airy's sum, with all its orders and unpolarised, replaces the
 * Fresnel factor, by the coverage. Below it lies the dielectric, or metal of a complex index by its reflectance and edge
 * tint (Gulbrandsen 2014).
 *
 * For a band of Lorentzian shape over wavenumbers the spectrum's integral is Airy's sum with a reflection that fades with
 * the path, in closed form: four such bands of complex weights stand for the visible spectrum, and give red, green and
 * blue, with no aliasing however thick the film. From inside, light beyond the critical angle is reflected whatever the
 * film.
 */
export const openpbrFilm: WgslModule = /* @__PURE__ */ wgslModule('openpbr/film-and-sums', '', [
  film,
  /* @__PURE__ */ gated('OPENPBR_DIELECTRIC', filmSums),
]);
