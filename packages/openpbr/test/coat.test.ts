import { describe, expect, it } from 'vitest';
import {
  albedoBsdf,
  coatDarkening,
  coatedBase,
  coatRoughening,
  coatTransmittance,
  emittedRadiance,
  evalBsdf,
  evalPdfBsdf,
  prepareBsdf,
  sampleBsdf,
} from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters } from '../src/parameters/index';
import { requiredFeatures } from '../src/wgsl/index';
import { gpuShader } from './gpu';
import { direction, furnace } from './integrate';
import { anyCoated, anySurface, uniform, upperDirection } from './random';
import { primitives, type Triple } from './oracle/index';

const WHITE = [1, 1, 1] as const;
const COSINES = [1, 0.85, 0.6, 0.35, 0.15, 0.05, 0.01];
const SIZE = 40;
const QUADRATURE = 5e-4;

const near = (actual: number, expected: number, rel: number, what: string) =>
  expect(Math.abs(actual - expected), `${what}: ${actual} for ${expected}`).toBeLessThanOrEqual(
    rel * Math.abs(expected),
  );

describe('coat against independent numbers', () => {
  it('roughening of what lies below, and darkening', () => {
    type Row = {
      coat_ior: number;
      base_roughness: number;
      coat_roughness: number;
      roughened_pr261: number;
      K_smooth_mu1: number;
      K_rough: number;
      Delta_E05_rough: number;
    };
    const rows = primitives()['coat'] as unknown as Row[];
    expect(rows.length).toBeGreaterThan(3);
    for (const row of rows) {
      near(
        coatRoughening(row.base_roughness, row.coat_roughness, row.coat_ior),
        Math.max(row.roughened_pr261, row.base_roughness),
        1e-5,
        'roughness',
      );
      // A black edge takes the specular part out of the base's albedo: 0.5 diffuse, as rough as it gets.
      const diffuse = resolveParameters({
        base_color: [0.5, 0, 1],
        specular_weight: 0,
        coat_weight: 1,
        coat_ior: row.coat_ior,
      });
      const [half, black, white] = coatDarkening(diffuse, 1);
      near(half, row.Delta_E05_rough, 1e-2, 'darkening');
      // The mean reflectance behind it is a fit, good to 6e-3.
      expect(Math.abs(1 - black - row.K_rough), 'internal reflectance').toBeLessThanOrEqual(6e-3 / row.coat_ior ** 2);
      expect(white).toBeCloseTo(1, 12);
      const mirror = resolveParameters({
        base_metalness: 1,
        base_color: [0, 0, 0],
        specular_roughness: 0,
        coat_weight: 1,
        coat_ior: row.coat_ior,
      });
      near(1 - coatDarkening(mirror, 1)[0], row.K_smooth_mu1, 1e-4, 'reflectance of the smooth coat');
    }
  });

  it('absorption', () => {
    for (const row of primitives()['coat_absorption'] as unknown as {
      coat_color: Triple;
      coat_ior: number;
      mu_i: number;
      mu_o: number;
      T_pair: Triple;
    }[]) {
      const p = resolveParameters({ coat_weight: 1, coat_color: row.coat_color, coat_ior: row.coat_ior });
      coatTransmittance(p, row.mu_i, row.mu_o).forEach((value, i) =>
        near(value, row.T_pair[i] as number, 1e-5, 'transmittance'),
      );
    }
  });
});

describe('white furnace below a coat', () => {
  const white = (
    name: string,
    fixed: Partial<OpenPbrParameters>,
    [low, high]: readonly [number, number],
    roughnesses = [0.05, 0.2, 0.45, 0.7, 1],
  ): void => {
    it(`${name}: albedo from ${low} to ${high}, coat roughness ${roughnesses[0]} to ${roughnesses.at(-1)}, cosine 0.01 to 1`, () => {
      for (const coat_roughness of roughnesses) {
        const p = resolveParameters({ base_color: WHITE, coat_weight: 1, coat_roughness, ...fixed });
        for (const mu of COSINES) {
          const { albedo, pdf } = furnace(p, direction(mu), {}, SIZE);
          const at = `coat roughness ${coat_roughness}, cosine ${mu}`;
          expect(albedo[1], at).toBeGreaterThanOrEqual(low);
          expect(albedo[1], at).toBeLessThanOrEqual(high + QUADRATURE);
          expect(pdf, at).toBeLessThanOrEqual(1 + 4 * QUADRATURE);
        }
      }
    });
  };
  // Plain diffuse loses nothing itself: what the coat's table is off, one way or the other, shows.
  white('diffuse', { specular_weight: 0 }, [0.99, 1.0005]);
  white('dielectric over diffuse', {}, [0.99, 1]);
  white('metal', { base_metalness: 1 }, [0.99, 1]);
  white('half a coat on half metal', { base_metalness: 0.5, coat_weight: 0.5 }, [0.99, 1]);
  white('index 2.2', { coat_ior: 2.2, base_metalness: 1, specular_roughness: 0.5 }, [0.99, 1]);
  white('not darkened', { coat_darkening: 0 }, [0.99, 1]);

  it('lets nothing but white through unchanged: darker with a tint, and with darkening', () => {
    for (const mu of [1, 0.4]) {
      const albedo = (extra: Partial<OpenPbrParameters>) =>
        furnace(
          resolveParameters({ base_color: [0.5, 0.5, 0.5], coat_weight: 1, coat_roughness: 0.2, ...extra }),
          direction(mu),
          {},
          SIZE,
        ).albedo;
      const [kept, darkened, tinted] = [
        albedo({ coat_darkening: 0 }),
        albedo({}),
        albedo({ coat_darkening: 0, coat_color: [1, 0.5, 0.2] }),
      ];
      expect(darkened[0]).toBeLessThan(kept[0] - 0.1);
      expect(tinted[0]).toBeCloseTo(kept[0], 3);
      expect(tinted[1]).toBeLessThan(kept[1] - 0.1);
      expect(tinted[2]).toBeLessThan(tinted[1] - 0.05);
    }
  });

  it('never exceeds what came in, 80 random surfaces without anisotropy (seed 31)', () => {
    const next = uniform(31);
    for (let i = 0; i < 80; i++) {
      const p = { ...anyCoated(next, 0.05), specular_roughness_anisotropy: 0, coat_roughness_anisotropy: 0 };
      const { albedo } = furnace(p, upperDirection(next, 0.01), {}, SIZE);
      expect(Math.max(...albedo), JSON.stringify(p)).toBeLessThanOrEqual(1 + QUADRATURE);
    }
  });

  it('is what openpbr_albedo says within 0.06, 80 random surfaces without metal and anisotropy (seed 32)', () => {
    const next = uniform(32);
    let worst = 0;
    for (let i = 0; i < 80; i++) {
      const p = {
        ...anyCoated(next, 0.05),
        specular_roughness_anisotropy: 0,
        coat_roughness_anisotropy: 0,
        base_metalness: 0,
        base_diffuse_roughness: 0,
      };
      const wo = upperDirection(next, 0.05);
      const { albedo } = furnace(p, wo, {}, SIZE);
      albedoBsdf(prepareBsdf(p, wo), wo).forEach(
        (value, k) => (worst = Math.max(worst, Math.abs(value - (albedo[k] as number)))),
      );
    }
    expect(worst).toBeLessThan(0.06);
  });
});

describe('coat', () => {
  it('of weight 0 is no coat, to the last bit, 500 random surfaces (seed 33)', () => {
    const next = uniform(33);
    for (let i = 0; i < 500; i++) {
      const p = anySurface(next, 0);
      const coated: OpenPbrParameters = {
        ...p,
        coat_color: [next(), next(), next()],
        coat_roughness: next(),
        coat_ior: 1 + next(),
        coat_roughness_anisotropy: next(),
        coat_darkening: next(),
      };
      const wo = upperDirection(next),
        wi = upperDirection(next);
      const u = [next(), next(), next()] as const;
      const both = (q: OpenPbrParameters) => {
        const b = prepareBsdf(q, wo);
        return [evalPdfBsdf(b, wo, wi), sampleBsdf(b, wo, u), albedoBsdf(b, wo), emittedRadiance(q, wo)];
      };
      expect(both(coated)).toEqual(both(p));
    }
  });

  it('of index 1 and without colour changes nothing but the choice of samples', () => {
    const next = uniform(34);
    for (let i = 0; i < 200; i++) {
      const p = anySurface(next, 0.1);
      const wo = upperDirection(next, 0.02),
        wi = upperDirection(next, 0.02);
      const bare = evalBsdf(prepareBsdf(p, wo), wo, wi);
      evalBsdf(prepareBsdf({ ...p, coat_weight: 1, coat_ior: 1, coat_roughness: next() }, wo), wo, wi).forEach(
        (value, k) =>
          expect(Math.abs(value - (bare[k] as number))).toBeLessThanOrEqual(1e-9 * Math.max(bare[k] as number, 1)),
      );
    }
  });

  it('is a reciprocal lobe over black, single scattering', () => {
    const next = uniform(35);
    for (let i = 0; i < 500; i++) {
      const p: OpenPbrParameters = { ...anyCoated(next, 0.1), base_weight: 0, specular_weight: 0 };
      const wo = upperDirection(next, 0.02),
        wi = upperDirection(next, 0.02);
      const there = evalBsdf(prepareBsdf(p, wo, { multipleScattering: false }), wo, wi);
      const back = evalBsdf(prepareBsdf(p, wi, { multipleScattering: false }), wi, wo);
      expect(Math.abs(there[0] / wi[2] - back[0] / wo[2])).toBeLessThanOrEqual(1e-6 * (there[0] / wi[2]));
    }
  });

  it('makes the base no smoother, and leaves a rest of the step to its index', () => {
    const next = uniform(36);
    for (let i = 0; i < 500; i++) {
      const p = anyCoated(next, 0);
      const base = coatedBase(p);
      expect(base.specular_roughness).toBeGreaterThanOrEqual(p.specular_roughness - 1e-15);
      expect(base.specular_roughness).toBeLessThanOrEqual(1);
      if (p.coat_weight === 1) expect(base.specular_ior).toBeGreaterThanOrEqual(1);
    }
    expect(coatedBase(resolveParameters({ coat_weight: 1, coat_ior: 1.5 })).specular_ior).toBe(1);
  });

  it('keeps back emitted light once: at normal incidence the root of its colour, less its reflectance', () => {
    const [r, g] = emittedRadiance(
      resolveParameters({ emission_luminance: 2, coat_weight: 1, coat_ior: 1.5, coat_color: [0.25, 1, 1] }),
      [0, 0, 1],
    );
    expect(r).toBeCloseTo(2 * 0.96 * 0.5, 3);
    expect(g).toBeCloseTo(2 * 0.96, 3);
  });

  it('costs nothing where no material has one', () => {
    const code = (p: Partial<OpenPbrParameters>) => gpuShader(requiredFeatures([p])).code;
    const plain = code({ base_color: [0.5, 0.5, 0.5], coat_weight: 0, coat_roughness: 0.5 });
    const statements = plain.replace(/\/\/.*$/gm, '').replace(/^ *(geometry_)?coat_\w+: \w+,?$/gm, '');
    expect(statements.toLowerCase()).not.toContain('coat');
    expect(code({ base_color: [0.5, 0.5, 0.5], coat_weight: 0.1 })).toContain('fn openpbr_coat_prepare');
  });
});
