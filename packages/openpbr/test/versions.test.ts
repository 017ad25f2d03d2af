import { describe, expect, it, vi } from 'vitest';
import { drawable, glowing } from '../../../apps/docs/examples/openpbr-versions';
import { emittedRadiance, evalBsdf, prepareBsdf, sampleBsdf, transmissionMedium } from '../src/cpu/index';
import { readMaterialX } from '../src/materialx/index';
import { defaultParameters, resolveParameters, validateParameters, type OpenPbrVector } from '../src/parameters/index';
import { fromOpenPbr12, type OpenPbr12Parameters } from '../src/versions/index';
import { presets } from './oracle/index';

const direction = (theta: number, phi: number): OpenPbrVector => [
  Math.sin(theta) * Math.cos(phi),
  Math.sin(theta) * Math.sin(phi),
  Math.cos(theta),
];

describe('what OpenPBR 1.1.1 says otherwise than 1.1', () => {
  // #258: a thin wall has no depth, so subsurface_radius and subsurface_radius_scale do nothing there.
  it('thin-walled subsurface ignores the radius: two Lambert lobes of the albedo, split by the anisotropy', () => {
    const color = [0.8, 0.4, 0.1] as const;
    for (const g of [-0.5, 0, 0.75])
      for (const radius of [0, 0.01, 3]) {
        const parameters = resolveParameters({
          geometry_thin_walled: true,
          specular_weight: 0,
          subsurface_weight: 1,
          subsurface_color: color,
          subsurface_scatter_anisotropy: g,
          subsurface_radius: radius,
          subsurface_radius_scale: [radius > 1 ? 0.2 : 1, 1, 0.5],
        });
        const wo = direction(0.7, 0.3);
        const bsdf = prepareBsdf(parameters, wo);
        for (const theta of [0.2, 1, 1.4]) {
          const wi = direction(theta, 2);
          const through: OpenPbrVector = [wi[0], wi[1], -wi[2]];
          color.forEach((c, k) => {
            expect(evalBsdf(bsdf, wo, wi)[k]).toBeCloseTo((((1 - g) / 2) * c * wi[2]) / Math.PI, 6);
            expect(evalBsdf(bsdf, wo, through)[k]).toBeCloseTo((((1 + g) / 2) * c * wi[2]) / Math.PI, 6);
          });
        }
      }
  });

  // #260: the colour of emission may exceed 1.
  it('emission_color above 1 is valid, and radiance is its product with the luminance', () => {
    const { parameters, warnings } = validateParameters({ emission_color: [12, 1, 0], emission_luminance: 3 });
    expect(warnings).toEqual([]);
    expect(emittedRadiance(resolveParameters(parameters), direction(0.4, 0))).toEqual([36, 3, 0]);
  });

  // #300: the reference graph multiplied the edge tint by specular_weight, which scales the whole lobe already. At 82°,
  // whose cosine is 1/7, F82 is specular_weight × tint × Schlick.
  it('specular_weight scales the edge of metal once', () => {
    const theta = Math.acos(1 / 7);
    for (const weight of [0.25, 0.5, 1]) {
      const bsdf = prepareBsdf(
        resolveParameters({
          base_metalness: 1,
          base_color: [0.9, 0.5, 0.2],
          specular_color: [0.6, 0.8, 1],
          specular_weight: weight,
          specular_roughness: 0,
        }),
        direction(theta, 0),
      );
      const sample = sampleBsdf(bsdf, direction(theta, 0), [0.3, 0.6, 0]);
      [0.9, 0.5, 0.2].forEach((f0, k) =>
        expect(sample.weight[k]).toBeCloseTo(weight * [0.6, 0.8, 1][k]! * (f0 + (1 - f0) * (6 / 7) ** 5), 6),
      );
    }
  });

  // #216: the default example has the defaults of the model.
  it('the default example is the default material', () => {
    expect(resolveParameters(presets()['default'])).toEqual(defaultParameters());
  });
});

/** Coefficients of the interior by the draft's own formulas: μt = −ln(T)/λ, μs = Ω·μt. */
const drafted = ({
  transmission_color: color,
  transmission_depth: depth,
  transmission_scatter: albedo,
}: Required<Pick<OpenPbr12Parameters, 'transmission_color' | 'transmission_depth' | 'transmission_scatter'>>) => ({
  extinction: color.map((t) => -Math.log(t) / depth),
  scattering: color.map((t, k) => (-Math.log(t) / depth) * albedo[k]!),
});

describe('fromOpenPbr12', () => {
  it('multiplies the luminance by its weight; without a weight nothing is emitted', () => {
    expect(fromOpenPbr12({ emission_weight: 0.25, emission_luminance: 80 })).toEqual({
      parameters: { emission_luminance: 20 },
      lost: [],
    });
    expect(fromOpenPbr12({ emission_weight: 0.5 }).parameters).toEqual({ emission_luminance: 500 });
    expect(fromOpenPbr12({ emission_weight: 4 }).parameters).toEqual({ emission_luminance: 1000 });
    expect(fromOpenPbr12({ emission_luminance: 80, emission_color: [1, 0, 0] }).parameters).toEqual({
      emission_color: [1, 0, 0],
    });
  });

  it.each([
    { transmission_color: [0.9, 0.7, 0.5], transmission_depth: 0.1, transmission_scatter: [0.2, 0.9, 1] },
    { transmission_color: [0.9, 0.01, 0.5], transmission_depth: 2, transmission_scatter: [0.5, 0.95, 0.1] },
    { transmission_color: [1, 0.001, 0.2], transmission_depth: 0.01, transmission_scatter: [1, 1, 0] },
  ] as const)('keeps extinction and scattering of %j', (given) => {
    const { parameters, lost } = fromOpenPbr12({ transmission_weight: 1, ...given });
    expect(lost).toEqual([]);
    const valid = validateParameters(parameters);
    expect(valid.warnings).toEqual([]);
    const medium = transmissionMedium(resolveParameters(valid.parameters));
    const { extinction, scattering } = drafted(given);
    extinction.forEach((value, k) => {
      expect(medium.extinction[k]).toBeCloseTo(value, 9);
      expect(medium.scattering[k]).toBeCloseTo(scattering[k]!, 9);
    });
  });

  it('without a depth there is no medium', () => {
    expect(fromOpenPbr12({ transmission_weight: 1, transmission_scatter: [1, 1, 1] }).parameters).toEqual({
      transmission_weight: 1,
    });
  });

  it('lists what 1.1.1 cannot have, where it acts', () => {
    const lost = (given: OpenPbr12Parameters) => fromOpenPbr12(given).lost.map(({ parameter }) => parameter);
    const drawn = { specular_haze: 0.2, specular_haze_spread: 0.5, specular_retroreflectivity: 1 };
    expect(fromOpenPbr12(drawn)).toEqual({ parameters: drawn, lost: [] });
    expect(lost({ specular_weight: 0.5 })).toEqual([]);
    expect(lost({ specular_weight: 0.5, transmission_weight: 1 })).toEqual(['specular_weight']);
  });
});

it('the documented example converts, and reports what is lost', () => {
  expect(glowing).toEqual({ emission_color: [1, 0.8, 0.6], emission_luminance: 500 });
  const warn = vi.spyOn(console, 'warn').mockImplementation(() => undefined);
  expect(drawable({ specular_haze: 0.2 })).toEqual({ specular_haze: 0.2 });
  const coupled = { specular_weight: 0.5, transmission_weight: 1 };
  expect(drawable(coupled)).toEqual(coupled);
  expect(warn.mock.calls.flat()).toEqual([expect.stringMatching(/^specular_weight: /)]);
  warn.mockRestore();
});

describe('readMaterialX with OpenPBR 1.2', () => {
  const document = (inputs: string, beside = '') => `<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
${beside}
<open_pbr_surface name="surface" type="surfaceshader" version="1.2">
${inputs}
</open_pbr_surface>
</materialx>`;
  const read = (text: string, openPbr?: '1.1.1' | '1.2') => {
    const { materials, warnings } = readMaterialX(text, openPbr ? { openPbr } : {});
    return { ...materials[0]!, warnings };
  };
  const input = (name: string, value: string, type = 'float') =>
    `<input name="${name}" type="${type}" value="${value}" />`;
  const image = (name: string) =>
    `<image name="${name}" type="float"><input name="file" type="filename" value="${name}.png" /></image>`;
  const emission = input('emission_weight', '0.5') + input('emission_luminance', '60');

  it('is an option; by default the surface is read as 1.1.1, with a warning', () => {
    expect(read(document(emission), '1.2')).toMatchObject({ parameters: { emission_luminance: 30 }, warnings: [] });
    const old = read(document(emission));
    expect(old.parameters.emission_luminance).toBe(60);
    expect(old.warnings.map(({ message }) => /openPbr: '1\.2'|no input "emission_weight"/.test(message))).toEqual([
      true,
      true,
    ]);
  });

  it('an image of the weight becomes one of the luminance', () => {
    const { parameters, textures, warnings } = read(
      document(
        `<input name="emission_weight" type="float" nodename="mask" />${input('emission_luminance', '60')}`,
        image('mask'),
      ),
      '1.2',
    );
    expect(parameters).toEqual({ emission_luminance: 60 });
    expect(textures).toMatchObject({ emission_luminance: { file: 'mask.png' } });
    expect(warnings).toEqual([]);
  });

  it('the albedo of scattering becomes a coefficient', () => {
    const { parameters, warnings } = read(
      document(
        input('transmission_weight', '1') +
          input('transmission_color', '0.5, 0.8, 0.9', 'color3') +
          input('transmission_depth', '2') +
          input('transmission_scatter', '0.5, 1, 0', 'color3'),
      ),
      '1.2',
    );
    expect(warnings).toEqual([]);
    const medium = transmissionMedium(resolveParameters(parameters));
    [0.5, 0.8, 0.9].forEach((t, k) => {
      expect(medium.extinction[k]).toBeCloseTo(-Math.log(t) / 2, 12);
      expect(medium.scattering[k]).toBeCloseTo((-Math.log(t) / 2) * [0.5, 1, 0][k]!, 12);
    });
  });

  it('what is lost is reported, and its images are left out', () => {
    const { textures, warnings } = read(
      document(
        input('specular_haze_spread', '0.4') + '<input name="specular_haze" type="float" nodename="mask" />',
        image('mask'),
      ),
      '1.2',
    );
    expect(textures).toBeUndefined();
    expect(warnings.map(({ code, message }) => [code, /specular_haze/.test(message)])).toEqual([
      ['openpbr/materialx-unsupported', true],
    ]);
  });
});
