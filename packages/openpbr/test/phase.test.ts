import { runCompute, testDevice } from '@glanz/gpu';
import { compose, wgslModule } from '@glanz/wgsl';
import { describe, expect, it } from 'vitest';
import { gaussLegendre } from '../scripts/microfacet.mjs';
import { dispersedIor, phaseEval, phaseSample, transmissionMedium } from '../src/cpu/index';
import type { OpenPbrVector } from '../src/parameters/index';
import { openpbrMedium, openpbrPhase, openPbrStruct, packOpenPbr, requiredFeatures } from '../src/wgsl/index';
import { anyClear, single, uniform } from './random';

const GS = [-0.9, -0.5, 0, 1e-4, 0.3, 0.8, 0.95];

function anyDirection(next: () => number): OpenPbrVector {
  const z = 2 * next() - 1;
  const phi = 2 * Math.PI * next();
  return single([Math.sqrt(1 - z * z) * Math.cos(phi), Math.sqrt(1 - z * z) * Math.sin(phi), z]);
}

describe('the phase function', () => {
  it('integrates to 1, with g as its mean cosine', () => {
    const { nodes, weights } = gaussLegendre(400);
    for (const g of GS) {
      let total = 0,
        mean = 0;
      nodes.forEach((node, i) => {
        const c = 2 * node - 1;
        const value = 4 * Math.PI * (weights[i] as number) * phaseEval(g, [0, 0, -1], [Math.sqrt(1 - c * c), 0, c]);
        total += value;
        mean += c * value;
      });
      expect(total).toBeCloseTo(1, 6);
      expect(mean).toBeCloseTo(g, 6);
    }
  });

  it('is sampled exactly: the share of directions within a cone is its integral', () => {
    for (const g of GS) {
      const next = uniform(70);
      const wo = anyDirection(next);
      for (const u of [0.1, 0.3, 0.5, 0.7, 0.9]) {
        const wi = phaseSample(g, wo, [next(), u]);
        expect(Math.hypot(...wi)).toBeCloseTo(1, 6);
        const c = -(wo[0] * wi[0] + wo[1] * wi[1] + wo[2] * wi[2]);
        // ∫ from c to 1 of 2π p(c) dc, in closed form; for g near 0 that of an even distribution.
        const inCone =
          Math.abs(g) < 1e-3
            ? (1 - c) / 2
            : ((1 - g * g) / (2 * g)) * (1 / (1 - g) - 1 / Math.sqrt(1 + g * g - 2 * g * c));
        expect(Math.abs(inCone - u)).toBeLessThan(1e-4);
      }
    }
  });
});

it('WGSL against its CPU twin: phase function, medium, dispersion, 512 random cases (seed 71)', async () => {
  const next = uniform(71);
  const cases = Array.from({ length: 512 }, () => ({
    p: anyClear(next, 0.2),
    wo: anyDirection(next),
    wi: anyDirection(next),
    u: single([next(), next(), 0]),
    wavelength: Math.fround(380 + 400 * next()),
  }));
  const host = wgslModule(
    'test/host',
    /* wgsl */ `
struct Case { wo: vec4f, wi: vec4f, u: vec4f }
struct Result { wi: vec3f, value: f32, extinction: vec3f, ior: f32, scattering: vec3f, g: f32 }
@group(0) @binding(0) var<storage, read> materials: array<OpenPbrParameters>;
@group(0) @binding(1) var<storage, read> cases: array<Case>;
@group(0) @binding(2) var<storage, read_write> results: array<Result>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  let medium = openpbr_medium(materials[id.x]);
  let one = cases[id.x];
  results[id.x] = Result(
    openpbr_phase_sample(medium.anisotropy, one.wo.xyz, one.u.xy), openpbr_phase_eval(medium.anisotropy, one.wo.xyz, one.wi.xyz),
    medium.extinction, openpbr_dispersed_ior(materials[id.x], one.u.w), medium.scattering, medium.anisotropy);
}`,
    [openpbrMedium, openpbrPhase],
  );
  const materials = openPbrStruct.allocate(cases.length);
  cases.forEach(({ p }, i) => packOpenPbr(materials, i, p));
  const inputs = new Float32Array(cases.flatMap(({ wo, wi, u, wavelength }) => [...wo, 0, ...wi, 0, ...u, wavelength]));
  const out = new Float32Array(
    await runCompute(await testDevice(), compose([host], { flags: { ...requiredFeatures([]) } }).code, {
      inputs: [materials, inputs],
      outputBytes: cases.length * 48,
      workgroups: cases.length / 64,
    }),
  );
  cases.forEach(({ p, wo, wi, u, wavelength }, i) => {
    const medium = transmissionMedium(p);
    const expected = [
      ...phaseSample(medium.anisotropy, wo, [u[0], u[1]]),
      phaseEval(medium.anisotropy, wo, wi),
      ...medium.extinction,
      dispersedIor(p, wavelength),
      ...medium.scattering,
      medium.anisotropy,
    ];
    expected.forEach((value, k) =>
      expect(
        Math.abs((out[12 * i + k] as number) - value),
        `word ${k} of case ${i}: ${out[12 * i + k]} for ${value}`,
      ).toBeLessThanOrEqual(1e-4 * Math.max(Math.abs(value), k < 3 ? 1 : 1e-3)),
    );
  });
});
