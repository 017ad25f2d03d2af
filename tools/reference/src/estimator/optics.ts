/** Three numbers: a point or direction, or red, green and blue. */
export type Vec3 = readonly [number, number, number];

export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const scaled = (a: Vec3, s: number): Vec3 => [a[0] * s, a[1] * s, a[2] * s];
/** a + s b */
export const along = (a: Vec3, s: number, b: Vec3): Vec3 => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
export const unit = (a: Vec3): Vec3 => scaled(a, 1 / Math.hypot(a[0], a[1], a[2]));

/** What a smooth interface does with a ray. */
export interface Interface {
  /** Unpolarised reflectance, 0..1; 1 beyond the critical angle. */
  readonly reflectance: number;
  /** Cosine of the angle of refraction, 0..1; 0 beyond the critical angle. */
  readonly cosine: number;
}

/**
 * Snell's law and Fresnel's equations for both polarisations.
 *
 * @param n1 Index of refraction on the side of the ray.
 * @param n2 Index beyond.
 * @param c Cosine of the angle of incidence, 0..1.
 */
export function smoothInterface(n1: number, n2: number, c: number): Interface {
  const sine = (n1 / n2) * Math.sqrt(Math.max(0, 1 - c * c));
  if (sine >= 1) return { reflectance: 1, cosine: 0 };
  const t = Math.sqrt(1 - sine * sine);
  const perpendicular = (n1 * c - n2 * t) / (n1 * c + n2 * t);
  const parallel = (n2 * c - n1 * t) / (n2 * c + n1 * t);
  return { reflectance: (perpendicular ** 2 + parallel ** 2) / 2, cosine: t };
}

/** Reflectance of a pane with all reflections between its two faces, each of which reflects `face`. */
export const paneReflectance = (face: number): number => face + ((1 - face) ** 2 * face) / (1 - face * face);

/** Wavelengths of Fraunhofer's lines F, d and C, nm. */
const [LINE_F, LINE_D, LINE_C] = [486.1, 587.6, 656.3] as const;

/**
 * Index of refraction by Cauchy's formula n = A + B / λ², from the index at line d and the Abbe number
 * (n_d − 1) / (n_F − n_C).
 *
 * @param wavelength nm
 */
export function cauchyIndex(nd: number, abbe: number, wavelength: number): number {
  const b = (nd - 1) / abbe / (LINE_F ** -2 - LINE_C ** -2);
  return nd - b * LINE_D ** -2 + b * wavelength ** -2;
}

/** The visible range, nm. */
export const [VIOLET_END, RED_END] = [380, 780] as const;

/** A logistic density (mean and scale in nm), normalised between 380 and 780 nm. */
function logistic(mean: number, scale: number): (wavelength: number) => number {
  const cumulative = (wavelength: number) => 1 / (1 + Math.exp((mean - wavelength) / scale));
  const mass = cumulative(RED_END) - cumulative(VIOLET_END);
  return (wavelength) => 1 / (4 * scale * mass * Math.cosh((wavelength - mean) / (2 * scale)) ** 2);
}

const [red, violet, green, blue] = [
  logistic(607.3, 16.6),
  logistic(439, 7),
  logistic(539.5, 18.3),
  logistic(451.8, 13.8),
] as const;

/**
 * How red, green and blue respond to a wavelength, per nm; each integrates to 1. This is part of what the material model
 * of Glanz defines, see `packages/renderer/src/integrator/dispersion.wesl`: fits to the positive parts of sRGB's matching
 * functions.
 */
export const receptors = (wavelength: number): Vec3 => [
  0.958 * red(wavelength) + 0.042 * violet(wavelength),
  green(wavelength),
  blue(wavelength),
];

/** Width of a step of {@link drawWavelength}'s table, nm. */
const STEP = 0.5;
const spectrum: readonly number[] = Array.from({ length: (RED_END - VIOLET_END) / STEP }, (_, i) => {
  const [r, g, b] = receptors(VIOLET_END + (i + 0.5) * STEP);
  return r + g + b + 1e-4;
});
const total = spectrum.reduce((sum, value) => sum + value, 0);
const sums: readonly number[] = spectrum.map(
  (
    (sum) => (value: number) =>
      (sum += value / total)
  )(0),
);

/**
 * A wavelength by about the mean response of the receptors, by steps, and the responses over its density.
 *
 * @param u Uniform, 0..1.
 */
export function drawWavelength(u: number): { readonly wavelength: number; readonly weight: Vec3 } {
  let [low, high] = [0, sums.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (u < sums[middle]!) high = middle;
    else low = middle + 1;
  }
  const before = low === 0 ? 0 : sums[low - 1]!;
  const share = spectrum[low]! / total;
  const wavelength = VIOLET_END + (low + Math.min(Math.max((u - before) / share, 0), 1)) * STEP;
  return { wavelength, weight: scaled(receptors(wavelength), STEP / share) };
}
