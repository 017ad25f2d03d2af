import { expect } from 'vitest';
import { albedoBsdf, emittedRadiance, evalPdfBsdf, prepareBsdf, sampleBsdf, type BsdfSample } from '../src/cpu/index';
import type { OpenPbrVector } from '../src/parameters/index';
import type { GpuCase, GpuResult } from './gpu';

/** How far the shader may be from its twin, relatively; and below which value the difference is absolute. */
const LIMIT = 1e-4;
const FLOOR = 1e-4;
/** The last digit of a number in single precision, relatively. */
const DIGIT = 2 ** -23;
/**
 * Shares of the energy are sums of up to 160 numbers in single precision, or 1 less one: they are good to this,
 * whatever they are.
 */
const SHARE = 2 ** -21;

/**
 * How much of values single precision cannot tell: the sum, over all coordinates of the vectors, of the largest change
 * of the value when that coordinate's last digit changes. A value that does not come out as it went in is a jump, and
 * left out, so that it cannot excuse anything.
 */
function resolution(
  values: (...vectors: OpenPbrVector[]) => readonly number[] | undefined,
  ...vectors: readonly OpenPbrVector[]
): number[] {
  const at = values(...vectors) ?? [];
  const sums = at.map(() => 0);
  vectors.forEach((vector, which) => {
    for (const axis of [0, 1, 2]) {
      const moved = [1 + DIGIT, 1 - DIGIT].map(
        (factor) =>
          values(
            ...vectors.map((one, k): OpenPbrVector =>
              k === which ? (vector.map((x, i) => (i === axis ? x * factor : x)) as unknown as OpenPbrVector) : one,
            ),
          ) ?? at,
      );
      at.forEach(
        (value, k) =>
          (sums[k] = (sums[k] as number) + Math.max(...moved.map((one) => Math.abs((one[k] as number) - value)))),
      );
    }
  });
  return sums;
}

/** Counts the values, those that single precision excuses, and keeps the worst of what it does not. */
class Agreement {
  values = 0;
  excused = 0;
  private worst = { excess: 0, at: '' };

  /**
   * @param shares What shares of the energy may add to each value's error.
   * @param coarse What the last digits of the inputs make of each value; asked for only where the limit is not kept.
   */
  add(
    name: string,
    actual: readonly number[],
    expected: readonly number[],
    at: string,
    shares: (k: number) => number = () => 0,
    coarse: () => readonly number[] = () => [],
  ): void {
    let digits: readonly number[] | undefined;
    actual.forEach((value, k) => {
      const reference = expected[k] as number;
      const difference = Math.abs(value - reference);
      const allowed = LIMIT * Math.max(Math.abs(reference), FLOOR);
      this.values++;
      if (difference <= allowed) return;
      this.excused++;
      digits ??= coarse();
      const excess = Number.isFinite(value) ? difference / (allowed + shares(k) + (digits[k] ?? 0)) : Infinity;
      if (excess > Math.max(this.worst.excess, 1))
        this.worst = { excess, at: `${name}[${k}] is ${value} for ${reference}, ${at}` };
    });
  }

  expectGood(): void {
    expect(this.worst.excess, this.worst.at).toBeLessThanOrEqual(1);
    // What excused many would excuse a mistake.
    expect(this.excused, `of ${this.values} values`).toBeLessThanOrEqual(0.02 * this.values);
  }
}

const alike = (a: OpenPbrVector, b: OpenPbrVector): boolean => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) < 1e-3;

/**
 * Holds everything the shader gave to its twin: within 1e-4 of the value, or, where that is more, what the last digits
 * of its inputs and of shares of the energy make of it. No input is left out.
 *
 * @returns How many samples were compared.
 */
export function expectTwins(
  results: readonly GpuResult[],
  cases: readonly GpuCase[],
  multipleScattering = true,
): number {
  const agreement = new Agreement();
  let sampled = 0;
  results.forEach((gpu, i) => {
    const { parameters, wo, wi, u, side } = cases[i] as GpuCase;
    const indices: OpenPbrVector = [parameters.specular_ior, parameters.coat_ior, parameters.thin_film_ior];
    const seen = (from: OpenPbrVector, [specular_ior, coat_ior, thin_film_ior] = indices) =>
      prepareBsdf({ ...parameters, specular_ior, coat_ior, thin_film_ior }, from, { multipleScattering, ...side });
    const b = seen(wo);
    const at = `case ${i}: wo ${wo.join(' ')}, wi ${wi.join(' ')}, u ${u.join(' ')}, roughness ${parameters.specular_roughness}`;
    const both = (from: OpenPbrVector, to: OpenPbrVector, media = indices): number[] => {
      const { f, pdf } = evalPdfBsdf(seen(from, media), from, to);
      return [...f, pdf];
    };
    // Near the critical angle shares change fast with the last digits too; a film's part is a factor on 1 less a share.
    const energies = (from: OpenPbrVector, media: OpenPbrVector): number[] => {
      const { transmission, diffuseScale } = seen(from, media);
      return [...transmission.albedo, ...transmission.reflectionAlbedo, diffuseScale];
    };
    const share = (): number => SHARE * Math.max(1, ...b.filmPass) + Math.max(...resolution(energies, wo, indices));
    const spread = (w: OpenPbrVector): number => (share() * Math.abs(w[2])) / Math.PI;
    agreement.add(
      'value and density',
      [...gpu.f, gpu.pdf],
      both(wo, wi),
      at,
      () => spread(wi),
      () => resolution(both, wo, wi, indices),
    );
    agreement.add('both together', [...gpu.together, gpu.togetherPdf], [...gpu.f, gpu.pdf], at);
    agreement.add('albedo', gpu.albedo, albedoBsdf(b, wo), at, share);
    agreement.add(
      'emission',
      gpu.emission,
      emittedRadiance(parameters, wo),
      at,
      (k) => SHARE * parameters.emission_luminance * (parameters.emission_color[k] as number),
    );
    agreement.add('opacity', [gpu.opacity], [parameters.geometry_opacity], at);

    // What is sampled is chosen by comparing u.z with probabilities: on the very edge it may be either choice, but one
    // of them.
    const chosen = [0, 2e-6, -2e-6].map((nudge) => Math.min(Math.max(u[2] + nudge, 0), 1 - 1e-9));
    const choices = chosen.map((uz) => sampleBsdf(b, wo, [u[0], u[1], uz]));
    const same = (s: BsdfSample): boolean =>
      s.transmitted === gpu.transmitted && s.subsurface === gpu.subsurface && alike(s.wi, gpu.wi);
    const which = choices.findIndex(same);
    expect(
      which,
      `the sample ${gpu.wi.join(' ')} of ${at} is none of ${choices.map(({ wi: one }) => one.join(' ')).join(', ')}`,
    ).toBeGreaterThanOrEqual(0);
    const s = choices[which] as BsdfSample;
    // Whether a direction is above the horizon is as good as its cosine.
    if (Math.abs(s.wi[2]) > 1e-6) expect(gpu.valid, `valid at ${at}`).toBe(s.valid);
    if (!s.valid || !gpu.valid) return;
    sampled++;
    const sample = (from: OpenPbrVector, numbers: OpenPbrVector, media: OpenPbrVector): number[] | undefined => {
      const one = sampleBsdf(seen(from, media), from, [numbers[0], numbers[1], chosen[which] as number]);
      return one.valid && same(one) ? [one.pdf, ...one.weight, ...one.wi] : undefined;
    };
    agreement.add(
      'density, weight and direction of the sample',
      [gpu.samplePdf, ...gpu.weight, ...gpu.wi],
      [s.pdf, ...s.weight, ...s.wi],
      at,
      (k) => (k === 0 ? spread(s.wi) : k < 4 ? (spread(s.wi) / s.pdf) * (1 + (s.weight[k - 1] as number)) : DIGIT),
      () => resolution(sample, wo, u, indices),
    );
  });
  agreement.expectGood();
  return sampled;
}
