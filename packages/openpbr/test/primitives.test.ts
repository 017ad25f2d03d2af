import { describe, expect, it } from 'vitest';
import {
  dielectricEpsilon,
  energyBounce,
  energyLost,
  energyAlbedo,
  energyTotalLost,
  eon,
  fresnelDielectric,
  fresnelMean,
  fresnelMetal,
  fresnelMetalMean,
  ggxAlpha,
  ggxDistribution,
  ggxMasking,
  ggxMaskingShadowing,
  ggxSample,
} from '../src/cpu/index';
import { primitives, type Triple } from './oracle/index';

const near = (actual: number, expected: number, rel: number, abs = 0) => {
  const slack = Math.max(rel * Math.abs(expected), abs);
  if (!(Math.abs(actual - expected) <= slack)) throw new Error(`${actual} is not within ${slack} of ${expected}`);
};

describe('primitives against independent numbers', () => {
  it('Fresnel of a dielectric', () => {
    for (const row of primitives()['fresnel_dielectric'] as { eta: number; mu: number; F: number }[])
      near(fresnelDielectric(row.eta, row.mu), row.F, 1e-6);
  });

  it('mean Fresnel reflectance, about', () => {
    for (const row of primitives()['fresnel_average'] as { eta: number; exact: number }[])
      near(fresnelMean((row.eta - 1) / (row.eta + 1)), row.exact, 0, 6e-3);
  });

  it('specular_weight as a change of the index of refraction', () => {
    for (const row of primitives()['specular_weight_ior'] as {
      eta: number;
      weight: number;
      eta_mod: number;
      F_mu05_v11: number;
    }[]) {
      const epsilon = dielectricEpsilon(row.eta, row.weight);
      const eta = (1 + epsilon) / (1 - epsilon);
      if (row.eta_mod < 1e3 && row.eta_mod > 1e-3) near(eta, row.eta_mod, 1e-6);
      near(fresnelDielectric(eta, 0.5), row.F_mu05_v11, 1e-6, 1e-3 * Number(row.eta_mod > 1e3));
    }
  });

  it('F82 tint', () => {
    for (const row of primitives()['f82_tint'] as {
      F0: Triple;
      tint: Triple;
      mu?: number;
      F_clamped: Triple;
      average: Triple;
    }[]) {
      // Rows without an angle hold averages, of the formula that is not clamped.
      if (row.mu === undefined)
        fresnelMetalMean(row.F0, row.tint).forEach((value, i) =>
          near(value, Math.max(row.average[i] as number, 0), 1e-5),
        );
      else
        fresnelMetal(row.F0, row.tint, row.mu).forEach((value, i) =>
          near(value, row.F_clamped[i] as number, 1e-5, 1e-7),
        );
    }
  });

  it('slopes of an anisotropic surface', () => {
    for (const row of primitives()['anisotropy_alpha'] as { r: number; a: number; alpha: [number, number] }[]) {
      ggxAlpha(row.r, row.a).forEach((value, i) => near(value, Math.max(row.alpha[i] as number, 1e-4), 1e-6));
    }
  });

  it('GGX: distribution, masking, visible normals, densities', () => {
    for (const row of primitives()['ggx'] as unknown as {
      alpha: [number, number];
      wo: Triple;
      u: [number, number];
      h: Triple;
      D: number;
      G1o: number;
      wi: Triple;
      G2_correlated: number;
    }[]) {
      const h = ggxSample(row.alpha, row.wo, row.u);
      h.forEach((value, i) => near(value, row.h[i] as number, 1e-5, 1e-6));
      near(ggxDistribution(row.alpha, row.h), row.D, 1e-5);
      near(ggxMasking(row.alpha, row.wo), row.G1o, 1e-6);
      if (row.wi[2] > 0) near(ggxMaskingShadowing(row.alpha, row.wo, row.wi), row.G2_correlated, 1e-6);
    }
  });

  it('EON diffuse', () => {
    for (const row of primitives()['eon'] as { rho: number; r: number; wo: Triple; wi: Triple; f: number }[]) {
      // The numbers use the closed form of the directional albedo, the lobe its polynomial fit.
      near(eon([row.rho, row.rho, row.rho], row.r, row.wo, row.wi)[0], row.f, 2e-3);
    }
  });

  it('energy tables', () => {
    type Row = {
      r: number;
      mu: number;
      E_F1_correlated: number;
      'eta1.5': { R_corr: number };
      'eta0.6667': { R_corr: number };
    };
    for (const row of primitives()['ggx_directional_albedo'] as unknown as Row[]) {
      near(1 - energyLost(row.r, row.mu), row.E_F1_correlated, 1e-3);
      near(
        energyAlbedo(0.2, row.r, row.mu) - energyTotalLost(0.2, row.r, row.mu) * fresnelMean(0.2),
        row['eta1.5'].R_corr,
        0,
        2.5e-3,
      );
      // Below the critical angle the share jumps within a few cells of the table.
      near(
        energyAlbedo(-0.2, row.r, row.mu) - energyTotalLost(-0.2, row.r, row.mu) * energyBounce(-0.2, row.r),
        row['eta0.6667'].R_corr,
        0,
        2e-2,
      );
    }
  });
});

describe('limits', () => {
  it('has no interface at index 1', () => {
    expect(fresnelDielectric(1, 0.3)).toBe(0);
    expect(dielectricEpsilon(1.5, 0)).toBe(0);
    expect(energyAlbedo(0, 0.5, 0.5)).toBe(0);
  });
  it('reflects everything at grazing and beyond the critical angle', () => {
    expect(fresnelDielectric(1.5, 0)).toBeCloseTo(1, 12);
    expect(fresnelDielectric(1 / 1.5, 0.7)).toBe(1);
  });
  it('makes F82 with a white tint Schlick', () => {
    expect(fresnelMetal([0.5, 0.5, 0.5], [1, 1, 1], 0.25)[0]).toBeCloseTo(0.5 + 0.5 * 0.75 ** 5, 12);
    expect(fresnelMetal([0.5, 0.5, 0.5], [0.3, 0.3, 0.3], 1 / 7)[0]).toBeCloseTo(0.3 * (0.5 + 0.5 * (6 / 7) ** 5), 12);
  });
});
