import { expectNoGpuErrors } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { albedoBsdf, evalBsdf, ggxSample, pdfBsdf, prepareBsdf, refract, sampleBsdf } from '../src/cpu/index';
import { resolveParameters, type OpenPbrParameters, type OpenPbrVector } from '../src/parameters/index';
import { requiredFeatures, type OpenPbrFlags } from '../src/wgsl/index';
import { expectTwins } from './agree';
import { onGpu, type GpuCase } from './gpu';
import {
  anyClear,
  anyCoated,
  anySurface,
  lowerDirection,
  rounded,
  single,
  uniform,
  unit,
  upperDirection,
  withLobes,
} from './random';

afterEach(() => expectNoGpuErrors());

/** Every lobe of an opaque surface. */
const OPAQUE = (): OpenPbrFlags => ({
  ...ALL,
  OPENPBR_THIN_FILM: false,
  OPENPBR_FUZZ: false,
  OPENPBR_INNER: false,
  OPENPBR_INNER_SUMS: false,
  OPENPBR_TRANSMISSION: false,
  OPENPBR_SUBSURFACE: false,
  OPENPBR_THIN_SUBSURFACE: false,
  OPENPBR_THIN_WALLED: false,
});

const ALL: OpenPbrFlags = {
  OPENPBR_SPECULAR: true,
  OPENPBR_METAL: true,
  OPENPBR_COAT_FRAME: false,
  OPENPBR_DIELECTRIC: true,
  OPENPBR_INTERFACE: true,
  OPENPBR_INTERFACE_LOOP: true,
  OPENPBR_INNER: true,
  OPENPBR_INNER_SUMS: true,
  OPENPBR_TRANSMISSION: true,
  OPENPBR_SUBSURFACE: true,
  OPENPBR_THIN_SUBSURFACE: true,
  OPENPBR_THIN_WALLED: true,
  OPENPBR_LOSSES: true,
  OPENPBR_COAT: true,
  OPENPBR_THIN_FILM: true,
  OPENPBR_FUZZ: true,
  OPENPBR_LAYERED: true,
  OPENPBR_DIFFUSE: true,
  OPENPBR_COSINE: true,
  OPENPBR_DIFFUSE_ROUGHNESS: true,
  OPENPBR_ANISOTROPY: true,
  OPENPBR_HAZE: false,
  OPENPBR_RETROREFLECTION: false,
  OPENPBR_LOBES: false,
  OPENPBR_MULTISCATTER: true,
  OPENPBR_EMISSION: true,
};

const FULL = process.env['GLANZ_FULL'] !== undefined;
/**
 * All but the film, for surfaces without one. Without GLANZ_FULL they take the program with it, which other tests compile,
 * too: that takes longer than all the surfaces.
 */
const CLEAR: OpenPbrFlags = FULL ? { ...ALL, OPENPBR_THIN_FILM: false } : ALL;

/** What the draft of 1.2 adds. */
const LOBES = { OPENPBR_HAZE: true, OPENPBR_RETROREFLECTION: true, OPENPBR_LOBES: true } as const;

/** Haze, its spread and retroreflectivity in the steps that records have. */
const steps = (haze: number, spread: number, retroreflectivity: number) => ({
  specular_haze: haze / 1023,
  specular_haze_spread: spread / 1023,
  specular_retroreflectivity: retroreflectivity / 1023,
});

async function compare(flags: OpenPbrFlags, list: readonly GpuCase[]): Promise<void> {
  expectTwins(await onGpu(flags, list), list, flags.OPENPBR_MULTISCATTER);
}

/**
 * From anywhere above to anywhere above; some straight back, and some where a mirror would send it, for highlights that
 * are narrow.
 */
function cases(count: number, seed: number, surface: (next: () => number) => OpenPbrParameters): GpuCase[] {
  const next = uniform(seed);
  return Array.from({ length: count }, () => {
    const parameters = surface(next);
    const wo = upperDirection(next);
    const kind = next();
    const off = (x: number): number => 0.02 * (next() - 0.5) - x;
    const wi =
      kind < 0.1
        ? single([wo[0], wo[1], -wo[2]])
        : kind < 0.3
          ? single(unit([off(wo[0]), off(wo[1]), wo[2]]))
          : upperDirection(next);
    return { parameters, wo, wi, u: single([next(), next(), next() * 0.999]) };
  });
}

/**
 * Kernels with nearly all lobes take the software GPU's compiler a minute where nothing is cached and other tests run
 * beside it.
 */
const COMPILE_MS = 300_000;

describe('WGSL against its CPU twin', () => {
  it('every lobe at once, 2048 random surfaces (seed 1)', () =>
    compare(
      OPAQUE(),
      cases(2048, 1, (next) => anySurface(next, 0)),
    ));
  it('single scattering only (seed 2)', () =>
    compare(
      { ...OPAQUE(), OPENPBR_MULTISCATTER: false },
      cases(1024, 2, (next) => anySurface(next, 0)),
    ));

  it('every lobe below a coat, 2048 random surfaces (seed 8)', () =>
    compare(
      OPAQUE(),
      cases(2048, 8, (next) => anyCoated(next, 0)),
    ));
  it(
    'every lobe below fuzz, 1024 random surfaces (seed 14)',
    () =>
      compare(
        { ...ALL, OPENPBR_THIN_FILM: false, OPENPBR_THIN_WALLED: false, OPENPBR_THIN_SUBSURFACE: false },
        cases(1024, 14, (next) => ({
          ...anyCoated(next, 0),
          fuzz_weight: Math.fround(next()),
          fuzz_color: single([next(), next(), next()]),
          fuzz_roughness: Math.fround(0.1 + 0.9 * next()),
          geometry_thin_walled: false,
        })),
      ),
    COMPILE_MS,
  );
  it('single scattering below a coat (seed 9)', () =>
    compare(
      { ...OPAQUE(), OPENPBR_MULTISCATTER: false },
      cases(512, 9, (next) => anyCoated(next, 0)),
    ));

  /**
   * From either side, of indices down to 1, to where facets refract, or anywhere below.
   *
   * @param isFar No index near that of what is outside, for which the shader needs both.
   */
  const through = (
    count: number,
    seed: number,
    surface: (next: () => number) => OpenPbrParameters = (next) => anyClear(next, 0),
    isFar = false,
  ): GpuCase[] => {
    const next = uniform(seed);
    return cases(count, seed + 1000, surface).map((one) => {
      const outerIor = next() < 0.3 ? Math.fround(1 + 0.4 * next()) : 1;
      const side = {
        inside: !one.parameters.geometry_thin_walled && next() < 0.5,
        outerIor: isFar && one.parameters.specular_ior < 1.1 * outerIor ? 1 : outerIor,
      };
      const kind = next();
      if (kind > 0.5) return { ...one, side };
      const { transmission, alpha } = prepareBsdf(one.parameters, one.wo, side);
      const bent =
        kind < 0.25 && !transmission.thin
          ? refract(transmission.eta, one.wo, ggxSample(alpha, one.wo, [next(), next()]))
          : undefined;
      return { ...one, side, wi: bent ? single(bent) : lowerDirection(next) };
    });
  };
  it(
    'light through every lobe at once, 2048 random surfaces from either side (seed 40)',
    () => compare(CLEAR, through(2048, 40)),
    COMPILE_MS,
  );
  it(
    'smooth lobes, alone and among others, 1024 random surfaces from either side (seed 50)',
    () =>
      compare(
        CLEAR,
        through(1024, 50, (next) => ({
          ...anyClear(next, 0),
          specular_roughness: next() < 0.7 ? 0 : Math.fround(next()),
          coat_roughness: next() < 0.7 ? 0 : Math.fround(next()),
          coat_weight: next() < 0.5 ? 0 : Math.fround(next()),
        })),
      ),
    COMPILE_MS,
  );
  it.runIf(FULL)(
    'light through, single scattering only (seed 41)',
    () => compare({ ...ALL, OPENPBR_THIN_FILM: false, OPENPBR_MULTISCATTER: false }, through(512, 41)),
    COMPILE_MS,
  );

  const gated = (name: string, seed: number, fixed: Partial<OpenPbrParameters>): void => {
    it(`${name} alone, the other lobes left out of the text (seed ${seed})`, async () => {
      const surface = (next: () => number): OpenPbrParameters =>
        rounded({
          ...anySurface(next, 0),
          base_diffuse_roughness: 0,
          specular_roughness_anisotropy: 0,
          emission_luminance: 0,
          ...fixed,
        });
      const list =
        fixed.transmission_weight !== undefined ? through(512, seed, surface, true) : cases(512, seed, surface);
      const flags = requiredFeatures(list.map((one) => one.parameters));
      expect(Object.values(flags)).toContain(false);
      await compare(flags, list);
    });
  };
  /** Some directions near the viewer's, where light returns. */
  const returned = (list: readonly GpuCase[], seed: number): GpuCase[] => {
    const next = uniform(seed);
    return list.map((one) => {
      const near = next() < 0.2 && one.wi[2] > 0;
      const [x, y, z] = one.wo;
      return near ? { ...one, wi: single(unit([x + 0.02 * (next() - 0.5), y + 0.02 * (next() - 0.5), z])) } : one;
    });
  };
  it('haze and retroreflection among every lobe below a coat, 2048 random surfaces (seed 70)', () =>
    compare(
      { ...OPAQUE(), ...LOBES },
      returned(
        cases(2048, 70, (next) => withLobes(anyCoated(next, 0), next)),
        71,
      ),
    ));
  it('haze and retroreflection of smooth lobes, 1024 random surfaces (seed 72)', () =>
    compare(
      { ...OPAQUE(), ...LOBES },
      cases(1024, 72, (next) => ({
        ...withLobes(anyCoated(next, 0), next),
        specular_roughness: next() < 0.7 ? 0 : Math.fround(next()),
        coat_roughness: next() < 0.7 ? 0 : Math.fround(next()),
        coat_weight: next() < 0.5 ? 0 : Math.fround(next()),
      })),
    ));
  // Its program takes longest of all; without GLANZ_FULL glass alone is hazy, below.
  it.runIf(FULL)(
    'haze and retroreflection of what lets light through, 1024 random surfaces from either side (seed 74)',
    () =>
      compare(
        { ...ALL, ...LOBES, OPENPBR_THIN_FILM: false },
        through(1024, 74, (next) => withLobes(anyClear(next, 0), next)),
      ),
    COMPILE_MS,
  );
  const filmed = (next: () => number): Partial<OpenPbrParameters> => ({
    thin_film_weight: Math.fround(0.2 + 0.8 * next()),
    thin_film_thickness: Math.fround(next()),
    thin_film_ior: Math.fround(1.1 + 1.5 * next()),
  });
  it('every lobe below a film, 1024 random surfaces (seed 16)', () =>
    compare(
      { ...OPAQUE(), OPENPBR_THIN_FILM: true },
      cases(1024, 16, (next) => ({ ...anyCoated(next, 0), ...filmed(next) })),
    ));
  it(
    'a film on what lets light through, 1024 random surfaces from either side (seed 47)',
    () =>
      compare(
        ALL,
        through(1024, 47, (next) => ({ ...anyClear(next, 0), ...filmed(next) })),
      ),
    COMPILE_MS,
  );
  gated('dielectric of an index below 1 over diffuse', 20, {
    base_metalness: 0,
    specular_weight: 1,
    specular_ior: 0.7,
  });
  gated('coat of an index below 1 over black', 19, {
    base_metalness: 0,
    base_weight: 0,
    specular_weight: 0,
    coat_weight: 1,
    coat_ior: 0.8,
    coat_roughness: 0.4,
  });
  gated('dielectric over rough diffuse', 21, { base_metalness: 0, specular_weight: 1, base_diffuse_roughness: 0.8 });
  gated('film on metal', 17, {
    base_metalness: 1,
    specular_weight: 1,
    thin_film_weight: 1,
    thin_film_ior: 1.6,
    thin_film_thickness: 0.4,
  });
  gated('film on diffuse', 18, {
    base_metalness: 0,
    specular_weight: 1,
    specular_ior: 1.5,
    thin_film_weight: 0.7,
    thin_film_ior: 2,
    thin_film_thickness: 0.3,
  });
  gated('film on glass', 48, {
    base_metalness: 0,
    transmission_weight: 1,
    specular_weight: 1,
    specular_ior: 1.5,
    thin_film_weight: 1,
    thin_film_ior: 1.8,
    thin_film_thickness: 0.6,
  });
  gated('hazy metal', 75, { base_metalness: 1, specular_weight: 1, ...steps(300, 400, 0) });
  gated('hazy glass', 78, {
    base_metalness: 0,
    transmission_weight: 1,
    specular_weight: 1,
    specular_ior: 1.5,
    ...steps(400, 300, 200),
  });
  gated('returning dielectric over diffuse', 76, { base_metalness: 0, ...steps(0, 300, 600) });
  gated('hazy film on diffuse', 77, {
    base_metalness: 0,
    specular_weight: 1,
    specular_ior: 1.5,
    thin_film_weight: 0.75,
    ...steps(500, 500, 500),
  });
  gated('metal', 3, { base_metalness: 1, specular_weight: 1 });
  gated('diffuse', 4, { base_metalness: 0, specular_weight: 0 });
  gated('dielectric over diffuse', 5, { base_metalness: 0 });
  gated('dielectric over black', 6, { base_metalness: 0, base_weight: 0 });
  gated('coat over diffuse', 10, {
    base_metalness: 0,
    specular_weight: 0,
    coat_weight: 1,
    coat_roughness: 0.4,
    coat_color: [0.9, 0.5, 0.2],
  });
  gated('coat over metal', 11, { base_metalness: 1, specular_weight: 1, coat_weight: 0.5, coat_roughness: 0.3 });
  gated('coat over dielectric', 12, { base_metalness: 0, base_weight: 0, coat_weight: 1, coat_roughness: 0.3 });
  gated('glass', 42, {
    base_metalness: 0,
    transmission_weight: 1,
    specular_weight: 1,
    specular_ior: 1.5,
    transmission_color: [0.9, 0.5, 0.2],
  });
  gated('thin glass', 43, {
    base_metalness: 0,
    transmission_weight: 1,
    specular_weight: 1,
    specular_ior: 1.5,
    geometry_thin_walled: true,
    transmission_color: [0.9, 0.5, 0.2],
  });
  gated('coat over glass and diffuse', 44, {
    base_metalness: 0,
    transmission_weight: 0.5,
    specular_weight: 1,
    specular_ior: 1.5,
    coat_weight: 0.7,
    coat_roughness: 0.3,
    coat_color: [0.9, 0.5, 0.2],
  });
  gated('subsurface', 45, {
    base_metalness: 0,
    transmission_weight: 0,
    subsurface_weight: 1,
    specular_weight: 1,
    specular_ior: 1.4,
  });
  gated('paper', 46, {
    base_metalness: 0,
    transmission_weight: 0,
    subsurface_weight: 0.7,
    specular_weight: 1,
    specular_ior: 1.4,
    geometry_thin_walled: true,
    subsurface_scatter_anisotropy: 0.3,
  });
  gated('fuzz over diffuse', 15, {
    base_metalness: 0,
    specular_weight: 0,
    fuzz_weight: 0.8,
    fuzz_roughness: 0.6,
    fuzz_color: [0.9, 0.5, 0.2],
  });
  gated('coat over black', 13, {
    base_metalness: 0,
    base_weight: 0,
    specular_weight: 0,
    coat_weight: 1,
    coat_roughness: 0.3,
  });
});

describe('WGSL at the edges', () => {
  it('is finite, not negative, and dark below the horizon', async () => {
    const next = uniform(7);
    const directions: OpenPbrVector[] = [
      [0, 0, 1],
      [1, 0, 0],
      [0, -1, 0],
      [1, 0, 1e-4],
      [1, 0, 1e-30],
      [-1, 0, 1e-30],
      [0, 1, 1e-7],
      [-0.6, 0, 0.8],
      [0.6, 0, 0.8],
      [0.6, 0, -0.8],
      [0, 0, -1],
    ];
    const surfaces: Partial<OpenPbrParameters>[] = [
      {},
      { specular_roughness: 0 },
      { specular_roughness: 0, specular_roughness_anisotropy: 1 },
      { specular_roughness: 1, specular_roughness_anisotropy: 1, base_metalness: 0.5 },
      { base_metalness: 1, specular_roughness: 0, base_color: [1, 1, 1] },
      { base_metalness: 1, specular_roughness: 0.001, base_color: [0, 0, 0], specular_color: [0, 0, 0] },
      { base_weight: 0, specular_weight: 0 },
      { base_weight: 0, specular_weight: 0, base_metalness: 1 },
      { specular_weight: 1e30, base_metalness: 0.5 },
      { specular_ior: 1 },
      { specular_ior: 1e-3, specular_roughness: 0.5 },
      { specular_ior: 0.999999, specular_roughness: 0 },
      { specular_ior: 1e6, specular_roughness: 0.5 },
      { base_diffuse_roughness: 1, base_color: [1, 1, 1] },
      { geometry_opacity: 0, emission_luminance: 1e6 },
      { coat_weight: 1 },
      { coat_weight: 1, coat_color: [0, 0.5, 1], emission_luminance: 1, coat_roughness_anisotropy: 1 },
      { coat_weight: 1, base_metalness: 1, base_color: [1, 1, 1], specular_roughness: 0 },
      { coat_weight: 1, coat_ior: 1e-3, coat_roughness: 0.5 },
      { coat_weight: 0.5, coat_ior: 1e6, coat_roughness: 1, specular_ior: 1e-3 },
      { coat_weight: 1, coat_ior: 1, base_weight: 0, specular_weight: 0 },
      { coat_weight: 1, coat_ior: 0.7, coat_roughness: 0, coat_color: [0.5, 0.5, 0.5], specular_roughness: 1 },
      { transmission_weight: 1 },
      { transmission_weight: 1, specular_roughness: 0 },
      { transmission_weight: 1, specular_roughness: 0, specular_ior: 1 },
      { transmission_weight: 1, specular_roughness: 1, specular_ior: 1, specular_weight: 0 },
      { transmission_weight: 1, specular_roughness: 1, specular_roughness_anisotropy: 1, specular_ior: 1e6 },
      { transmission_weight: 1, specular_roughness: 0.5, specular_ior: 1e-3 },
      { transmission_weight: 1, specular_roughness: 0, specular_ior: 1.0001, transmission_color: [0, 0.5, 1] },
      {
        transmission_weight: 0.5,
        base_metalness: 0.5,
        specular_roughness: 0.2,
        specular_weight: 1e30,
        coat_weight: 1,
        coat_ior: 3,
      },
      { transmission_weight: 1, geometry_thin_walled: true, specular_roughness: 0, transmission_color: [0, 0.5, 1] },
      {
        transmission_weight: 0.5,
        geometry_thin_walled: true,
        specular_roughness: 1,
        specular_ior: 1e6,
        specular_roughness_anisotropy: 1,
      },
      { transmission_weight: 1, geometry_thin_walled: true, specular_roughness: 0.4, specular_ior: 1, coat_weight: 1 },
      { subsurface_weight: 1, subsurface_color: [0, 0.5, 1], specular_roughness: 1 },
      { fuzz_weight: 1, fuzz_roughness: 0 },
      { fuzz_weight: 1, fuzz_roughness: 1, base_weight: 0, specular_weight: 0, emission_luminance: 1 },
      { subsurface_weight: 0.5, transmission_weight: 0.5, transmission_color: [0, 0, 1], specular_roughness: 0.3 },
      { thin_film_weight: 1, thin_film_thickness: 0, base_metalness: 0.5 },
      {
        thin_film_weight: 1,
        thin_film_thickness: 1e4,
        thin_film_ior: 1e-2,
        base_metalness: 0.5,
        base_color: [1, 0, 0.5],
        specular_color: [0, 1, 0],
      },
      { thin_film_weight: 1, thin_film_ior: 1, specular_ior: 1, transmission_weight: 1, specular_roughness: 0 },
      {
        thin_film_weight: 1,
        thin_film_ior: 50,
        coat_weight: 0.5,
        coat_ior: 1e-2,
        specular_ior: 1e-2,
        transmission_weight: 0.5,
        specular_roughness_anisotropy: 1,
      },
      { transmission_weight: 1, specular_ior: 0.5, specular_roughness: 1, specular_roughness_anisotropy: 1 },
      {
        transmission_weight: 1,
        specular_ior: 1,
        specular_roughness: 0.5,
        specular_roughness_anisotropy: 0.999,
        coat_weight: 1,
        coat_roughness: 1,
        coat_roughness_anisotropy: 1,
        coat_ior: 1,
      },
      {
        subsurface_weight: 1,
        geometry_thin_walled: true,
        subsurface_scatter_anisotropy: 1,
        base_diffuse_roughness: 1,
        subsurface_color: [1, 1, 1],
      },
    ];
    const us = [0, 0.5, 0.99999994];
    const list: GpuCase[] = surfaces.flatMap((surface) => {
      const parameters = resolveParameters(surface);
      return directions.flatMap((wo) =>
        directions.map((wi): GpuCase => ({
          parameters,
          wo,
          wi,
          u: [
            us[Math.floor(next() * 3)] as number,
            us[Math.floor(next() * 3)] as number,
            next() < 0.5 ? 0 : 0.99999994,
          ],
          side: {
            inside:
              parameters.transmission_weight + parameters.subsurface_weight > 0 &&
              !parameters.geometry_thin_walled &&
              next() < 0.5,
            outerIor: 1,
          },
        })),
      );
    });
    const results = await onGpu(ALL, list);
    // Messages are made where something is wrong only: there are thousands of cases.
    const faults: string[] = [];
    results.forEach((result, i) => {
      const { wo, wi, u, side, parameters } = list[i] as GpuCase;
      const check = (holds: boolean, what: string): void => {
        if (holds) return;
        const surface = JSON.stringify(surfaces[Math.floor(i / directions.length ** 2)]);
        faults.push(`${what} at wo ${wo.join(' ')}, wi ${wi.join(' ')}, ${surface}`);
      };
      for (const [name, value] of Object.entries(result)) {
        if (typeof value === 'boolean') continue;
        for (const one of [value].flat() as number[])
          check(Number.isFinite(one) && (name === 'wi' || one >= 0), `${name} is ${one}`);
      }
      const clear = parameters.transmission_weight + parameters.subsurface_weight > 0;
      if (wo[2] <= 0 || (wi[2] <= 0 && !clear))
        check(
          [...result.f, result.pdf].every((x) => Object.is(x, 0)),
          `value and density are ${result.f.join(' ')} ${result.pdf}`,
        );
      if (wo[2] <= 0) {
        const dark = [...result.weight, ...result.albedo, ...result.emission];
        check(
          !result.valid && dark.every((x) => Object.is(x, 0)),
          `valid is ${result.valid}, the rest ${dark.join(' ')}`,
        );
      }
      // The CPU twin holds the same promise.
      const b = prepareBsdf(parameters, wo, side);
      for (const one of [
        ...evalBsdf(b, wo, wi),
        pdfBsdf(b, wo, wi),
        ...albedoBsdf(b, wo),
        ...sampleBsdf(b, wo, u).weight,
      ])
        check(Number.isFinite(one) && one >= 0, `${one} on the CPU`);
    });
    expect(results.length).toBe(surfaces.length * directions.length ** 2);
    expect(faults).toEqual([]);
  });
});
