import type { OpenPbrParameters, OpenPbrVector } from '../src/parameters/index';
import { resolveParameters } from '../src/parameters/index';

/** Reproducible uniform numbers in [0, 1) (PCG, O'Neill 2014): the same seed, the same numbers. */
export function uniform(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 747796405) + 2891336453) >>> 0;
    const word = Math.imul((state >>> ((state >>> 28) + 4)) ^ state, 277803737) >>> 0;
    return (((word >>> 22) ^ word) >>> 0) / 0x100000000;
  };
}

/** What single precision makes of a vector. */
export const single = (v: OpenPbrVector): OpenPbrVector => [Math.fround(v[0]), Math.fround(v[1]), Math.fround(v[2])];

/** To double precision of length 1. */
export const unit = (v: OpenPbrVector): OpenPbrVector => [
  v[0] / Math.hypot(...v),
  v[1] / Math.hypot(...v),
  v[2] / Math.hypot(...v),
];

/** A direction of the upper half, cosine-distributed but for a floor. */
export function upperDirection(next: () => number, floor = 0): OpenPbrVector {
  const z = Math.max(Math.sqrt(next()), floor);
  const phi = 2 * Math.PI * next();
  const s = Math.sqrt(1 - z * z);
  return single([s * Math.cos(phi), s * Math.sin(phi), z]);
}

/** Any surface of the lobes that exist, no smoother than given. */
export function anySurface(next: () => number, smoothest: number): OpenPbrParameters {
  const color = (): OpenPbrVector => [next(), next(), next()];
  const one = (value: number, chance: number, other: number) => (next() < chance ? other : value);
  const p = resolveParameters({
    base_weight: one(next(), 0.5, 1),
    base_color: color(),
    base_diffuse_roughness: one(next(), 0.3, 0),
    base_metalness: one(next(), 0.6, next() < 0.5 ? 0 : 1),
    specular_weight: one(2 * next(), 0.5, 1),
    specular_color: color(),
    specular_roughness: smoothest + (1 - smoothest) * next(),
    specular_roughness_anisotropy: one(next(), 0.4, 0),
    specular_ior: 1 + 1.5 * next(),
    emission_luminance: one(10 * next(), 0.5, 0),
    emission_color: color(),
    geometry_opacity: next(),
  });
  return rounded(p);
}

/** Any surface below a coat, no smoother than given. */
export function anyCoated(next: () => number, smoothest: number): OpenPbrParameters {
  const one = (value: number, chance: number, other: number) => (next() < chance ? other : value);
  return rounded({
    ...anySurface(next, smoothest),
    coat_weight: one(next(), 0.5, 1),
    coat_color: next() < 0.4 ? [1, 1, 1] : [next(), next(), next()],
    coat_roughness: smoothest + (1 - smoothest) * next(),
    coat_roughness_anisotropy: one(next(), 0.4, 0),
    coat_ior: 1 + 1.5 * next(),
    coat_darkening: one(next(), 0.5, 1),
  });
}

/** Any surface that lets light through, no smoother than given. */
export function anyClear(next: () => number, smoothest: number): OpenPbrParameters {
  const one = (value: number, chance: number, other: number) => (next() < chance ? other : value);
  const p = (next() < 0.4 ? anyCoated : anySurface)(next, smoothest);
  return rounded({
    ...p,
    base_metalness: one(next(), 0.7, 0),
    specular_ior: p.specular_ior + 0.05,
    transmission_weight: one(next(), 0.5, next() < 0.5 ? 0 : 1),
    subsurface_weight: one(next(), 0.5, next() < 0.5 ? 0 : 1),
    subsurface_color: [next(), next(), next()],
    subsurface_radius: 0.1 + next(),
    subsurface_radius_scale: [1, 0.1 + 0.9 * next(), 0.1 + 0.9 * next()],
    subsurface_scatter_anisotropy: 2 * next() - 1,
    transmission_color: next() < 0.4 ? [1, 1, 1] : [next(), next(), next()],
    transmission_depth: one(next(), 0.6, 0),
    transmission_scatter: [next(), next(), next()],
    transmission_scatter_anisotropy: 2 * next() - 1,
    transmission_dispersion_scale: next(),
    transmission_dispersion_abbe_number: 10 + 50 * next(),
    geometry_thin_walled: next() < 0.3,
  });
}

/** The same with haze and retroreflection, each of them in half of the surfaces, in the steps that records have. */
export function withLobes(p: OpenPbrParameters, next: () => number): OpenPbrParameters {
  const step = () => Math.fround(Math.round(1023 * next()) / 1023);
  const [specular_haze, specular_retroreflectivity] = [next() < 0.5 ? 0 : step(), next() < 0.5 ? 0 : step()];
  return { ...p, specular_haze, specular_haze_spread: step(), specular_retroreflectivity };
}

/** A direction on the other side. */
export function lowerDirection(next: () => number, floor = 0): OpenPbrVector {
  const [x, y, z] = upperDirection(next, floor);
  return [x, y, -z];
}

/** What single precision makes of a surface, so that both sides of a comparison have the same one. */
export function rounded(p: OpenPbrParameters): OpenPbrParameters {
  return Object.fromEntries(
    Object.entries(p).map(([name, value]) => [
      name,
      typeof value === 'number'
        ? Math.fround(value)
        : Array.isArray(value)
          ? single(value as unknown as OpenPbrVector)
          : value,
    ]),
  ) as unknown as OpenPbrParameters;
}
