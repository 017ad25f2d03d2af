import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { gaussLegendre } from '../scripts/microfacet.mjs';
import {
  filmReflectance,
  fresnelDielectric,
  ggxAlpha,
  ggxMasking,
  ggxMaskingShadowing,
  ggxSample,
  metalIndex,
  prepareFilm,
  type ComplexIndex,
  type Film,
  type Slopes,
} from '../src/cpu/index';
import { filmChange, filmFacet } from '../src/cpu/film';
import { resolveParameters, type OpenPbrParameters, type OpenPbrVector } from '../src/parameters/index';
import { openpbr, requiredFeatures } from '../src/wgsl/index';
import { openpbrFilm } from '../src/wgsl/thin_film/index';
import { direction } from './integrate';
import { uniform } from './random';
import { primitives, type Triple } from './oracle/index';
import { inSample } from './sample';
import { sphereFurnace } from './sphere';

afterEach(() => expectNoGpuErrors());

const ORACLE_WAVELENGTHS = [620, 540, 450] as const;
const filmOf = (index: number, micrometres: number, wavelengths?: readonly [number, number, number]): Film =>
  prepareFilm(
    resolveParameters({ thin_film_weight: 1, thin_film_ior: index, thin_film_thickness: micrometres }),
    1,
    false,
    wavelengths,
  );

interface Row {
  readonly mu: number;
  readonly n_ext: number;
  readonly n_film: number;
  readonly base: [number, number];
  readonly thickness_nm: number;
  readonly R_620_540_450: Triple;
  readonly rgb_spectral_E_linear_srgb: Triple;
}

describe('reflectance of a film', () => {
  const rows = (): Row[] => primitives()['thin_film_airy'] as unknown as Row[];

  it("is Airy's at three wavelengths", () => {
    for (const row of rows()) {
      const color = filmReflectance(
        filmOf(row.n_film, row.thickness_nm / 1000, ORACLE_WAVELENGTHS),
        row.base,
        1 - row.mu * row.mu,
      );
      color.forEach((value, i) =>
        expect(Math.abs(value - (row.R_620_540_450[i] as number)), JSON.stringify(row)).toBeLessThan(1e-6),
      );
    }
  });

  it('is that of the visible spectrum within 0.014, and 0.0025 in the mean square', () => {
    let squares = 0,
      count = 0;
    for (const row of rows()) {
      const color = filmReflectance(filmOf(row.n_film, row.thickness_nm / 1000), row.base, 1 - row.mu * row.mu);
      color.forEach((value, i) => {
        // Colours outside of the gamut are cut off.
        const difference = value - Math.min(Math.max(row.rgb_spectral_E_linear_srgb[i] as number, 0), 1);
        expect(Math.abs(difference), JSON.stringify({ ...row, color })).toBeLessThan(0.014);
        squares += difference * difference;
        count++;
      });
    }
    expect(Math.sqrt(squares / count)).toBeLessThan(2.5e-3);
  });

  it('has the complex index of a metal', () => {
    for (const { F0, edge, n, k } of primitives()['gulbrandsen'] as {
      F0: number;
      edge: number;
      n: number;
      k: number;
    }[]) {
      if (F0 > 0.999) continue;
      const [ours, absorption] = metalIndex(F0, edge);
      expect(Math.abs(ours - n)).toBeLessThan(1e-4 * n);
      expect(Math.abs(absorption - k)).toBeLessThan(1e-4 * Math.max(k, n));
    }
  });

  it('is Fresnel of the base where the film is as dense as it or as the air', () => {
    for (const mu of [1, 0.7, 0.3, 0.05]) {
      for (const index of [1.5, 1.0000001]) {
        for (const value of filmReflectance(filmOf(index, 0.4), [1.5, 0], 1 - mu * mu))
          expect(value).toBeCloseTo(fresnelDielectric(1.5, mu), 4);
      }
    }
  });

  it('loses its colour where the film is thick: the sum of intensities', () => {
    const film = filmOf(1.8, 60);
    for (const mu of [1, 0.5, 0.2]) {
      const sine2 = 1 - mu * mu;
      const inner = Math.sqrt(1 - sine2 / 1.8 ** 2);
      // Both polarisations by Fresnel's equations, and R₁ + T₁²R₂/(1 − R₁R₂) of each.
      const amplitude = (a: number, b: number) => ((a - b) / (a + b)) ** 2;
      const cosine = Math.sqrt(1 - sine2 / 1.5 ** 2);
      const pairs = [
        [amplitude(mu, 1.8 * inner), amplitude(1.8 * inner, 1.5 * cosine)],
        [amplitude(1.8 * mu, inner), amplitude(1.5 * inner, 1.8 * cosine)],
      ] as const;
      const expected = pairs.reduce((sum, [r1, r2]) => sum + (r1 + ((1 - r1) ** 2 * r2) / (1 - r1 * r2)) / 2, 0);
      for (const value of filmReflectance(film, [1.5, 0], sine2)) expect(value).toBeCloseTo(expected, 6);
    }
  });

  it('is the same from the other side, at the angle that light has there', () => {
    // Stokes: swap the media, keep what all layers share.
    const next = uniform(501);
    for (let i = 0; i < 500; i++) {
      const n = 1 + next();
      const film = filmOf(1 + 1.5 * next(), next(), ORACLE_WAVELENGTHS);
      const reversed: Film = { ...film, outer: n };
      const sine2 = next() * 0.99;
      const there = filmReflectance(film, [n, 0], sine2);
      filmReflectance(reversed, [1, 0], sine2).forEach((value, k) => expect(value).toBeCloseTo(there[k] as number, 7));
    }
  });

  it('is between 0 and 1, 20,000 random films and bases (seed 500)', () => {
    const next = uniform(500);
    for (let i = 0; i < 20_000; i++) {
      const film = filmOf(0.5 + 3 * next(), 4 * next() ** 2);
      const base: ComplexIndex = next() < 0.5 ? [0.5 + 3 * next(), 0] : metalIndex(next(), next());
      for (const value of filmReflectance(film, base, 1 - next() ** 4))
        expect(value >= 0 && value <= 1, `${value} of ${JSON.stringify({ film, base })}`).toBe(true);
    }
  });
});

describe('what a film changes of the albedos', () => {
  const { nodes, weights } = gaussLegendre(24);

  /** Of 24 by 32 visible facets: what the film adds to the reflection, what it takes of the transmission, and that. */
  function exactly(film: Film, eta: number, alpha: Slopes, wo: OpenPbrVector) {
    const more = [0, 0, 0];
    const through = [0, 0, 0];
    let plain = 0;
    for (const [k, height] of nodes.entries()) {
      for (let i = 0; i < 32; i++) {
        const h = ggxSample(alpha, wo, [(i + 0.5) / 32, height]);
        const c = Math.max(wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2], 0);
        const wi: OpenPbrVector = [2 * c * h[0] - wo[0], 2 * c * h[1] - wo[1], 2 * c * h[2] - wo[2]];
        const seen = wi[2] > 0 ? ggxMaskingShadowing(alpha, wo, wi) / ggxMasking(alpha, wo) : 0;
        const clear = fresnelDielectric(eta, c);
        const part = weights[k]! / 32;
        plain += part * (1 - clear);
        filmFacet(film, c).forEach((value, channel) => {
          more[channel]! += part * seen * (value - clear);
          through[channel]! += part * (value - clear);
        });
      }
    }
    return { more, through, plain };
  }

  it.each([
    { from: 'outside', reflection: [0.012, 0.0015] as const, transmission: [0.018, 0.0022] as const },
    { from: 'inside', reflection: [0.024, 0.0026] as const, transmission: [0.021, 0.0024] as const },
  ])(
    'is that of 768 facets, from $from: reflection within $reflection.0, $reflection.1 in the mean square, transmission within $transmission.0, $transmission.1; 600 films of up to 3 µm on dielectrics (seed 503)',
    ({ from, reflection, transmission }) => {
      const inside = from === 'inside';
      const next = uniform(503);
      const worst = [0, 0];
      const squares = [0, 0];
      const count = 600;
      for (let i = 0; i < count; i++) {
        const thickness = i % 4 === 3 ? 1 + 2 * next() : 0.05 + 0.95 * next();
        const specular_ior = 1.3 + 0.9 * next();
        const film = prepareFilm(
          resolveParameters({
            thin_film_weight: 1,
            thin_film_ior: 1.15 + 1.4 * next(),
            thin_film_thickness: thickness,
            specular_ior,
          }),
          1,
          inside,
        );
        const alpha = ggxAlpha(next(), i % 3 === 0 ? 0.9 * next() : 0);
        const wo = direction(0.05 + 0.95 * next(), 7 * next());
        const eta = inside ? 1 / specular_ior : specular_ior;
        const exact = exactly(film, eta, alpha, wo);
        const { more, direct } = filmChange(film, eta, 0.04, alpha, wo, inside);
        // What it takes is relative to the transmission, but from inside, where there may be none.
        const scale = inside ? exact.plain : 1;
        for (const channel of [0, 1, 2] as const) {
          const taken = exact.through[channel]! / (inside ? 1 : exact.plain);
          const errors = [more[channel] - exact.more[channel]!, scale * (1 - direct[channel]) - taken];
          errors.forEach((error, k) => {
            worst[k] = Math.max(worst[k]!, Math.abs(error));
            squares[k]! += (error * error) / (3 * count);
          });
        }
      }
      expect(worst[0]).toBeLessThan(reflection[0]);
      expect(worst[1]).toBeLessThan(transmission[0]);
      expect(Math.sqrt(squares[0]!)).toBeLessThan(reflection[1]);
      expect(Math.sqrt(squares[1]!)).toBeLessThan(transmission[1]);
    },
  );
});

describe('films in WGSL', () => {
  it('reflect and let through the same within 1e-4, dark ones and thick ones too: 16,384 films of up to 3 µm on dielectrics and metals (seed 502)', async () => {
    const next = uniform(502);
    const single = Math.fround;
    const list = Array.from({ length: 16_384 }, () => {
      const film = { ...filmOf(0, 0), index: single(1.05 + 1.6 * next()), path: single(6 * next() ** 2) };
      const [n, k] = next() < 0.5 ? [0.5 + 2 * next(), 0] : metalIndex(next(), next());
      return { film, n: single(n), k: single(k), tangential: single(1 - next() ** 2) };
    });
    const host = wgslModule(
      'test/host',
      `@group(0) @binding(0) var<storage, read> films: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> results: array<OpenPbrFilmLight>;
fn openpbr_table_dielectric(coords: vec3f) -> f32 { return 0.0; }
fn openpbr_table_conductor(coords: vec2f) -> f32 { return 0.0; }
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (2u * id.x >= arrayLength(&results)) { return; }
  let a = films[2u * id.x];
  var film: OpenPbrFilm;
  film.outer = 1.0;
  film.index = a.x;
  film.path = a.y;
  let waves = openpbr_film_waves(film, films[2u * id.x + 1u].x);
  let metal = openpbr_film_on_metal(waves, vec3f(a.z), vec3f(a.w));
  results[2u * id.x].reflected = metal;
  // What absorbs nothing has a way of its own.
  if (a.w == 0.0) { results[2u * id.x + 1u] = openpbr_film_on_dielectric(waves, a.z); }
}`,
      [openpbr, openpbrFilm],
    );
    const flags = requiredFeatures([{ base_metalness: 0.5, thin_film_weight: 1 }]);
    const inputs = [
      new Float32Array(
        list.flatMap(({ film, n, k, tangential }) => [film.index, film.path, n, k, tangential, 0, 0, 0]),
      ),
    ];
    const results = new Float32Array(
      await runCompute(await testDevice(), compose([host], { flags: { ...flags } }).code, {
        inputs,
        outputBytes: list.length * 64,
        workgroups: list.length / 64,
      }),
    );
    list.forEach(({ film, n, k, tangential }, i) => {
      filmReflectance(film, [n, k], tangential).forEach((expected, channel) => {
        for (const [at, value] of [
          [0, expected],
          ...(k === 0
            ? ([
                [8, expected],
                [12, 1 - expected],
              ] as const)
            : []),
        ] as const) {
          const difference = Math.abs((results[16 * i + at + channel] as number) - value) / Math.max(value, 0.003);
          expect(
            difference,
            `${value} of ${JSON.stringify({ index: film.index, path: film.path, n, k, tangential })}`,
          ).toBeLessThan(1e-4);
        }
      });
    });
  });
});

describe('white furnace below a film', () => {
  const white = (
    name: string,
    fixed: Partial<OpenPbrParameters>,
    [low, high]: readonly [number, number],
    inside = false,
  ): void => {
    it(`${name}: ${low} to ${high}, of all thicknesses, roughness 0.1 to 1`, () => {
      for (const [i, thin_film_thickness] of [0.05, 0.3, 0.55, 1.2].entries()) {
        for (const [j, specular_roughness] of [0.1, 0.4, 0.7, 1].entries()) {
          for (const [k, mu] of [1, 0.7, 0.3, 0.1].entries()) {
            if (!inSample(4, i, j, k)) continue;
            const p = resolveParameters({
              base_color: [1, 1, 1],
              thin_film_weight: 1,
              thin_film_thickness,
              specular_roughness,
              ...fixed,
            });
            const { reflected, transmitted, pdf } = sphereFurnace(p, direction(mu), { inside }, 32);
            reflected.forEach((value, channel) => {
              const sum = value + (transmitted[channel] as number);
              expect(sum, JSON.stringify({ p, mu })).toBeGreaterThan(low);
              expect(sum, JSON.stringify({ p, mu })).toBeLessThan(high);
            });
            expect(pdf).toBeLessThan(1.004);
          }
        }
      }
    });
  };
  white('diffuse', { thin_film_ior: 1.8 }, [0.99, 1.01]);
  white('diffuse, titanium oxide', { thin_film_ior: 2.5 }, [0.985, 1.015]);
  white('metal', { base_metalness: 1, thin_film_ior: 1.5 }, [0.98, 1.001]);
  white('glass', { transmission_weight: 1, thin_film_ior: 1.8 }, [0.985, 1.01]);
  white('glass from inside', { transmission_weight: 1, thin_film_ior: 1.8 }, [0.98, 1.012], true);
  white(
    'bubble',
    { transmission_weight: 1, specular_ior: 1, thin_film_ior: 1.33, geometry_thin_walled: true },
    [0.99, 1.005],
  );
});

describe('a film below other layers', () => {
  it('is left out of the text where no material has one', () => {
    expect(requiredFeatures([{}]).OPENPBR_THIN_FILM).toBe(false);
    expect(requiredFeatures([{ thin_film_weight: 1 }]).OPENPBR_THIN_FILM).toBe(true);
    expect(requiredFeatures([{ thin_film_weight: 1, thin_film_thickness: 0 }]).OPENPBR_THIN_FILM).toBe(false);
    // A film reflects where the base does not.
    expect(requiredFeatures([{ thin_film_weight: 1, specular_weight: 0 }]).OPENPBR_DIELECTRIC).toBe(true);
  });
});
