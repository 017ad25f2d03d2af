import { describe, expect, it } from 'vitest';
import { evalPdfBsdf, prepareBsdf, sampleBsdf, SPIKE } from '../src/cpu/index';
import {
  resolveParameters,
  type OpenPbrColor,
  type OpenPbrParameters,
  type OpenPbrVector,
} from '../src/parameters/index';
import { direction } from './integrate';
import { uniform } from './random';

/** Fresnel's equations as they stand in textbooks: reflectance from an index n1 into n2, and the refracted cosine. */
function fresnel(n1: number, n2: number, cosine: number): { reflected: number; refracted: number } {
  const sine = (n1 / n2) * Math.sqrt(1 - cosine * cosine);
  if (sine >= 1) return { reflected: 1, refracted: 0 };
  const refracted = Math.sqrt(1 - sine * sine);
  const s = (n1 * cosine - n2 * refracted) / (n1 * cosine + n2 * refracted);
  const p = (n1 * refracted - n2 * cosine) / (n1 * refracted + n2 * cosine);
  return { reflected: (s * s + p * p) / 2, refracted };
}

/** Samples a view: they are spread evenly over the lobes, so that a lobe's share is exact to one of them. */
const COUNT = 4000;

interface Found {
  readonly wi: OpenPbrVector;
  /** Mean weight of the samples in this direction, times their share of all samples. */
  readonly energy: OpenPbrColor;
  readonly pdf: number;
}

/** Directions that samples take, each with its energy; those of lobes with a width together under "spread". */
function lobes(
  given: Partial<OpenPbrParameters>,
  wo: OpenPbrVector,
  side: { readonly inside?: boolean } = {},
): { deltas: Found[]; spread: OpenPbrColor } {
  const b = prepareBsdf(resolveParameters({ specular_roughness: 0, coat_roughness: 0, ...given }), wo, side);
  const count = COUNT;
  const found = new Map<string, { wi: OpenPbrVector; energy: [number, number, number]; pdf: number }>();
  const spread: [number, number, number] = [0, 0, 0];
  const next = uniform(5);
  let valid = true;
  let seen = 0;
  for (let i = 0; i < count; i++) {
    // Lobes are chosen by the third number: it is spread evenly.
    const s = sampleBsdf(b, wo, [next(), next(), (i + 0.5) / count]);
    valid &&= s.valid;
    const isDelta = s.pdf > 1e-6 * SPIKE;
    const key = s.wi.map((x) => x.toFixed(9)).join(' ');
    const one = found.get(key) ?? { wi: s.wi, energy: [0, 0, 0], pdf: 0 };
    if (isDelta) found.set(key, one);
    const sum = isDelta ? one.energy : spread;
    s.weight.forEach((w, k) => (sum[k] = (sum[k] as number) + w / count));
    if (isDelta) one.pdf = s.pdf;
    if (!isDelta || one.energy[1] > s.weight[1] / count) continue;
    // Seen as a pair of directions, a delta has no value and no density.
    const pair = evalPdfBsdf(b, wo, s.wi);
    seen = Math.max(seen, pair.pdf, ...pair.f);
  }
  expect(valid).toBe(true);
  expect(seen).toBeLessThan(1);
  return { deltas: [...found.values()], spread };
}

const GLASS = { transmission_weight: 1, base_metalness: 0 } as const;
const near = (a: readonly number[], b: readonly number[]): boolean =>
  Math.hypot(...a.map((x, k) => x - (b[k] as number))) < 1e-12;

describe('smooth interfaces are deltas', () => {
  const VIEWS = [1, 0.9, 0.6, 0.3, 0.05, 0.002].map((mu) => direction(mu));

  it.each([1.1, 1.33, 1.5, 2.42])(
    'glass of index %f reflects and refracts as Fresnel and Snell say, from either side',
    (specular_ior) => {
      for (const wo of VIEWS) {
        for (const inside of [false, true]) {
          const [n1, n2] = inside ? [specular_ior, 1] : [1, specular_ior];
          const { reflected, refracted } = fresnel(n1, n2, wo[2]);
          const { deltas, spread } = lobes({ ...GLASS, specular_ior }, wo, { inside });
          expect(spread).toEqual([0, 0, 0]);
          expect(deltas).toHaveLength(reflected < 1 ? 2 : 1);
          const mirror = deltas.find(({ wi }) => near(wi, [-wo[0], -wo[1], wo[2]]));
          // The share of the samples is exact to one.
          for (const k of [0, 1, 2] as const) {
            expect(Math.abs((mirror?.energy[k] ?? 0) - reflected)).toBeLessThan(1 / COUNT);
            expect(deltas.reduce((sum, { energy }) => sum + energy[k], 0)).toBeCloseTo(1, 12);
          }
          expect(Math.abs((mirror?.pdf ?? 0) / SPIKE - reflected)).toBeLessThan(1e-12);
          if (reflected === 1) continue;
          const bent = [(-wo[0] * n1) / n2, (-wo[1] * n1) / n2, -refracted];
          expect(deltas.some(({ wi }) => near(wi, bent))).toBe(true);
        }
      }
    },
  );

  it('a thin wall reflects 2R / (1 + R), and lets the rest straight through', () => {
    for (const wo of VIEWS) {
      const once = fresnel(1, 1.5, wo[2]).reflected;
      const both = (2 * once) / (1 + once);
      const { deltas, spread } = lobes({ ...GLASS, geometry_thin_walled: true }, wo);
      expect(spread).toEqual([0, 0, 0]);
      const straight = deltas.find(({ wi }) => near(wi, [-wo[0], -wo[1], -wo[2]]));
      expect(Math.abs((straight?.energy[1] ?? 0) - (1 - both))).toBeLessThan(0.0015);
      expect(deltas.reduce((sum, { energy }) => sum + energy[1], 0)).toBeCloseTo(1, 12);
    }
  });

  it('metal mirrors its colour, along the normal exactly', () => {
    const base_color = [0.9, 0.6, 0.3] as const;
    for (const wo of VIEWS) {
      const { deltas, spread } = lobes({ base_metalness: 1, base_color }, wo);
      expect(spread).toEqual([0, 0, 0]);
      expect(deltas).toHaveLength(1);
      expect(near(deltas[0]!.wi, [-wo[0], -wo[1], wo[2]])).toBe(true);
      if (wo[2] === 1) expect(near(deltas[0]!.energy, base_color)).toBe(true);
    }
    // A white mirror reflects all light from everywhere.
    for (const wo of VIEWS) {
      const [white] = lobes({ base_metalness: 1, base_color: [1, 1, 1] }, wo).deltas;
      expect(near(white!.energy, [1, 1, 1])).toBe(true);
    }
  });

  it('a coat and the base below it mirror to one direction, with the sum of what they reflect', () => {
    for (const wo of VIEWS) {
      const top = fresnel(1, 1.6, wo[2]).reflected;
      const { deltas, spread } = lobes(
        { base_metalness: 1, base_color: [1, 1, 1], coat_weight: 1, coat_ior: 1.6, coat_darkening: 0 },
        wo,
      );
      expect(spread).toEqual([0, 0, 0]);
      expect(deltas).toHaveLength(1);
      // The coat lets 1 less its albedo through, which is tabulated to 0.0015.
      expect(Math.abs(deltas[0]!.energy[1] - 1)).toBeLessThan(0.0015);
      expect(deltas[0]!.energy[1]).toBeGreaterThanOrEqual(top);
    }
  });

  it('a coat with a normal of its own mirrors elsewhere than the base', () => {
    const n: OpenPbrVector = [0.28, 0, 0.96];
    const wo = direction(0.8);
    const { deltas } = lobes(
      { base_metalness: 1, coat_weight: 1, coat_ior: 1.6, geometry_coat_normal: n, coat_darkening: 0 },
      wo,
    );
    const c = 2 * (wo[0] * n[0] + wo[2] * n[2]);
    expect(deltas).toHaveLength(2);
    const coat = deltas.find(({ wi }) => near(wi, [c * n[0] - wo[0], c * n[1] - wo[1], c * n[2] - wo[2]]));
    expect(deltas.some(({ wi }) => near(wi, [-wo[0], -wo[1], wo[2]]))).toBe(true);
    expect(Math.abs((coat?.energy[1] ?? 0) - fresnel(1, 1.6, c / 2).reflected)).toBeLessThan(1 / COUNT);
  });

  it('over white diffuse, all light comes back', () => {
    for (const wo of VIEWS.slice(0, 4)) {
      const { deltas, spread } = lobes({ base_color: [1, 1, 1] }, wo);
      expect(deltas).toHaveLength(1);
      // Within what furnace.test.ts allows rough ones, and the noise of the samples.
      expect(Math.abs(deltas[0]!.energy[1] + spread[1] - 1)).toBeLessThan(0.003);
    }
  });

  it('from roughness 0 over 0.01, where lobes begin to have a width, to 0.02 no energy jumps', () => {
    for (const given of [{ ...GLASS }, { base_metalness: 1 }, {}, { coat_weight: 1 }] as const) {
      const energies = [0, 0.01, 0.0100001, 0.02].map((roughness) => {
        const p = { ...given, specular_roughness: roughness, coat_roughness: roughness };
        const wo = direction(0.6);
        const b = prepareBsdf(resolveParameters(p), wo);
        const next = uniform(9);
        let sum = 0;
        for (let i = 0; i < 20_000; i++) {
          const s = sampleBsdf(b, wo, [next(), next(), (i + 0.5) / 20_000]);
          // Near the mirror only.
          const off = Math.hypot(s.wi[0] + wo[0], s.wi[1] + wo[1], s.wi[2] - wo[2]);
          if (s.valid && off < 0.1) sum += s.weight[1] / 20_000;
        }
        return sum;
      });
      for (const one of energies) expect(Math.abs(one - energies[0]!)).toBeLessThan(0.001);
    }
  });
});
