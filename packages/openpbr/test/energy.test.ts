import { describe, expect, it } from 'vitest';
import { albedoBsdf, evalBsdf, prepareBsdf } from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters } from '../src/parameters/index';
import { direction, furnace, whiteDielectric } from './integrate';
import { anySurface, uniform, upperDirection } from './random';
import { primitives } from './oracle/index';
import { inSample } from './sample';

const WHITE = [1, 1, 1] as const;
const ROUGHNESSES = [0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1];
const COSINES = [1, 0.85, 0.6, 0.35, 0.15, 0.05, 0.01];
const SIZE = 40;
/** The quadrature's own error; that of plain Lambert, below, is most of it. */
const QUADRATURE = 5e-4;

describe('white furnace: nothing is lost, nothing is made', () => {
  const white = (
    name: string,
    fixed: Partial<OpenPbrParameters>,
    [low, high]: readonly [number, number],
    azimuths = [0.4],
    roughnesses = ROUGHNESSES,
  ): void => {
    it(`${name}: albedo from ${low} to ${high}, roughness ${roughnesses[0]} to ${roughnesses.at(-1)}, cosine 0.01 to 1`, () => {
      for (const [i, specular_roughness] of roughnesses.entries()) {
        const p = resolveParameters({ base_color: WHITE, specular_roughness, ...fixed });
        for (const [j, mu] of COSINES.entries()) {
          if (!inSample(2, i, j)) continue;
          for (const phi of azimuths) {
            const { albedo, pdf } = furnace(p, direction(mu, phi), {}, SIZE);
            const at = `roughness ${specular_roughness}, cosine ${mu}, azimuth ${phi}`;
            expect(albedo[1], at).toBeGreaterThanOrEqual(low);
            expect(albedo[1], at).toBeLessThanOrEqual(high + QUADRATURE);
            // Reflected half vectors may point below the horizon: the density may miss some, never exceed.
            expect(pdf, at).toBeLessThanOrEqual(1 + 4 * QUADRATURE);
          }
        }
      }
    });
  };
  white('metal', { base_metalness: 1 }, [0.99, 1]);
  white('diffuse', { specular_weight: 0 }, [1 - QUADRATURE, 1], [0.4], [0.3]);
  white('rough diffuse', { specular_weight: 0, base_diffuse_roughness: 1 }, [0.999, 1.001], [0.4], [0.3]);
  white('dielectric over diffuse', {}, [0.99, 1]);
  white('dielectric of index 1.1', { specular_ior: 1.1 }, [0.99, 1], [0.4], [0.05, 0.2, 0.6, 1]);
  white('dielectric of index 2.5', { specular_ior: 2.5 }, [0.99, 1], [0.4], [0.05, 0.2, 0.6, 1]);
  white('dielectric with specular_weight 3', { specular_weight: 3 }, [0.99, 1], [0.4], [0.05, 0.2, 0.6, 1]);
  white('half metal', { base_metalness: 0.5 }, [0.99, 1], [0.4], [0.05, 0.2, 0.6, 1]);
  // Fits: the README tells.
  white(
    'dielectric over rough diffuse',
    { base_diffuse_roughness: 1 },
    [0.996, 1.001],
    [0.4],
    [0.05, 0.2, 0.4, 0.6, 1],
  );
  white('dielectric over half rough diffuse', { base_diffuse_roughness: 0.5 }, [0.996, 1.001], [0.4], [0.05, 0.4]);
  white(
    'dielectric of index 1.1 over rough diffuse',
    { base_diffuse_roughness: 1, specular_ior: 1.1 },
    [0.996, 1.001],
    [0.4],
    [0.05, 0.2, 0.4, 1],
  );
  white(
    'dielectric of index 2.5 over rough diffuse',
    { base_diffuse_roughness: 1, specular_ior: 2.5 },
    [0.996, 1.001],
    [0.4],
    [0.05, 0.2, 0.4, 1],
  );
  white(
    'anisotropic metal',
    { base_metalness: 1, specular_roughness_anisotropy: 0.5 },
    [0.99, 1.003],
    [0, 0.8, 1.57],
    [0.1, 0.3, 0.6, 1],
  );
  white(
    'very anisotropic metal',
    { base_metalness: 1, specular_roughness_anisotropy: 0.9 },
    [0.99, 1.003],
    [0, 0.8, 1.57],
    [0.1, 0.3, 0.6, 1],
  );
});

describe('energy', () => {
  it('of single scattering is lost just as independent numbers say', () => {
    for (const row of primitives()['ggx_directional_albedo'] as unknown as {
      r: number;
      mu: number;
      E_F1_correlated: number;
    }[]) {
      const p = resolveParameters({ base_metalness: 1, base_color: WHITE, specular_roughness: row.r });
      expect(
        Math.abs(furnace(p, direction(row.mu), { multipleScattering: false }, 64).albedo[0] - row.E_F1_correlated),
        `roughness ${row.r}, cosine ${row.mu}`,
      ).toBeLessThan(1e-3);
    }
  });

  it('of clear glass is 1 within 0.0025 from outside, to the normal and to the horizon, 200 random views, indices and roughnesses (seed 68)', () => {
    const next = uniform(68);
    for (let i = 0; i < 200; i++) {
      const p = resolveParameters({
        transmission_weight: 1,
        specular_ior: 1.03 + 1.5 * next(),
        specular_roughness: next() < 0.3 ? 1 : 0.03 + 0.97 * next(),
      });
      const sum = whiteDielectric(p, direction(next() < 0.5 ? 1 - 0.2 * next() : 0.02 + 0.98 * next() ** 2));
      expect(Math.abs(sum - 1), `${sum} for ${JSON.stringify([p.specular_ior, p.specular_roughness])}`).toBeLessThan(
        0.0025,
      );
    }
  });

  it('never exceeds what came in, 80 random surfaces without anisotropy (seed 11)', () => {
    const next = uniform(11);
    for (let i = 0; i < 80; i++) {
      const p = { ...anySurface(next, 0.05), specular_roughness_anisotropy: 0 };
      const { albedo } = furnace(p, upperDirection(next, 0.01), {}, SIZE);
      expect(Math.max(...albedo), JSON.stringify(p)).toBeLessThanOrEqual(1 + QUADRATURE);
    }
  });

  it('is what openpbr_albedo says, within 0.005 without metal, 0.06 with untinted edges, 80 random surfaces without anisotropy (seed 12)', () => {
    const next = uniform(12);
    for (let i = 0; i < 80; i++) {
      const p = {
        ...anySurface(next, 0.05),
        specular_roughness_anisotropy: 0,
        base_diffuse_roughness: 0,
        ...(i % 2 === 0 ? { base_metalness: 0 } : { specular_color: WHITE }),
      };
      const wo = upperDirection(next, 0.05);
      const { albedo } = furnace(p, wo, {}, SIZE);
      albedoBsdf(prepareBsdf(p, wo), wo).forEach((value, k) =>
        expect(Math.abs(value - (albedo[k] as number)), JSON.stringify(p)).toBeLessThan(
          p.base_metalness > 0 ? 0.06 : 0.005,
        ),
      );
    }
  });
});

describe('reciprocity', () => {
  const asymmetry = (p: OpenPbrParameters, next: () => number, multipleScattering: boolean): number => {
    const a = direction(0.02 + 0.98 * next(), 7 * next());
    const b = direction(0.02 + 0.98 * next(), 7 * next());
    const there = evalBsdf(prepareBsdf(p, a, { multipleScattering }), a, b).map((value) => value / b[2]);
    const back = evalBsdf(prepareBsdf(p, b, { multipleScattering }), b, a).map((value) => value / a[2]);
    return Math.max(
      ...there.map((value, k) => Math.abs(value - (back[k] as number)) / Math.max(value, back[k] as number, 1e-6)),
    );
  };
  it('holds for single scattering over diffuse, every surface, 1000 random pairs (seed 13)', () => {
    const next = uniform(13);
    for (let i = 0; i < 1000; i++) {
      const p = anySurface(next, 0.05);
      expect(asymmetry(p, next, false), JSON.stringify(p)).toBeLessThan(1e-9);
    }
  });
  it('holds for metal with multiple scattering (seed 14)', () => {
    const next = uniform(14);
    for (let i = 0; i < 1000; i++) {
      const p = { ...anySurface(next, 0.05), base_metalness: 1 };
      expect(asymmetry(p, next, true), JSON.stringify(p)).toBeLessThan(1e-9);
    }
  });
});
