import { runCompute, testDevice } from '@glanz/gpu';
import { compose, wgslModule } from '@glanz/wgsl';
import { describe, expect, it } from 'vitest';
import {
  dielectricEpsilon,
  evalBsdf,
  fresnelDielectric,
  fresnelMean,
  phaseSample,
  prepareBsdf,
  sampleBsdf,
  subsurfaceAlbedo,
  subsurfaceMedium,
} from '../src/cpu/index';
import { resolveParameters, type OpenPbrVector } from '../src/parameters/index';
import { openpbrSubsurface, openPbrStruct, packOpenPbr, requiredFeatures } from '../src/wgsl/index';
import { gpuShader } from './gpu';
import { direction } from './integrate';
import { anyClear, uniform } from './random';
import { primitives } from './oracle/index';
import { sphereFurnace } from './sphere';

describe('subsurface', () => {
  it('single-scattering albedo against independent numbers', () => {
    const rows = primitives()['subsurface_albedo'] as unknown as {
      C: number;
      g: number;
      vdh: number;
      vdh_saunderson_eta15: number;
      K_r_eta15: number;
    }[];
    expect(rows.length).toBeGreaterThan(10);
    for (const row of rows) {
      expect(Math.abs(subsurfaceAlbedo(row.C, row.g, 0) - row.vdh)).toBeLessThan(1e-6);
      expect(Math.abs(subsurfaceAlbedo(row.C, row.g, row.K_r_eta15) - row.vdh_saunderson_eta15)).toBeLessThan(1e-6);
    }
  });

  /**
   * A random walk in a half space below a smooth interface: the part of the light that got in which comes out again.
   */
  function walk(color: number, eta: number, g: number, count: number, next: () => number): number {
    const albedo = subsurfaceAlbedo(color, g, fresnelMean(-dielectricEpsilon(eta, 1)));
    let out = 0;
    for (let i = 0; i < count; i++) {
      // Diffuse light from outside, refracted.
      const sine = Math.sqrt(next()) / eta;
      let d: OpenPbrVector = [sine, 0, -Math.sqrt(1 - sine * sine)];
      let z = 0;
      let weight = 1;
      for (let step = 0; step < 5000; step++) {
        z += d[2] * -Math.log(1 - next());
        if (z >= 0) {
          // Where it crosses, it leaves or is reflected.
          if (next() >= fresnelDielectric(1 / eta, d[2])) {
            out += weight;
            break;
          }
          z = 0;
          d = [d[0], d[1], -d[2]];
          continue;
        }
        weight *= albedo;
        if (weight < 0.1) {
          if (next() < 0.5) break;
          weight *= 2;
        }
        d = phaseSample(g, [-d[0], -d[1], -d[2]], [next(), next()]);
      }
    }
    return out / count;
  }

  // The standard error of what they carry is at most 0.007, with GLANZ_FULL half of that.
  const WALKS = process.env['GLANZ_FULL'] === undefined ? 5000 : 20_000;

  it('returns the colour asked for within 0.05: random walks below smooth interfaces (seed 80)', () => {
    const next = uniform(80);
    for (const eta of [1.33, 1.5, 1.8]) {
      for (const color of [0.2, 0.5, 0.8, 0.95]) {
        const got = walk(color, eta, eta === 1.5 ? 0.6 : 0, WALKS, next);
        expect(Math.abs(got - color), `${got} for ${color} at index ${eta}`).toBeLessThan(0.05);
      }
    }
  });

  it("has the mean free path as its medium's, and none behind a thin wall", () => {
    const p = resolveParameters({
      subsurface_weight: 1,
      subsurface_radius: 0.2,
      subsurface_radius_scale: [1, 0.5, 0.25],
    });
    subsurfaceMedium(p).extinction.forEach((value, i) => expect(value).toBeCloseTo([5, 10, 20][i] as number, 9));
    expect(subsurfaceMedium({ ...p, geometry_thin_walled: true }).extinction).toEqual([0, 0, 0]);
  });

  it('is chosen by its part of what is let through; both choices together carry all of it (seed 81)', () => {
    const next = uniform(81);
    const p = resolveParameters({
      transmission_weight: 0.5,
      transmission_color: [0.9, 0.5, 0.1],
      subsurface_weight: 0.6,
      specular_roughness: 0.3,
    });
    const wo = direction(0.7);
    const b = prepareBsdf(p, wo);
    const count = 60_000;
    const carried = { subsurface: [0, 0, 0], interior: [0, 0, 0] };
    for (let i = 0; i < count; i++) {
      const s = sampleBsdf(b, wo, [next(), next(), next()]);
      if (!s.transmitted || !s.valid) expect(s.subsurface).toBe(false);
      if (!s.valid || !s.transmitted) continue;
      const sum = s.subsurface ? carried.subsurface : carried.interior;
      s.weight.forEach((w, k) => (sum[k] = (sum[k] as number) + w / count));
    }
    const { transmitted } = sphereFurnace(p, wo);
    transmitted.forEach((value, k) => {
      const color = p.transmission_color[k] as number;
      // Half is transparent and tinted; of the rest, 0.6 is subsurface.
      // Four standard errors of a share of 60,000 samples are 0.008; the furnace's quadrature is good to 0.01.
      expect(Math.abs((carried.subsurface[k] as number) / value - 0.3 / (0.3 + 0.5 * color))).toBeLessThan(0.018);
      expect(Math.abs((carried.subsurface[k] as number) + (carried.interior[k] as number) - value)).toBeLessThan(0.01);
    });
  });

  it('of a thin wall splits diffuse light by the anisotropy', () => {
    for (const g of [-1, -0.2, 0.3, 1]) {
      const p = resolveParameters({
        subsurface_weight: 1,
        subsurface_color: [0.8, 0.6, 0.4],
        subsurface_scatter_anisotropy: g,
        geometry_thin_walled: true,
        specular_weight: 0,
      });
      const { reflected, transmitted } = sphereFurnace(p, direction(0.6));
      [0.8, 0.6, 0.4].forEach((color, k) => {
        expect(reflected[k]).toBeCloseTo((color * (1 - g)) / 2, 2);
        expect(transmitted[k]).toBeCloseTo((color * (1 + g)) / 2, 2);
      });
    }
  });

  it('is reciprocal through a thin wall', () => {
    const p = resolveParameters({
      subsurface_weight: 1,
      geometry_thin_walled: true,
      base_diffuse_roughness: 0.5,
      specular_roughness: 0.4,
    });
    const a = direction(0.7),
      [x, y, z] = direction(0.3, 2);
    const there = evalBsdf(prepareBsdf(p, a, { multipleScattering: false }), a, [x, y, -z])[0] / z;
    const back =
      evalBsdf(prepareBsdf(p, [x, y, z], { multipleScattering: false }), [x, y, z], [a[0], a[1], -a[2]])[0] / a[2];
    expect(there).toBeCloseTo(back, 10);
  });

  it('costs nothing where no material has any', () => {
    const code = (p: Parameters<typeof requiredFeatures>[0][number]) =>
      gpuShader(requiredFeatures([p])).code.replace(/\/\/.*/g, '');
    expect(
      code({ transmission_weight: 1 })
        .replace(/^ *subsurface_\w+: \w+,?$/gm, '')
        .replace('subsurface: bool,', '')
        .replace('s.subsurface', ''),
    ).not.toContain('subsurface');
    expect(code({ subsurface_weight: 1 })).toContain('fn openpbr_subsurface_medium');
    expect(code({ subsurface_weight: 1 })).not.toContain('ThinSubsurface');
  });
});

it('WGSL against its CPU twin: the subsurface medium, 256 random surfaces (seed 82)', async () => {
  const next = uniform(82);
  const surfaces = Array.from({ length: 256 }, () => anyClear(next, 0.2));
  const host = wgslModule(
    'test/host',
    /* wgsl */ `
@group(0) @binding(0) var<storage, read> materials: array<OpenPbrParameters>;
@group(0) @binding(1) var<storage, read_write> results: array<vec4f>;
fn openpbr_table_dielectric(coords: vec3f) -> f32 { return 0.0; }
fn openpbr_table_conductor(coords: vec2f) -> f32 { return 0.0; }
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  let medium = openpbr_subsurface_medium(materials[id.x]);
  results[2u * id.x] = vec4f(medium.extinction, medium.anisotropy);
  results[2u * id.x + 1u] = vec4f(medium.scattering, 0.0);
}`,
    [openpbrSubsurface],
  );
  const materials = openPbrStruct.allocate(surfaces.length);
  surfaces.forEach((p, i) => packOpenPbr(materials, i, p));
  const out = new Float32Array(
    await runCompute(await testDevice(), compose([host], { flags: { ...requiredFeatures(surfaces) } }).code, {
      inputs: [materials],
      outputBytes: surfaces.length * 32,
      workgroups: surfaces.length / 64,
    }),
  );
  surfaces.forEach((p, i) => {
    const { extinction, scattering, anisotropy } = subsurfaceMedium(p);
    [...extinction, anisotropy, ...scattering].forEach((value, k) =>
      expect(Math.abs((out[8 * i + k] as number) - value), `word ${k} of ${i}`).toBeLessThanOrEqual(
        1e-4 * Math.max(Math.abs(value), 1e-3),
      ),
    );
  });
});
