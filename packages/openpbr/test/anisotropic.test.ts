import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { interfaceAlbedo } from '../scripts/microfacet.mjs';
import { evalBsdf, ggxAlpha, prepareBsdf, sampleBsdf } from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters } from '../src/parameters/index';
import { anisotropicEnergy } from '../src/cpu/anisotropic';
import { requiredFeatures } from '../src/wgsl/index';
import openpbrAnisotropic from '../src/wgsl/anisotropic.wesl';
import openpbrEnergy from '../src/wgsl/energy.wesl';
import { direction, whiteDielectric, whiteMetal } from './integrate';
import { tableData, TABLES_WGSL } from './gpu';
import { single, uniform, upperDirection } from './random';

afterEach(() => expectNoGpuErrors());

/** Interfaces of indices 1.05 to 2.5, from either side; mild ones from outside, with anisotropy up to 0.31. */
function interfaces(count: number, seed: number, mild = false) {
  const next = uniform(seed);
  return Array.from({ length: count }, () => {
    const index = 1.05 + 1.45 * next();
    const roughness = Math.fround(0.1 + 0.9 * next());
    const anisotropy = Math.fround(mild ? 0.31 * next() : 0.1 + 0.85 * next());
    const mu = 0.02 + 0.98 * next();
    return {
      eta: Math.fround(mild || next() < 0.3 ? index : 1 / index),
      roughness,
      anisotropy,
      wo: single(direction(mu, 7 * next())),
    };
  });
}

describe('what interfaces with anisotropic highlights keep by single scattering', () => {
  it.each([
    ['60 interfaces (seed 60)', 60, false],
    ['60 of mild anisotropy from outside, which have facets of their own (seed 62)', 62, true],
  ])('is that of a quadrature of 90,000 facets within 0.003, %s', (_, seed, mild) => {
    const exact = interfaceAlbedo(300, 300);
    for (const { eta, roughness, anisotropy, wo } of interfaces(60, seed, mild)) {
      const alpha = ggxAlpha(roughness, anisotropy);
      const { reflect, transmit } = exact([...alpha], eta, wo[2], Math.atan2(wo[1], wo[0]));
      const [reflected, through] = anisotropicEnergy(eta, alpha, wo);
      const at = `index ${eta}, slopes ${alpha.join(' ')}, wo ${wo.join(' ')}`;
      expect(Math.abs(reflected + through - reflect - transmit), at).toBeLessThan(0.003);
      expect(Math.abs(reflected - reflect), at).toBeLessThan(0.003);
    }
  });

  it('is finite at the ends', () => {
    for (const eta of [1e-3, 0.3, 1 - 1e-12, 1, 1 + 1e-12, 3, 1e3]) {
      for (const [roughness, anisotropy] of [
        [0, 1],
        [1, 1],
        [1, 1e-9],
        [0.5, 0.999],
      ] as const) {
        for (const wo of [
          [0, 0, 1],
          [1, 0, 1e-5],
          [0, 1, 1e-5],
          [0.6, 0, 0.8],
        ] as const) {
          const [reflected, through] = anisotropicEnergy(eta, ggxAlpha(roughness, anisotropy), wo);
          expect(
            reflected >= 0 && through >= 0 && reflected + through < 1.01,
            `${reflected} ${through} for index ${eta}, roughness ${roughness}, wo ${wo.join(' ')}`,
          ).toBe(true);
        }
      }
    }
  });

  it('is the same in WGSL within 1e-5, 4096 interfaces (seed 61)', async () => {
    const list = interfaces(4096, 61);
    // The index of the other interface that one sum is for, from outside.
    const second = Math.fround(1.7);
    const host = wgslModule(
      'test/host',
      `@group(0) @binding(0) var<storage, read> surfaces: array<vec4f>;
@group(0) @binding(1) var<storage, read> tables: array<f32>;
@group(0) @binding(2) var<storage, read_write> results: array<vec4f>;
${TABLES_WGSL}
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= arrayLength(&results)) { return; }
  let a = surfaces[2u * id.x];
  let alpha = openpbr_alpha(a.y, a.z);
  let wo = surfaces[2u * id.x + 1u].xyz;
  results[id.x] = openpbr_anisotropic(a.xw, alpha, wo, openpbr_conductor_loss(alpha, a.y, wo, wo.z));
}`,
      [openpbrAnisotropic, openpbrEnergy],
    );
    const flags = requiredFeatures([{ transmission_weight: 1, specular_roughness_anisotropy: 0.5 }]);
    const inputs = [
      new Float32Array(
        list.flatMap(({ eta, roughness, anisotropy, wo }) => [eta, roughness, anisotropy, second, ...wo, 0]),
      ),
      tableData(),
    ];
    const results = new Float32Array(
      await runCompute(await testDevice(), compose([host], { flags: { ...flags } }).code, {
        inputs,
        outputBytes: list.length * 16,
        workgroups: list.length / 64,
      }),
    );
    list.forEach(({ eta, roughness, anisotropy, wo }, i) => {
      const at = `index ${eta}, roughness ${roughness}, anisotropy ${anisotropy}, wo ${wo.join(' ')}`;
      for (const [which, index] of [eta, eta > 1 ? second : eta].entries()) {
        anisotropicEnergy(index, ggxAlpha(roughness, anisotropy), wo).forEach((value, k) =>
          expect(Math.abs((results[4 * i + 2 * k + which] as number) - value), at).toBeLessThan(1e-5),
        );
      }
    });
  });
});

describe('anisotropic metal', () => {
  it('returns all light within 0.003 at every roughness, anisotropy and angle: 60 by 5 random views (seed 63)', () => {
    const next = uniform(63);
    for (const roughness of [0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9, 1]) {
      for (const anisotropy of [0.2, 0.5, 0.8, 0.95, 1]) {
        for (let i = 0; i < 5; i++) {
          const mu = i === 0 ? 1 : i < 3 ? 0.003 + next() ** 2 * 0.997 : 0.02 + 0.98 * next();
          // Half of them nearly across the long slopes, where it changes fast.
          const phi = next() < 0.5 ? (next() * Math.PI) / 2 : Math.PI / 2 - 0.4 * next() ** 2;
          const sum = whiteMetal(roughness, anisotropy, direction(mu, phi));
          expect(
            Math.abs(sum - 1),
            `${sum} for roughness ${roughness}, anisotropy ${anisotropy}, cosine ${mu}, azimuth ${phi}`,
          ).toBeLessThan(0.003);
        }
      }
    }
  });

  it('is reciprocal with all its scattering: 2000 random metals and pairs of directions (seed 64)', () => {
    const next = uniform(64);
    for (let i = 0; i < 2000; i++) {
      const p = resolveParameters({
        base_metalness: 1,
        base_color: [next(), next(), next()],
        specular_color: [next(), next(), next()],
        specular_roughness: next(),
        specular_roughness_anisotropy: next(),
      });
      const [a, b] = [upperDirection(next, 0.001), upperDirection(next, 0.001)];
      const there = evalBsdf(prepareBsdf(p, a), a, b);
      const back = evalBsdf(prepareBsdf(p, b), b, a);
      // Of smooth metals, which are deltas, both are 0.
      there.forEach((value, k) =>
        expect(Math.abs(value * a[2] - (back[k] as number) * b[2]), JSON.stringify({ p, a, b })).toBeLessThanOrEqual(
          1e-6 * value * a[2],
        ),
      );
    }
  });
});

describe('anisotropic dielectrics', () => {
  const surfaces = (seed: number, fixed: Partial<OpenPbrParameters>) => {
    const next = uniform(seed);
    return Array.from({ length: 60 }, () => {
      const p = resolveParameters({
        base_color: [1, 1, 1],
        specular_ior: 1.1 + 1.3 * next(),
        specular_roughness: 0.03 + 0.97 * next(),
        specular_roughness_anisotropy: 0.2 + 0.75 * next(),
        ...fixed,
      });
      const mu = 0.02 + 0.98 * next() ** 1.5;
      // Half of them nearly across the long slopes, where it changes fast.
      return { p, wo: direction(mu, next() < 0.5 ? (next() * Math.PI) / 2 : Math.PI / 2 - 0.4 * next() ** 2) };
    });
  };
  for (const [name, seed, fixed, inside] of [
    ['glass', 65, { transmission_weight: 1 }, false],
    ['glass from inside', 66, { transmission_weight: 1 }, true],
    ['dielectrics over diffuse', 67, {}, false],
  ] as const) {
    it(`${name}: all light within 0.003, 60 random indices, roughnesses, anisotropies and views (seed ${seed})`, () => {
      for (const { p, wo } of surfaces(seed, fixed)) {
        const sum = whiteDielectric(p, wo, inside);
        expect(
          Math.abs(sum - 1),
          `${sum} for index ${p.specular_ior}, roughness ${p.specular_roughness}, anisotropy ${p.specular_roughness_anisotropy}, wo ${wo.join(' ')}`,
        ).toBeLessThan(0.003);
      }
    });
  }

  it('give back as much by samples as by quadrature, within 4e-4', () => {
    // Numbers as evenly spread as these (Roberts' R₃ sequence) know the mean of the weights five times better than
    // random ones.
    const count = 1 << 17;
    for (const [fixed, inside, roughness, anisotropy, mu, phi] of [
      [{ transmission_weight: 1 }, false, 0.7, 0.9, 0.3, 1.57],
      [{ transmission_weight: 1 }, true, 0.2, 0.5, 0.2, 0.8],
      [{}, false, 0.5, 0.9, 1, 0],
    ] as const) {
      const p = resolveParameters({
        base_color: [1, 1, 1],
        specular_roughness: roughness,
        specular_roughness_anisotropy: anisotropy,
        ...fixed,
      });
      const wo = direction(mu, phi);
      const b = prepareBsdf(p, wo, { inside });
      let sum = 0;
      for (let i = 0; i < count; i++) {
        const at = (step: number): number => (0.5 + step * i) % 1;
        sum += sampleBsdf(b, wo, [at(0.8191725134), at(0.6710436067), at(0.5497004779)]).weight[1];
      }
      expect(
        Math.abs(sum / count - whiteDielectric(p, wo, inside)),
        JSON.stringify({ fixed, inside, roughness }),
      ).toBeLessThan(4e-4);
    }
  });
});
