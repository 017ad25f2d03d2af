import { describe, expect, it } from 'vitest';
import {
  evalBsdf,
  evalPdfBsdf,
  ggxAlpha,
  ggxMasking,
  ggxMaskingShadowing,
  pdfBsdf,
  prepareBsdf,
  sampleBsdf,
} from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters, type OpenPbrVector } from '../src/parameters/index';
import { requiredFeatures } from '../src/wgsl/index';
import { expectTwins } from './agree';
import { gpuShader, onGpu, type GpuCase } from './gpu';
import { direction, furnace } from './integrate';
import { anyCoated, single, uniform, upperDirection } from './random';
import { oracle } from './oracle/index';

const dot = (a: OpenPbrVector, b: OpenPbrVector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

describe('a coat with a normal of its own', () => {
  it('against an independent implementation: every pair of its lobe, and all lobes together', () => {
    const setting = oracle().settings.find(({ id }) => id === 'coat_normal_tilt')!;
    const p = resolveParameters(setting.params);
    const alone = resolveParameters({ ...setting.params, base_weight: 0, specular_weight: 0 });
    const n = setting.params.geometry_coat_normal!;
    // Any frame will do: the coat is round.
    const local = (w: OpenPbrVector): OpenPbrVector => [n[2] * w[0] - n[0] * w[2], w[1], dot(n, w)];
    const alpha = ggxAlpha(p.coat_roughness, 0);
    const differences: number[] = [];
    let compared = 0;
    for (const { o, wi, f, L } of setting.pairs) {
      const wo = setting.wo[o]!;
      // Seen or lit from below the coat's plane, the oracle has its own way out.
      if (Math.min(wo[2], wi[2], dot(n, wo), dot(n, wi)) <= 0.02) continue;
      // The oracle's masking is separable.
      const correlation =
        ggxMaskingShadowing(alpha, local(wo), local(wi)) /
        (ggxMasking(alpha, local(wo)) * ggxMasking(alpha, local(wi)));
      const coat = L === 'spec' ? 0 : (L?.coat?.[0] ?? 0);
      const value = evalBsdf(prepareBsdf(alone, wo, { multipleScattering: false }), wo, wi)[0];
      expect(
        Math.abs(value - coat * correlation),
        `${value} for ${coat * correlation} at wo ${wo}, wi ${wi}`,
      ).toBeLessThanOrEqual(Math.max(0.01 * value, 1e-4));
      const all = evalBsdf(prepareBsdf(p, wo), wo, wi)[0],
        other = f[0] + coat * (correlation - 1);
      differences.push(Math.abs(all - other) / Math.max(all, other, 0.02));
      compared++;
    }
    expect(compared).toBeGreaterThan(30);
    differences.sort((a, b) => a - b);
    const { median, p90 } = setting.tol.f!;
    expect(differences[Math.floor(compared / 2)]).toBeLessThanOrEqual(median!);
    expect(differences[Math.floor(0.9 * compared)]).toBeLessThanOrEqual(p90!);
  });

  it("that is the base's is as without", () => {
    const next = uniform(11);
    for (let i = 0; i < 200; i++) {
      const p = anyCoated(next, 0.1);
      const [wo, wi] = [upperDirection(next, 0.02), upperDirection(next, 0.02)];
      const plain = evalPdfBsdf(prepareBsdf(p, wo), wo, wi);
      const framed = evalPdfBsdf(
        prepareBsdf({ ...p, geometry_coat_normal: [0, 0, 1], geometry_coat_tangent: [1, 0, 0] }, wo),
        wo,
        wi,
      );
      framed.f.forEach((value, k) => expect(value).toBeCloseTo(plain.f[k]!, 10));
      expect(framed.pdf).toBeCloseTo(plain.pdf, 10);
    }
  });

  it('over a base that is turned with it is the same surface, turned', () => {
    // Both frames are turned about the normal: the highlight turns, whatever the coat's tangent is called.
    const p = resolveParameters({
      base_metalness: 1,
      specular_weight: 0,
      coat_weight: 1,
      coat_roughness: 0.5,
      coat_roughness_anisotropy: 0.8,
    });
    const angle = 0.7,
      c = Math.cos(angle),
      s = Math.sin(angle);
    const turned = { ...p, geometry_coat_tangent: [c, s, 0] as const };
    const turn = ([x, y, z]: OpenPbrVector): OpenPbrVector => [c * x - s * y, s * x + c * y, z];
    const next = uniform(12);
    for (let i = 0; i < 100; i++) {
      const [wo, wi] = [upperDirection(next, 0.05), upperDirection(next, 0.05)];
      expect(evalBsdf(prepareBsdf(turned, turn(wo)), turn(wo), turn(wi))[0]).toBeCloseTo(
        evalBsdf(prepareBsdf(p, wo), wo, wi)[0],
        9,
      );
    }
  });

  const TILTS: readonly Partial<OpenPbrParameters>[] = [
    { geometry_coat_normal: [0.25881905, 0, 0.96592583] },
    { geometry_coat_normal: [-0.3, 0.4, 0.8660254], geometry_coat_tangent: [0, 1, 0], coat_roughness_anisotropy: 0.6 },
  ];
  // By default only the second, whose coat is anisotropic besides; with GLANZ_FULL both.
  it.each(TILTS.map((tilt, i) => [i, tilt] as const).slice(process.env['GLANZ_FULL'] === undefined ? 1 : 0))(
    'tilt %i: samples follow their density, and weights are f·cos/pdf',
    (index, tilt) => {
      const p = resolveParameters({ base_color: [0.8, 0.5, 0.2], coat_weight: 0.9, coat_roughness: 0.5, ...tilt });
      for (const wo of [direction(0.9), direction(0.4)]) {
        const b = prepareBsdf(p, wo);
        const next = uniform(40 + index);
        const count = 200_000,
          rings = 8,
          sectors = 16;
        const hits = new Float64Array(rings * sectors),
          expected = new Float64Array(rings * sectors);
        let sum = 0,
          squares = 0;
        for (let i = 0; i < count; i++) {
          const s = sampleBsdf(b, wo, [next(), next(), next()]);
          if (!s.valid) continue;
          const { f, pdf } = evalPdfBsdf(b, wo, s.wi);
          if (i < 2000)
            s.weight.forEach((w, k) => expect(Math.abs(w - f[k]! / pdf)).toBeLessThanOrEqual(1e-6 * Math.max(w, 1)));
          sum += s.weight[0];
          squares += s.weight[0] ** 2;
          const sector = Math.floor(((Math.atan2(s.wi[1], s.wi[0]) / (2 * Math.PI) + 1) % 1) * sectors);
          hits[Math.min(Math.floor(s.wi[2] * rings), rings - 1) * sectors + sector]!++;
        }
        const fine = 24;
        for (let i = 0; i < rings * fine; i++) {
          for (let j = 0; j < sectors * fine; j++) {
            const wi = direction((i + 0.5) / (rings * fine), (2 * Math.PI * (j + 0.5)) / (sectors * fine));
            expected[Math.floor(i / fine) * sectors + Math.floor(j / fine)]! +=
              (count * 2 * Math.PI * pdfBsdf(b, wo, wi)) / (rings * fine * sectors * fine);
          }
        }
        let chi2 = 0,
          freedom = 0;
        expected.forEach((value, bin) => {
          if (value < 10) return;
          chi2 += (hits[bin]! - value) ** 2 / value;
          freedom++;
        });
        // The mean is the freedom, its standard deviation √(2·freedom).
        expect(chi2).toBeLessThan(freedom + 5 * Math.sqrt(2 * freedom));
        const { albedo } = furnace(p, wo, {}, 96);
        expect(Math.abs(sum / count - albedo[0])).toBeLessThan(
          5 * Math.sqrt((squares / count - (sum / count) ** 2) / count) + 2e-3,
        );
      }
    },
  );

  it('makes no energy to speak of, and nothing that is not a number', () => {
    const next = uniform(13);
    for (let i = 0; i < 3000; i++) {
      const p = {
        ...anyCoated(next, 0),
        geometry_coat_normal: upperDirection(next, 0),
        geometry_coat_tangent: next() < 0.5 ? null : upperDirection(next, 0),
      };
      const [wo, wi] = [upperDirection(next, 1e-4), upperDirection(next, 1e-4)];
      const b = prepareBsdf(p, wo);
      const { f, pdf } = evalPdfBsdf(b, wo, wi);
      const s = sampleBsdf(b, wo, [next(), next(), next()]);
      expect([...f, pdf, ...s.weight, s.pdf].every((value) => Number.isFinite(value) && value >= 0)).toBe(true);
    }
    for (const tilt of TILTS) {
      for (const mu of [1, 0.7, 0.4]) {
        for (const phi of [0, 1.5, 3, 4.5])
          expect(
            furnace(
              resolveParameters({
                base_color: [1, 1, 1],
                specular_weight: 0,
                coat_weight: 1,
                coat_roughness: 0.4,
                ...tilt,
              }),
              direction(mu, phi),
              {},
              48,
            ).albedo[0],
          ).toBeLessThan(1.03);
      }
    }
  });

  it('is compiled only where a coat has one', () => {
    expect(requiredFeatures([{ coat_weight: 1 }]).OPENPBR_COAT_FRAME).toBe(false);
    expect(requiredFeatures([{ geometry_coat_normal: [0, 0, 1] }]).OPENPBR_COAT_FRAME).toBe(false);
    expect(requiredFeatures([{ coat_weight: 1, geometry_coat_tangent: [0, 1, 0] }]).OPENPBR_COAT_FRAME).toBe(true);
    expect(requiredFeatures([{ coat_weight: 1 }], { textured: ['geometry_coat_normal'] }).OPENPBR_COAT_FRAME).toBe(
      true,
    );
    expect(gpuShader(requiredFeatures([{ coat_weight: 1 }])).code).not.toContain('openpbr_coat_frame');
  });

  it('on the GPU is its twin, 1024 random surfaces (seed 14)', async () => {
    const next = uniform(14);
    const cases: GpuCase[] = Array.from({ length: 1024 }, () => {
      const tilt = single([0.5 * next() - 0.25, 0.5 * next() - 0.25, 1]);
      const length = Math.hypot(...tilt);
      const parameters = {
        ...anyCoated(next, 0),
        geometry_coat_normal: single(tilt.map((x) => x / length) as unknown as OpenPbrVector),
        geometry_coat_tangent: next() < 0.5 ? null : single([Math.SQRT1_2, Math.SQRT1_2, 0]),
      };
      return {
        parameters,
        wo: upperDirection(next),
        wi: upperDirection(next),
        u: single([next(), next(), next() * 0.999]),
      };
    });
    const flags = { ...requiredFeatures(cases.map(({ parameters }) => parameters)) };
    expect(flags.OPENPBR_COAT_FRAME).toBe(true);
    const sampled = expectTwins(await onGpu(flags, cases), cases);
    expect(sampled).toBeGreaterThan(700);
  });
});
