import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { gaussLegendre, interfaceAlbedo } from '../scripts/microfacet.mjs';
import { interfaceEnergy } from '../src/cpu/dielectric';
import { energyAlbedoMean } from '../src/cpu/energy';
import { ggxAlpha } from '../src/cpu/ggx';
import { insideEnergy } from '../src/cpu/inside';
import { resolveParameters } from '../src/parameters/index';
import { OPENPBR_TABLES } from '../src/tables/index';
import { requiredFeatures } from '../src/wgsl/index';
import openpbrInside from '../src/wgsl/inside.wesl';
import { direction, furnaceBelowOne } from './integrate';
import { single, uniform } from './random';
import { sphereFurnace } from './sphere';

afterEach(() => expectNoGpuErrors());

const round = (roughness: number) => [roughness * roughness, roughness * roughness] as const;

/** Interfaces of indices 1.001 to 3.3 from inside, a third of them below 1.1. */
function interfaces(count: number, seed: number, minStep = 1e-3) {
  const next = uniform(seed);
  return Array.from({ length: count }, () => {
    const eta = next() < 0.35 ? 1 - minStep * (0.1 / minStep) ** next() : 0.3 + 0.65 * next();
    const roughness = Math.fround(0.05 + 0.95 * next());
    return { eta: Math.fround(eta), roughness, wo: single(direction(0.01 + 0.99 * next() ** 1.5, 7 * next())) };
  });
}

describe('what a dielectric seen from its denser side keeps by single scattering', () => {
  it('is that of a quadrature of 30,000 facets within 0.0015, 100 interfaces (seed 62)', () => {
    const exact = interfaceAlbedo(200, 160);
    for (const { eta, roughness, wo } of interfaces(100, 62, 2e-3)) {
      const { reflect, transmit } = exact([...round(roughness)], eta, wo[2]);
      const [reflected, through] = insideEnergy(eta, round(roughness), wo);
      const at = `index ${eta}, roughness ${roughness}, wo ${wo.join(' ')}`;
      expect(Math.abs(reflected - reflect), at).toBeLessThan(0.0015);
      expect(Math.abs(through - transmit), at).toBeLessThan(0.0015);
    }
  });

  it('is finite at the ends', () => {
    for (const eta of [1e-3, 0.3, 0.9990004, 1 - 1e-6, 1 - 1e-12]) {
      for (const roughness of [0.01, 0.05, 0.5, 1]) {
        for (const wo of [
          [0, 0, 1],
          [1, 0, 1e-5],
          [1, 0, 1e-30],
          [0, 1, 1e-3],
          [0.6, 0, 0.8],
        ] as const) {
          const [reflected, through] = insideEnergy(eta, round(roughness), wo);
          expect(
            reflected >= 0 && through >= 0 && reflected + through < 1.01,
            `${reflected} ${through} for index ${eta}, roughness ${roughness}, wo ${wo.join(' ')}`,
          ).toBe(true);
        }
      }
    }
  });

  it('is the same in WGSL within 2e-5, 4096 interfaces of indices from 1.05 on (seed 63)', async () => {
    const list = interfaces(4096, 63, 0.05);
    const { data, width, height } = OPENPBR_TABLES.conductor;
    const host = wgslModule(
      'test/host',
      `@group(0) @binding(0) var<storage, read> surfaces: array<vec4f>;
@group(0) @binding(1) var<storage, read> mirror: array<f32>;
@group(0) @binding(2) var<storage, read_write> results: array<vec2f>;
fn openpbr_table_conductor(coords: vec2f) -> f32 {
  let at = clamp(coords * vec2f(${width}.0, ${height}.0) - 0.5, vec2f(0.0), vec2f(${width - 1}.0, ${height - 1}.0));
  let low = min(vec2u(at), vec2u(${width - 2}u, ${height - 2}u));
  let f = at - vec2f(low);
  let first = low.y * ${width}u + low.x;
  return mix(mix(mirror[first], mirror[first + 1u], f.x), mix(mirror[first + ${width}u], mirror[first + ${width + 1}u], f.x), f.y);
}
fn openpbr_table_dielectric(coords: vec3f) -> f32 { return 0.0; }
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= arrayLength(&results)) { return; }
  let a = surfaces[2u * id.x];
  results[id.x] = openpbr_inside(a.x, vec2f(a.y * a.y), surfaces[2u * id.x + 1u].xyz);
}`,
      [openpbrInside],
    );
    const flags = requiredFeatures([{ transmission_weight: 1 }]);
    const inputs = [new Float32Array(list.flatMap(({ eta, roughness, wo }) => [eta, roughness, 0, 0, ...wo, 0])), data];
    const results = new Float32Array(
      await runCompute(await testDevice(), compose([host], { flags: { ...flags } }).code, {
        inputs,
        outputBytes: list.length * 8,
        workgroups: list.length / 64,
      }),
    );
    list.forEach(({ eta, roughness, wo }, i) => {
      const at = `index ${eta}, roughness ${roughness}, wo ${wo.join(' ')}`;
      insideEnergy(eta, round(roughness), wo).forEach((value, k) =>
        expect(Math.abs((results[2 * i + k] as number) - value), at).toBeLessThan(2e-5),
      );
    });
  });
});

describe('white furnace near the horizon', () => {
  const ROUGHNESSES = [0.1, 0.3, 0.6, 1];
  it('returns 0.997 to 1.002 of light on opaque dielectrics of index 0.9 to 0.999', () => {
    for (const specular_ior of [0.9, 0.99, 0.999]) {
      for (const specular_roughness of ROUGHNESSES) {
        const p = resolveParameters({ base_color: [1, 1, 1], specular_ior, specular_roughness });
        const sum = furnaceBelowOne(p, direction(0.02), 32);
        expect(sum, `index ${specular_ior}, roughness ${specular_roughness}`).toBeGreaterThan(0.997);
        expect(sum, `index ${specular_ior}, roughness ${specular_roughness}`).toBeLessThan(1.002);
      }
    }
  });
  it('returns 0.997 to 1.002 inside of glass of index 1.001 to 1.05', () => {
    for (const specular_ior of [1.0005, 1.001, 1.002, 1.01, 1.05]) {
      for (const specular_roughness of ROUGHNESSES) {
        const p = resolveParameters({ transmission_weight: 1, specular_ior, specular_roughness });
        const { reflected, transmitted } = sphereFurnace(p, direction(0.02), { inside: true }, 40);
        expect(reflected[1] + transmitted[1], `index ${specular_ior}, roughness ${specular_roughness}`).toBeGreaterThan(
          0.997,
        );
        expect(reflected[1] + transmitted[1], `index ${specular_ior}, roughness ${specular_roughness}`).toBeLessThan(
          1.002,
        );
      }
    }
  });
});

describe('the mean of what goes through from inside', () => {
  // 16 nodes on either side of the critical angle, where the albedo has an edge.
  const { nodes, weights } = gaussLegendre(16);
  const throughOf = (epsilon: number, roughness: number) => {
    const eta = (1 + epsilon) / (1 - epsilon);
    const critical = Math.sqrt(1 - eta * eta);
    let sum = 0;
    for (const [i, x] of nodes.entries())
      for (const [mu, step] of [
        [critical * (1 - x * x), critical],
        [critical + (1 - critical) * x * x, 1 - critical],
      ] as const) {
        const wo = [Math.sqrt(1 - mu * mu), 0, mu] as const;
        const { albedo } = interfaceEnergy(epsilon, roughness, ggxAlpha(roughness, 0), wo, mu, true, false);
        sum += 4 * (1 - albedo) * mu * step * x * weights[i]!;
      }
    return sum;
  };
  it.each([
    [1.001, 1.6, 0.005],
    [1.6, 3, 0.013],
  ])('is tabulated for indices from %f to %f within %f of its sum', (from, to, tolerance) => {
    for (let i = 0; i <= 12; i++)
      for (let j = 0; j <= 12; j++) {
        const ior = from + ((to - from) * i) / 12;
        const epsilon = (1 - ior) / (1 + ior);
        const error = (1 - energyAlbedoMean(epsilon, j / 12)) / throughOf(epsilon, j / 12) - 1;
        expect(Math.abs(error), `index ${ior}, roughness ${j / 12}`).toBeLessThan(tolerance);
      }
  });
});
