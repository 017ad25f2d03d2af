import { describe, expect, it } from 'vitest';
import { gaussLegendre } from '../scripts/microfacet.mjs';
import {
  emittedRadiance,
  evalPdfBsdf,
  fuzzAlbedo,
  fuzzDensity,
  fuzzSample,
  prepareBsdf,
  prepareFuzz,
  sampleBsdf,
} from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters, type OpenPbrVector } from '../src/parameters/index';
import { requiredFeatures } from '../src/wgsl/index';
import { gpuShader } from './gpu';
import { direction } from './integrate';
import { uniform, upperDirection } from './random';
import { oracle, primitives } from './oracle/index';
import { sphereFurnace } from './sphere';

const fuzzy = (fuzz_roughness: number, extra: Partial<OpenPbrParameters> = {}): OpenPbrParameters =>
  resolveParameters({ base_color: [1, 1, 1], fuzz_weight: 1, fuzz_roughness, ...extra });

describe('fuzz against independent numbers', () => {
  it('energy: our simulation against the published table, within 2 % or 0.004', () => {
    const rows = (
      oracle() as unknown as {
        primitives: {
          fuzz_ltc: {
            roughness: number;
            wo: OpenPbrVector;
            wi: OpenPbrVector;
            table: { aInv_bInv_R: [number, number, number]; fcos: number };
          }[];
        };
      }
    ).primitives.fuzz_ltc;
    expect(rows.length).toBeGreaterThan(20);
    let near = 0;
    for (const { roughness, wo, wi, table } of rows) {
      const energy = fuzzAlbedo(roughness, wo[2]);
      expect(Math.abs(energy - table.aInv_bInv_R[2]), `${energy} for ${table.aInv_bInv_R[2]}`).toBeLessThanOrEqual(
        Math.max(0.02 * table.aInv_bInv_R[2], 0.004),
      );
      const fuzz = prepareFuzz(fuzzy(roughness), wo, wo[2]);
      const f = energy * fuzzDensity(fuzz, wi);
      // The shape is a fit, to our simulation there and to theirs here.
      if (Math.abs(f - table.fcos) <= Math.max(0.1 * table.fcos, 0.002)) near++;
    }
    expect(near / rows.length).toBeGreaterThanOrEqual(0.9);
  });

  it('energy against the published rational fit, within its error of 0.06', () => {
    for (const { roughness, wo, fit } of primitives()['fuzz_ltc'] as unknown as {
      roughness: number;
      wo: OpenPbrVector;
      fit: { aInv_bInv_R: number[] };
    }[]) {
      expect(Math.abs(fuzzAlbedo(roughness, wo[2]) - (fit.aInv_bInv_R[2] as number))).toBeLessThan(0.06);
    }
  });
});

describe('fuzz', () => {
  it('has a density that integrates to 1 and is followed by its samples', () => {
    const { nodes, weights } = gaussLegendre(64);
    for (const roughness of [0.3, 0.6, 1]) {
      for (const mu of [0.9, 0.5, 0.15]) {
        const wo = direction(mu, 1);
        const fuzz = prepareFuzz(fuzzy(roughness), wo, mu);
        let total = 0;
        nodes.forEach((node, i) => {
          for (let k = 0; k < 256; k++)
            total +=
              ((4 * Math.PI * node * (weights[i] as number)) / 256) *
              fuzzDensity(fuzz, direction(node * node, (2 * Math.PI * (k + 0.5)) / 256));
        });
        expect(total).toBeCloseTo(1, 2);
        // 1 / density averages to the solid angle of the hemisphere.
        const next = uniform(90);
        let area = 0;
        const count = 20_000;
        for (let i = 0; i < count; i++) {
          const wi = fuzzSample(fuzz, [next(), next()]);
          if (wi[2] > 0.3 && fuzzDensity(fuzz, wi) > 1e-3) area += 1 / fuzzDensity(fuzz, wi) / count;
        }
        expect(Math.abs(area - 2 * Math.PI * 0.7)).toBeLessThan(roughness < 0.5 ? 1.2 : 0.4);
      }
    }
  });

  it('loses nothing and makes nothing: white furnace within 0.5 %', () => {
    for (const roughness of [0.1, 0.5, 1]) {
      for (const mu of [1, 0.6, 0.15, 0.05]) {
        for (const extra of [{ specular_weight: 0 }, { transmission_weight: 1, specular_roughness: 0.3 }]) {
          const { reflected, transmitted, pdf } = sphereFurnace(fuzzy(roughness, extra), direction(mu), {}, 40);
          expect(
            Math.abs(reflected[1] + transmitted[1] - 1),
            `roughness ${roughness}, cosine ${mu}, ${JSON.stringify(extra)}`,
          ).toBeLessThan(5e-3);
          // The quadrature has no technique of its own for the narrow lobes near the horizon.
          expect(pdf).toBeLessThan(1.004);
        }
      }
    }
  });

  it('reports what it samples, and keeps back emitted light (seed 91)', () => {
    const next = uniform(91);
    for (let i = 0; i < 2000; i++) {
      const p = fuzzy(0.1 + 0.9 * next(), {
        fuzz_weight: next(),
        fuzz_color: [next(), next(), next()],
        specular_roughness: 0.2 + 0.8 * next(),
        coat_weight: next(),
        coat_roughness: 0.3,
      });
      const wo = upperDirection(next, 0.02);
      const b = prepareBsdf(p, wo);
      const s = sampleBsdf(b, wo, [next(), next(), next()]);
      if (!s.valid || s.wi[2] < 1e-3) continue;
      const { f, pdf } = evalPdfBsdf(b, wo, s.wi);
      expect(Math.abs(s.pdf / pdf - 1)).toBeLessThan(1e-4);
      s.weight.forEach((w, k) =>
        expect(Math.abs(w * s.pdf - (f[k] as number))).toBeLessThanOrEqual(1e-4 * Math.max(f[k] as number, 1e-6)),
      );
      expect(Math.max(...s.weight)).toBeLessThan(4);
    }
    const wo = direction(0.3);
    expect(emittedRadiance(fuzzy(0.5, { emission_luminance: 2 }), wo)[0]).toBeCloseTo(
      2 * (1 - fuzzAlbedo(0.5, 0.3)),
      10,
    );
  });

  it('costs nothing where no material has any', () => {
    const code = (p: Partial<OpenPbrParameters>) =>
      gpuShader(requiredFeatures([p]))
        .code.replace(/^ *fuzz_\w+: \w+,?$/gm, '')
        .replace(/\/\/.*/g, '');
    expect(code({ fuzz_roughness: 0.2 })).not.toContain('fuzz');
    expect(code({ fuzz_weight: 0.2 })).toContain('fn openpbr_fuzz_prepare');
  });
});
