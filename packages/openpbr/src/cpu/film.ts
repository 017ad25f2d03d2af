import type { OpenPbrColor, OpenPbrParameters, OpenPbrVector } from '../parameters/index';
import { conductorLoss } from './energy';
import { dielectricEpsilon, fresnelDielectric } from './fresnel';
import { ggxSample, ggxMasking, ggxMaskingShadowing, ggxRoughness, type Slopes } from './ggx';
import { clamp, dot, length2, rgb } from './vector';
import { FILM_BANDS, type FilmBands } from '../tables/film';
import { OPENPBR_FILM_FACETS, OPENPBR_FILM_FACET_ENDS } from '../tables/film_facets.wesl';

const mix = (a: number, b: number, t: number): number => a * (1 - t) + b * t;

/**
 * A thin film between two media; twin of the WGSL struct `OpenPbrFilm`. Indices are relative to the outside of the
 * object.
 */
export interface Film {
  /** Coverage. */
  readonly weight: number;
  /** Index of refraction of the film, of what lies on it (air or coat), and of the dielectric below. */
  readonly index: number;
  readonly outer: number;
  readonly base: number;
  /** Optical path through the film and back, in µm, over the cosine and the index. */
  readonly path: number;
  /**
   * Square of the tangential part of the wave's vector for light along the surface: outside, and on the viewer's side.
   * The film never reflects all light only because the coat on it is denser: light that it would do so to does not get
   * into the coat.
   */
  readonly grazing: number;
  readonly viewer: number;
  readonly bands: FilmBands;
}

/** A complex index of refraction. */
export type ComplexIndex = readonly [n: number, k: number];

/**
 * The film of a surface; twin of `openpbr_film_prepare`.
 *
 * @param p The parameters with indices relative to what is outside.
 * @param outerIor Index of refraction of that.
 * @param wavelengths Three wavelengths in nm, one for each channel, instead of the visible spectrum.
 */
export function prepareFilm(
  p: OpenPbrParameters,
  outerIor: number,
  inside: boolean,
  wavelengths?: readonly [number, number, number],
): Film {
  const outer = mix(1, p.coat_ior, p.coat_weight);
  const epsilon = dielectricEpsilon(p.specular_ior / outer, p.specular_weight);
  const base = (outer * (1 + epsilon)) / (1 - epsilon);
  const bands = wavelengths
    ? {
        wavenumbers: wavelengths.map((nm) => 1000 / nm),
        width: 0,
        weights: [
          [1, 0, 0],
          [0, 1, 0],
          [0, 0, 1],
        ],
        sines: [
          [0, 0, 0],
          [0, 0, 0],
          [0, 0, 0],
        ],
      }
    : FILM_BANDS;
  const index = p.thin_film_ior / outerIor;
  const grazing = Math.min(outer, index) ** 2;
  // Too thin to be seen: it fades, and metal below it goes back to the tint that it has without.
  return {
    weight: p.thin_film_weight * Math.min(p.thin_film_thickness / 0.01, 1),
    index,
    outer,
    base,
    path: 2 * p.thin_film_thickness * outerIor,
    grazing,
    viewer: inside ? base * base : grazing,
    bands,
  };
}

/**
 * The complex index of a metal by its reflectance at normal incidence and its edge tint (Gulbrandsen 2014); twin of
 * `openpbr_film_metal`.
 */
export function metalIndex(reflectance: number, edge: number): ComplexIndex {
  const r = clamp(reflectance, 0, 0.999);
  const root = Math.sqrt(r);
  const n = mix((1 + root) / (1 - root), (1 - r) / (1 + r), edge);
  return [n, Math.sqrt(Math.max((r * (n + 1) ** 2 - (n - 1) ** 2) / (1 - r), 0))];
}

type Complex = readonly [re: number, im: number];
const ratio = (a: Complex, b: Complex): Complex => {
  const d = b[0] * b[0] + b[1] * b[1];
  return [(a[0] * b[0] + a[1] * b[1]) / d, (a[1] * b[0] - a[0] * b[1]) / d];
};

/**
 * Reflectance of a film on a base (Airy's sum, unpolarised) brought to red, green and blue; twin of
 * `openpbr_film_light`. The visible spectrum is a sum of Lorentzian bands: of such a band Airy's sum is known in closed
 * form, with all its orders.
 *
 * @param tangential Square of the tangential part of the wave's vector, which all layers share; sin² of the angle in
 * air.
 */
export function filmReflectance(
  { index, outer, path, bands }: Film,
  [n, k]: ComplexIndex,
  tangential: number,
): OpenPbrColor {
  const square1 = outer * outer;
  const square2 = index * index;
  if (Math.min(square1, square2) <= tangential) return [1, 1, 1];
  const q1 = Math.sqrt(square1 - tangential);
  const q2 = Math.sqrt(square2 - tangential);
  const square3: Complex = [n * n - k * k, 2 * n * k];
  const size = length2(square3[0] - tangential, square3[1]);
  const q3: Complex = [
    Math.sqrt(Math.max((size + square3[0] - tangential) / 2, 0)),
    Math.sqrt(Math.max((size - square3[0] + tangential) / 2, 0)),
  ];
  const parallel: readonly [Complex, Complex] = [
    [square3[0] * q2 - square2 * q3[0], square3[1] * q2 - square2 * q3[1]],
    [square3[0] * q2 + square2 * q3[0], square3[1] * q2 + square2 * q3[1]],
  ];
  const faces: readonly (readonly [r12: number, r23: Complex])[] = [
    [(q1 - q2) / (q1 + q2), ratio([q2 - q3[0], -q3[1]], [q2 + q3[0], q3[1]])],
    [(square2 * q1 - square1 * q2) / (square2 * q1 + square1 * q2), ratio(...parallel)],
  ];
  const length = path * q2;
  const coherence = Math.exp(-bands.width * length);
  const waves = bands.wavenumbers.map((wavenumber) => {
    const phase = 2 * Math.PI * length * wavenumber;
    let sum = 0;
    let later = 0;
    for (const [r12, r23] of faces) {
      const a = r12 * r12;
      const b = r23[0] * r23[0] + r23[1] * r23[1];
      const contrast = Math.max(1 - a * b, 1e-7);
      const x = r12 * (r23[0] * Math.cos(phase) - r23[1] * Math.sin(phase));
      const y = r12 * (r23[0] * Math.sin(phase) + r23[1] * Math.cos(phase));
      const denominator = contrast * (1 + coherence * coherence * a * b + 2 * coherence * x);
      sum +=
        ((a + b) * (1 - coherence * coherence * a * b) -
          2 * a * b * (1 - coherence * coherence) +
          2 * coherence * contrast * x) /
        denominator;
      later += (2 * coherence * (1 - a) * (1 - b) * y) / denominator;
    }
    return [sum / 2, later / 2] as const;
  });
  return rgb((i) => {
    const [weights, sines] = [bands.weights[i]!, bands.sines[i]!];
    return clamp(
      waves.reduce((sum, [now, later], band) => sum + weights[band]! * now + sines[band]! * later, 0),
      0,
      1,
    );
  });
}

/** Reflectance of the film on the dielectric for a facet seen at the cosine `c`; twin of `openpbr_film_dielectric`. */
export const filmFacet = (film: Film, c: number): OpenPbrColor =>
  filmReflectance(film, [film.base, 0], (1 - c * c) * film.viewer);

/** What the film changes of the albedos of an interface; twin of the WGSL struct `OpenPbrFilmChange`. */
export interface FilmChange {
  /** What it adds to the part of the light that single scattering reflects. */
  readonly more: OpenPbrColor;
  /** Factors on what single scattering lets through and on everything that is let through, and their difference. */
  readonly direct: OpenPbrColor;
  readonly pass: OpenPbrColor;
  readonly difference: OpenPbrColor;
}

/**
 * Sums over facets as they are seen; twin of `openpbr_film_sums` with `openpbr_film_change`. What is reflected is a mean
 * over what mirrors reflect upwards, which is tabulated.
 *
 * @param eta Relative index of the interface without the film.
 * @param albedo Its directional albedo.
 * @param inside Whether the viewer is inside, where total reflection has an edge and takes more facets.
 */
export function filmChange(
  film: Film,
  eta: number,
  albedo: number,
  alpha: Slopes,
  wo: OpenPbrVector,
  inside: boolean,
): FilmChange {
  if (film.weight <= 0) return { more: [0, 0, 0], direct: [1, 1, 1], pass: [1, 1, 1], difference: [0, 0, 0] };
  const turn = Math.atan2(alpha[1] * wo[1], alpha[0] * wo[0]) / (2 * Math.PI);
  const reflected = [0, 0, 0];
  const through = [0, 0, 0];
  let plain = 0;
  let mirrored = 0;
  const [outer, all] = OPENPBR_FILM_FACET_ENDS;
  for (const [up, cosine, sine, part] of OPENPBR_FILM_FACETS.slice(...(inside ? [outer, all] : [0, outer]))) {
    const h = ggxSample(alpha, wo, [turn + Math.atan2(sine, cosine) / (2 * Math.PI), 1 - up]);
    const c = clamp(dot(wo, h), 0, 1);
    const wi: OpenPbrVector = [2 * c * h[0] - wo[0], 2 * c * h[1] - wo[1], 2 * c * h[2] - wo[2]];
    const seen = wi[2] > 0 ? (part * ggxMaskingShadowing(alpha, wo, wi)) / ggxMasking(alpha, wo) : 0;
    const clear = fresnelDielectric(eta, c);
    const color = filmFacet(film, c);
    plain += part * (1 - clear);
    mirrored += seen;
    for (const k of [0, 1, 2] as const) {
      const change = film.weight * (color[k] - clear);
      reflected[k] = (reflected[k] as number) + seen * change;
      through[k] = (through[k] as number) + part * change;
    }
  }
  const kept = (1 - conductorLoss(alpha, ggxRoughness(alpha), wo, Math.max(wo[2], 1e-5))) / Math.max(mirrored, 1e-20);
  const more = rgb((i) => kept * (reflected[i] as number));
  const part = rgb((i) => (through[i] as number) / Math.max(plain, 1e-5));
  const taken = rgb((i) => more[i] / Math.max(1 - albedo, 1e-5));
  return {
    more,
    direct: rgb((i) => Math.max(1 - part[i], 0)),
    pass: rgb((i) => Math.max(1 - taken[i], 0)),
    difference: rgb((i) => part[i] - taken[i]),
  };
}
