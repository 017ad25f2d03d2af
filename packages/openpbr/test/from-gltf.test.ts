import { describe, expect, it } from 'vitest';
import { coatedBase, subsurfaceMedium, transmissionMedium } from '../src/cpu/index';
import { fromGltf, gltfTextures, type GltfMaterialExtensions, type GltfMaterialFactors } from '../src/gltf/index';
import {
  OPENPBR_PARAMETERS,
  resolveParameters,
  validateParameters,
  type OpenPbrParameterName,
} from '../src/parameters/index';

/** A smooth dielectric of the given base colour with extensions. */
const mapped = (extensions: GltfMaterialExtensions, more: Partial<GltfMaterialFactors> = {}) =>
  fromGltf({
    pbrMetallicRoughness: { baseColorFactor: [0.5, 0.25, 0.125, 1], metallicFactor: 0, roughnessFactor: 0.5 },
    ...more,
    extensions,
  });
const plain = mapped({});

/** Reflectance at normal incidence, per channel, of a dielectric by OpenPBR's definition. */
const reflectance = (given: ReturnType<typeof fromGltf>) => {
  const { specular_ior: ior, specular_weight: weight, specular_color: color } = resolveParameters(given);
  return color.map((c) => c * Math.min(1, weight * ((ior - 1) / (ior + 1)) ** 2));
};

describe('metallic-roughness', () => {
  it("has glTF's defaults", () => {
    expect(fromGltf({})).toEqual({ base_color: [1, 1, 1], base_metalness: 1, specular_roughness: 1 });
  });

  it('takes alpha as coverage unless it is opaque', () => {
    const alpha = { pbrMetallicRoughness: { baseColorFactor: [1, 1, 1, 0.25] } };
    expect(fromGltf(alpha)).not.toHaveProperty('geometry_opacity');
    for (const alphaMode of ['MASK', 'BLEND']) expect(fromGltf({ ...alpha, alphaMode }).geometry_opacity).toBe(0.25);
  });

  it('leaves the material as it is', () => {
    const material = Object.freeze({
      pbrMetallicRoughness: Object.freeze({ baseColorFactor: Object.freeze([0.1, 0.2, 0.3, 1]) }),
      extensions: Object.freeze({ KHR_materials_unlit: Object.freeze({}) }),
    });
    expect(() => fromGltf(material)).not.toThrow();
  });
});

describe('KHR_materials_emissive_strength', () => {
  it('multiplies the emission', () => {
    expect(
      mapped({ KHR_materials_emissive_strength: { emissiveStrength: 20 } }, { emissiveFactor: [1, 0.5, 0] }),
    ).toMatchObject({ emission_color: [1, 0.5, 0], emission_luminance: 20 });
    expect(mapped({}, { emissiveFactor: [0, 0, 1] }).emission_luminance).toBe(1);
    expect(mapped({ KHR_materials_emissive_strength: { emissiveStrength: 20 } })).toEqual(plain);
  });
});

describe('KHR_materials_ior', () => {
  it('is the index; 0 reflects everything', () => {
    expect(mapped({ KHR_materials_ior: { ior: 1.33 } }).specular_ior).toBe(1.33);
    expect(reflectance(mapped({ KHR_materials_ior: { ior: 0 } }))[0]).toBeGreaterThan(0.99);
  });
});

describe('KHR_materials_specular', () => {
  // The extension: F0 = min(((ior - 1)/(ior + 1))² · specularColor, 1) · specular.
  it.each([
    [1, [1, 1, 1], 1.5],
    [0.5, [1, 0.5, 0.25], 1.5],
    [0.25, [3, 1, 2], 1.8],
    [1, [0, 0, 0], 1.5],
  ])(
    'factor %s, colour %j at index %s: reflectance as the extension has it',
    (specularFactor, specularColorFactor, ior) => {
      const f0 = ((ior - 1) / (ior + 1)) ** 2;
      const given = mapped({
        KHR_materials_ior: { ior },
        KHR_materials_specular: { specularFactor, specularColorFactor },
      });
      reflectance(given).forEach((value, k) =>
        expect(value).toBeCloseTo(Math.min(f0 * specularColorFactor[k]!, 1) * specularFactor, 12),
      );
      // Where light goes through, the same, but refraction keeps its index.
      const glass = mapped({
        KHR_materials_ior: { ior },
        KHR_materials_specular: { specularFactor, specularColorFactor },
        KHR_materials_transmission: { transmissionFactor: 1 },
      });
      reflectance(glass).forEach((value, k) =>
        expect(value).toBeCloseTo(Math.min(f0 * specularColorFactor[k]!, 1) * specularFactor, 12),
      );
      if (Math.max(...specularColorFactor) === 1) expect(glass.specular_weight).toBe(1);
    },
  );

  it('does not touch metal', () => {
    expect(
      fromGltf({ extensions: { KHR_materials_specular: { specularFactor: 0.2, specularColorFactor: [1, 0, 0] } } }),
    ).toMatchObject({ specular_weight: 1, specular_color: [1, 1, 1] });
  });
});

describe('KHR_materials_transmission and _volume', () => {
  const transmission = { KHR_materials_transmission: { transmissionFactor: 0.75 } };

  it('without thickness is a thin wall, tinted by the base colour', () => {
    for (const extensions of [
      transmission,
      {
        ...transmission,
        KHR_materials_volume: { thicknessFactor: 0, attenuationDistance: 1, attenuationColor: [0.5, 0.5, 0.5] },
      },
    ]) {
      expect(mapped(extensions)).toEqual({
        ...plain,
        transmission_weight: 0.75,
        geometry_thin_walled: true,
        transmission_color: [0.5, 0.25, 0.125],
      });
    }
  });

  it("with thickness is a solid that absorbs by Beer's law", () => {
    const given = mapped({
      ...transmission,
      KHR_materials_volume: { thicknessFactor: 2, attenuationDistance: 0.3, attenuationColor: [0.1, 0.5, 1] },
    });
    expect(given).toEqual({
      ...plain,
      transmission_weight: 0.75,
      geometry_thin_walled: false,
      transmission_depth: 0.3,
      transmission_color: [0.1, 0.5, 1],
    });
    // glTF: T(x) = c^(x/d). OpenPBR: μ_t = -ln(color)/depth, T(x) = e^(-μ_t x).
    const { transmission_color: color, transmission_depth: depth } = resolveParameters(given);
    expect(Math.exp((Math.log(color[1]) / depth) * 0.9)).toBeCloseTo(0.5 ** (0.9 / 0.3), 12);
  });

  it('that absorbs nothing is tinted at the surface', () => {
    for (const volume of [
      { thicknessFactor: 1 },
      { thicknessFactor: 1, attenuationDistance: 0.007, attenuationColor: [1, 1, 1] },
    ]) {
      expect(mapped({ ...transmission, KHR_materials_volume: volume })).toEqual({
        ...plain,
        transmission_weight: 0.75,
        geometry_thin_walled: false,
        transmission_color: [0.5, 0.25, 0.125],
      });
    }
  });

  it('alone, a volume is not seen', () => {
    expect(
      mapped({ KHR_materials_volume: { thicknessFactor: 1, attenuationDistance: 1, attenuationColor: [1, 0, 0] } }),
    ).toEqual(plain);
  });
});

describe('KHR_materials_dispersion', () => {
  it.each([0.1, 1, 5])('%s is 20 / V_d', (dispersion) => {
    const given = resolveParameters(mapped({ KHR_materials_dispersion: { dispersion } }));
    expect(given.transmission_dispersion_abbe_number / given.transmission_dispersion_scale).toBeCloseTo(
      20 / dispersion,
      12,
    );
    expect(validateParameters(mapped({ KHR_materials_dispersion: { dispersion } })).warnings).toEqual([]);
  });

  it('0 is none', () => expect(mapped({ KHR_materials_dispersion: {} })).toEqual(plain));
});

describe('KHR_materials_diffuse_transmission', () => {
  const diffuse = {
    KHR_materials_diffuse_transmission: {
      diffuseTransmissionFactor: 0.4,
      diffuseTransmissionColorFactor: [0.2, 0.9, 0.1],
    },
  };

  it('on a sheet sends its share of the diffuse light through', () => {
    const given = resolveParameters(mapped(diffuse));
    expect(given).toMatchObject({
      geometry_thin_walled: true,
      subsurface_weight: 0.4,
      subsurface_color: [0.2, 0.9, 0.1],
    });
    // OpenPBR reflects (1 - g)/2 of the subsurface lobe and transmits (1 + g)/2.
    expect((1 - given.subsurface_scatter_anisotropy) / 2).toBe(0);
  });

  it('in a volume has mean free paths of the absorption', () => {
    const given = resolveParameters(
      mapped({
        ...diffuse,
        KHR_materials_volume: { thicknessFactor: 1, attenuationDistance: 0.5, attenuationColor: [0.9, 0.5, 0.1] },
      }),
    );
    expect(given.geometry_thin_walled).toBe(false);
    given.subsurface_radius_scale.forEach((scale, k) =>
      expect(scale * given.subsurface_radius).toBeCloseTo(-0.5 / Math.log([0.9, 0.5, 0.1][k]!), 12),
    );
    expect(resolveParameters(mapped({ ...diffuse, KHR_materials_volume: { thicknessFactor: 2 } }))).toMatchObject({
      subsurface_radius: 2,
      subsurface_radius_scale: [1, 1, 1],
    });
  });
});

describe('KHR_materials_anisotropy', () => {
  it.each([
    [0.5, 0.5],
    [0.1, 1],
    [0, 0.7],
    [1, 0.3],
  ])("roughness %s, strength %s: the slopes are glTF's", (roughnessFactor, anisotropyStrength) => {
    const { specular_roughness: r, specular_roughness_anisotropy: a } = resolveParameters(
      mapped({ KHR_materials_anisotropy: { anisotropyStrength } }, { pbrMetallicRoughness: { roughnessFactor } }),
    );
    // OpenPBR's definition of the slopes.
    const along = r * r * Math.sqrt(2 / (1 + (1 - a) ** 2));
    expect(along).toBeCloseTo(roughnessFactor ** 2 + (1 - roughnessFactor ** 2) * anisotropyStrength ** 2, 12);
    expect((1 - a) * along).toBeCloseTo(roughnessFactor ** 2, 12);
  });

  it('turns the tangent counter-clockwise', () => {
    expect(mapped({ KHR_materials_anisotropy: { anisotropyStrength: 0.5 } })).not.toHaveProperty('geometry_tangent');
    const [x, y, z] = mapped({
      KHR_materials_anisotropy: { anisotropyStrength: 0.5, anisotropyRotation: Math.PI / 6 },
    }).geometry_tangent!;
    expect([x, y, z].map((c) => +c.toFixed(6))).toEqual([0.866025, 0.5, 0]);
  });

  it('0 is none', () => expect(mapped({ KHR_materials_anisotropy: { anisotropyRotation: 1 } })).toEqual(plain));
});

describe('KHR_materials_iridescence', () => {
  it('has its thickness in micrometres', () => {
    expect(
      mapped({
        KHR_materials_iridescence: {
          iridescenceFactor: 0.5,
          iridescenceIor: 1.8,
          iridescenceThicknessMinimum: 200,
          iridescenceThicknessMaximum: 550,
        },
      }),
    ).toEqual({ ...plain, thin_film_weight: 0.5, thin_film_thickness: 0.55, thin_film_ior: 1.8 });
    expect(mapped({ KHR_materials_iridescence: { iridescenceFactor: 1 } })).toMatchObject({
      thin_film_thickness: 0.4,
      thin_film_ior: 1.3,
    });
    expect(mapped({ KHR_materials_iridescence: {} })).toEqual(plain);
  });
});

describe('KHR_materials_sheen', () => {
  it('becomes fuzz: the brightest channel is its coverage', () => {
    expect(mapped({ KHR_materials_sheen: { sheenColorFactor: [0.2, 0.4, 0.1], sheenRoughnessFactor: 0.5 } })).toEqual({
      ...plain,
      fuzz_weight: 0.4,
      fuzz_color: [0.5, 1, 0.25],
      fuzz_roughness: 0.164 + 0.453 - 0.07025,
    });
    expect(mapped({ KHR_materials_sheen: { sheenRoughnessFactor: 0.5 } })).toEqual(plain);
  });
});

describe('KHR_materials_volume_scatter', () => {
  const volume = { thicknessFactor: 1, attenuationDistance: 0.02, attenuationColor: [0.9, 0.4, 0.001] };
  const scatter = { multiscatterColorFactor: [0.572, 0.227, 0.9], scatterAnisotropy: 0.3 };
  /** The extension's formula of the single-scattering albedo, as its text has it. */
  const single = (m: number) => 1 - (4.09712 + 4.20863 * m - Math.sqrt(9.59217 + 41.6808 * m + 17.7126 * m ** 2)) ** 2;

  it('in what is clear: σt = −ln(c)/d, σs = ρss·σt, phase function of g', () => {
    for (const given of [scatter, { multiscatterColor: scatter.multiscatterColorFactor, scatterAnisotropy: 0.3 }]) {
      const { parameters, warnings } = validateParameters(
        mapped({
          KHR_materials_transmission: { transmissionFactor: 1 },
          KHR_materials_volume: volume,
          KHR_materials_volume_scatter: given,
        }),
      );
      expect(warnings).toEqual([]);
      const medium = transmissionMedium(resolveParameters(parameters));
      expect(medium.anisotropy).toBe(0.3);
      volume.attenuationColor.forEach((c, k) => {
        const attenuation = -Math.log(c) / volume.attenuationDistance;
        expect(medium.extinction[k]! / attenuation).toBeCloseTo(1, 9);
        expect(medium.scattering[k]! / (attenuation * single(scatter.multiscatterColorFactor[k]!))).toBeCloseTo(1, 9);
      });
    }
  });

  it('entered by diffuse transmission: the subsurface of that colour, with the attenuation as extinction', () => {
    const given = mapped({
      KHR_materials_diffuse_transmission: { diffuseTransmissionFactor: 0.8 },
      KHR_materials_volume: volume,
      KHR_materials_volume_scatter: scatter,
    });
    expect(given).toMatchObject({
      subsurface_weight: 0.8,
      subsurface_color: scatter.multiscatterColorFactor,
      subsurface_scatter_anisotropy: 0.3,
    });
    const medium = subsurfaceMedium(resolveParameters(given));
    volume.attenuationColor.forEach((c, k) =>
      expect((medium.extinction[k]! * volume.attenuationDistance) / -Math.log(c)).toBeCloseTo(1, 9),
    );
  });

  it('does nothing without a volume, or where nothing is attenuated', () => {
    const clear = { KHR_materials_transmission: { transmissionFactor: 1 } };
    expect(mapped({ ...clear, KHR_materials_volume_scatter: scatter })).toEqual(mapped(clear));
    const thick = { ...clear, KHR_materials_volume: { thicknessFactor: 1 } };
    expect(mapped({ ...thick, KHR_materials_volume_scatter: scatter })).toEqual(mapped(thick));
  });

  it('its texture is lost', () => {
    const { uses, lost } = gltfTextures({
      extensions: { KHR_materials_volume_scatter: { ...scatter, multiscatterColorTexture: { index: 0 } } },
    });
    expect(uses).toEqual([]);
    expect(lost.map(({ path }) => path)).toEqual(['extensions/KHR_materials_volume_scatter/multiscatterColorTexture']);
  });
});

describe('KHR_materials_pbrSpecularGlossiness', () => {
  it('is a dielectric that reflects the specular colour', () => {
    const given = mapped(
      {
        KHR_materials_pbrSpecularGlossiness: {
          diffuseFactor: [0.3, 0.2, 0.1, 0.5],
          specularFactor: [0.2, 0.1, 0.05],
          glossinessFactor: 0.7,
        },
      },
      { alphaMode: 'BLEND' },
    );
    expect(given).toMatchObject({ base_color: [0.3, 0.2, 0.1], base_metalness: 0, geometry_opacity: 0.5 });
    expect(given.specular_roughness).toBeCloseTo(0.3, 12);
    reflectance(given).forEach((value, k) => expect(value).toBeCloseTo([0.2, 0.1, 0.05][k]!, 12));
    expect(reflectance(mapped({ KHR_materials_pbrSpecularGlossiness: { specularFactor: [0, 0, 0] } }))).toEqual([
      0, 0, 0,
    ]);
    expect(Number.isFinite(mapped({ KHR_materials_pbrSpecularGlossiness: {} }).specular_ior)).toBe(true);
  });
});

describe('KHR_materials_unlit', () => {
  it('is light of the base colour and nothing else', () => {
    expect(mapped({ KHR_materials_unlit: {}, KHR_materials_clearcoat: { clearcoatFactor: 1 } })).toEqual({
      base_weight: 0,
      specular_weight: 0,
      emission_color: [0.5, 0.25, 0.125],
      emission_luminance: 1,
    });
    expect(mapped({ KHR_materials_unlit: {} }, { alphaMode: 'MASK' }).geometry_opacity).toBe(1);
  });
});

describe('KHR_materials_clearcoat', () => {
  const coated = (clearcoat: Record<string, unknown>, others: Record<string, unknown> = {}) =>
    fromGltf({
      pbrMetallicRoughness: { metallicFactor: 0 },
      extensions: { KHR_materials_clearcoat: clearcoat, ...others },
    });

  it('becomes a clear coat of index 1.5 without reflections inside', () => {
    expect(coated({ clearcoatFactor: 0.5, clearcoatRoughnessFactor: 0.2 })).toMatchObject({
      coat_weight: 0.5,
      coat_roughness: 0.2,
      coat_ior: 1.5,
      coat_darkening: 0,
    });
    expect(coated({ clearcoatFactor: 1 })).toMatchObject({ coat_weight: 1, coat_roughness: 0 });
  });

  it('without a factor is none, as glTF has it', () => {
    expect(coated({ clearcoatRoughnessFactor: 0.3 })).toEqual(coated({}));
    expect(coated({})).not.toHaveProperty('coat_weight');
  });

  it('leaves the base the reflectance that it has in air', () => {
    for (const clearcoatFactor of [0.25, 0.5, 1]) {
      expect(coatedBase(resolveParameters(coated({ clearcoatFactor }))).specular_ior).toBeCloseTo(1.5, 12);
      expect(
        coatedBase(resolveParameters(coated({ clearcoatFactor }, { KHR_materials_ior: { ior: 1.8 } }))).specular_ior,
      ).toBeCloseTo(1.8, 12);
    }
    // The factor is not the whole coverage.
    expect(coated({ clearcoatFactor: 1, clearcoatTexture: { index: 0 } })).not.toHaveProperty('specular_ior');
    // The index also refracts.
    expect(
      coated({ clearcoatFactor: 1 }, { KHR_materials_transmission: { transmissionFactor: 1 } }),
    ).not.toHaveProperty('specular_ior');
  });

  it('does not change what KHR_materials_specular starts from', () => {
    const specular = { KHR_materials_specular: { specularFactor: 0.5, specularColorFactor: [2, 1, 1] } };
    expect(coated({ clearcoatFactor: 1 }, specular).specular_weight).toBe(coated({}, specular).specular_weight);
  });
});

describe('gltfTextures', () => {
  const texture = (index: number, transform?: object) => ({
    index,
    ...(transform ? { extensions: { KHR_texture_transform: transform } } : {}),
  });
  const usesOf = (material: GltfMaterialFactors) =>
    Object.fromEntries(gltfTextures(material).uses.map((use) => [use.parameter, use]));
  const brief = (material: GltfMaterialFactors) =>
    gltfTextures(material).uses.map(
      ({ parameter, texture: { index }, channels, colorSpace }) => `${parameter} ${index}.${channels} ${colorSpace}`,
    );

  it('core textures', () => {
    expect(
      brief({
        pbrMetallicRoughness: { baseColorTexture: texture(0), metallicRoughnessTexture: texture(1) },
        normalTexture: texture(2),
        emissiveTexture: texture(3),
        emissiveFactor: [1, 1, 1],
        alphaMode: 'MASK',
      }),
    ).toEqual([
      'geometry_normal 2.rgb linear',
      'emission_color 3.rgb srgb',
      'base_color 0.rgb srgb',
      'geometry_opacity 0.a srgb',
      'base_metalness 1.b linear',
      'specular_roughness 1.g linear',
    ]);
    // Black emission and opaque alpha read nothing.
    expect(brief({ pbrMetallicRoughness: { baseColorTexture: texture(0) }, emissiveTexture: texture(3) })).toEqual([
      'base_color 0.rgb srgb',
    ]);
  });

  it('textures of the extensions that only multiply', () => {
    expect(
      brief({
        extensions: {
          KHR_materials_specular: { specularTexture: texture(1), specularColorTexture: texture(2) },
          KHR_materials_transmission: { transmissionFactor: 1, transmissionTexture: texture(3) },
          KHR_materials_diffuse_transmission: {
            diffuseTransmissionFactor: 1,
            diffuseTransmissionTexture: texture(4),
            diffuseTransmissionColorTexture: texture(5),
          },
          KHR_materials_clearcoat: {
            clearcoatFactor: 1,
            clearcoatTexture: texture(6),
            clearcoatRoughnessTexture: texture(7),
            clearcoatNormalTexture: texture(8),
          },
          KHR_materials_iridescence: { iridescenceFactor: 1, iridescenceTexture: texture(9) },
        },
      }),
    ).toEqual([
      'specular_weight 1.a linear',
      'specular_color 2.rgb srgb',
      'transmission_weight 3.r linear',
      'subsurface_weight 4.a linear',
      'subsurface_color 5.rgb srgb',
      'coat_weight 6.r linear',
      'coat_roughness 7.g linear',
      'geometry_coat_normal 8.rgb linear',
      'thin_film_weight 9.r linear',
    ]);
  });

  it('the base colour tints what goes through, unless the volume absorbs', () => {
    const glass = (volume: object) =>
      brief({
        pbrMetallicRoughness: { baseColorTexture: texture(0) },
        extensions: { KHR_materials_transmission: { transmissionFactor: 1 }, KHR_materials_volume: volume },
      });
    expect(glass({})).toContain('transmission_color 0.rgb srgb');
    expect(
      glass({
        thicknessFactor: 1,
        attenuationDistance: 1,
        attenuationColor: [1, 0.5, 0],
        thicknessTexture: texture(1),
      }),
    ).toEqual(['base_color 0.rgb srgb']);
  });

  it('factors without effect bind nothing', () => {
    const none = {
      KHR_materials_transmission: { transmissionTexture: texture(1) },
      KHR_materials_clearcoat: { clearcoatTexture: texture(1) },
      KHR_materials_sheen: { sheenColorTexture: texture(1) },
      KHR_materials_iridescence: { iridescenceTexture: texture(1) },
      KHR_materials_anisotropy: { anisotropyTexture: texture(1) },
      KHR_materials_diffuse_transmission: { diffuseTransmissionTexture: texture(1) },
    };
    expect(brief({ extensions: none })).toEqual([]);
  });

  it('film thickness runs from the minimum to the maximum', () => {
    const { thin_film_thickness: use } = usesOf({
      extensions: {
        KHR_materials_iridescence: {
          iridescenceFactor: 1,
          iridescenceThicknessMinimum: 600,
          iridescenceThicknessMaximum: 150,
          iridescenceThicknessTexture: texture(1),
        },
      },
    });
    const micrometres = (g: number) =>
      (use!.value as number) * (use!.range![0] + (use!.range![1] - use!.range![0]) * g);
    expect([micrometres(0), micrometres(0.5), micrometres(1)].map((x) => +x.toFixed(9))).toEqual([0.6, 0.375, 0.15]);
  });

  it.each([
    [
      [1, 1, 1],
      [0.5, 0.25, 0.125],
    ],
    [
      [0.6, 0.7, 0.8],
      [1, 0.1, 0.3],
    ],
    [
      [1, 0, 0],
      [0, 1, 1],
    ],
  ])('sheen %j times texel %j: coverage times colour is their product', (factor, texel) => {
    const { fuzz_color: color, fuzz_weight: weight } = usesOf({
      extensions: { KHR_materials_sheen: { sheenColorFactor: factor, sheenColorTexture: texture(1) } },
    });
    expect([color!.value, weight!.value, weight!.channels]).toEqual([[1, 1, 1], 1, 'a']);
    expect(color!.image!.key).toBe(weight!.image!.key);
    const made = [0, 0, 0, 0];
    color!.image!.convert([...texel, 1], made);
    expect(made[3]).toBeCloseTo(Math.max(...factor.map((f, k) => f * texel[k]!)), 12);
    for (let k = 0; k < 3; k++) expect(made[k]! * made[3]!).toBeCloseTo(factor[k]! * texel[k]!, 12);
    expect(Math.max(...made)).toBeLessThanOrEqual(1);
  });

  it('sheen roughness is fitted texel by texel', () => {
    const { fuzz_roughness: use } = usesOf({
      extensions: {
        KHR_materials_sheen: {
          sheenColorFactor: [1, 1, 1],
          sheenRoughnessFactor: 0.8,
          sheenRoughnessTexture: texture(1),
        },
      },
    });
    const made = [0, 0, 0, 0];
    use!.image!.convert([0, 0, 0, 0.5], made);
    expect(made[0]! * (use!.value as number)).toBeCloseTo(
      fromGltf({ extensions: { KHR_materials_sheen: { sheenColorFactor: [1, 1, 1], sheenRoughnessFactor: 0.4 } } })
        .fuzz_roughness!,
      12,
    );
  });

  const anisotropic = (stretch: object | undefined, rough: object | undefined) => ({
    pbrMetallicRoughness: {
      roughnessFactor: 0.8,
      ...(rough ? { metallicRoughnessTexture: rough as { index: number } } : {}),
    },
    extensions: {
      KHR_materials_anisotropy: {
        anisotropyStrength: 0.9,
        ...(stretch ? { anisotropyTexture: stretch as { index: number } } : {}),
      },
    },
  });
  it.each([
    ['both', texture(1), texture(2), [0, 0.5, 1, 1, 0.1, 0.2, 0.7, 1], 0.8 * 0.5, 0.9 * 0.7],
    ['roughness alone', undefined, texture(2), [0, 0.5, 1, 1], 0.8 * 0.5, 0.9],
    ['strength alone', texture(1), undefined, [0.1, 0.2, 0.7, 1], 0.8, 0.9 * 0.7],
  ])(
    'anisotropy by textures of %s is as by factors',
    (_, stretch, rough, texels, roughnessFactor, anisotropyStrength) => {
      const uses = usesOf(anisotropic(stretch, rough));
      const made = [0, 0, 0, 0];
      expect(uses['specular_roughness']!.image!.key).toBe(uses['specular_roughness_anisotropy']!.image!.key);
      uses['specular_roughness']!.image!.convert(texels, made);
      const { specular_roughness, specular_roughness_anisotropy } = fromGltf({
        pbrMetallicRoughness: { roughnessFactor },
        extensions: { KHR_materials_anisotropy: { anisotropyStrength } },
      });
      expect([made[1], made[2]]).toEqual([specular_roughness, specular_roughness_anisotropy]);
      expect('geometry_tangent' in uses).toBe(stretch !== undefined);
    },
  );

  it('anisotropy by textures that lie apart reads only the direction, and says so', () => {
    const mapping = gltfTextures(anisotropic(texture(1, { scale: [2, 2] }), texture(2)));
    expect(mapping.lost.map(({ path }) => path)).toEqual(['extensions/KHR_materials_anisotropy/anisotropyTexture']);
    expect(mapping.uses.find(({ parameter }) => parameter === 'specular_roughness')!.image!.sources).toEqual([
      texture(2),
    ]);
  });

  it('specular-glossiness: reflectance and roughness texel by texel', () => {
    const specularFactor = [1, 0.8, 0.5],
      texel = [0.1, 0.2, 0.3, 0.25];
    const material = {
      extensions: {
        KHR_materials_pbrSpecularGlossiness: {
          specularFactor,
          glossinessFactor: 0.6,
          specularGlossinessTexture: texture(1),
          diffuseTexture: texture(2),
        },
      },
    };
    const uses = usesOf(material);
    const color = [0, 0, 0, 0],
      weight = [0, 0, 0, 0];
    uses['specular_color']!.image!.convert(texel, color);
    uses['specular_weight']!.image!.convert(texel, weight);
    const given = {
      ...fromGltf(material),
      specular_color: color.slice(0, 3) as unknown as readonly [number, number, number],
      specular_weight: weight[0]!,
    };
    // The largest reflectance that an index stands for is 0.98.
    reflectance(given).forEach((value, k) => expect(value / 0.98).toBeCloseTo(specularFactor[k]! * texel[k]!, 12));
    const [at0, at1] = uses['specular_roughness']!.range!;
    expect(at0 + (at1 - at0) * texel[3]!).toBeCloseTo(1 - 0.6 * 0.25, 12);
    expect(brief(material)).toContain('base_color 2.rgb srgb');
  });

  it('unlit shows its base colour texture alone', () => {
    expect(
      brief({
        pbrMetallicRoughness: { baseColorTexture: texture(0), metallicRoughnessTexture: texture(1) },
        normalTexture: texture(2),
        alphaMode: 'BLEND',
        extensions: { KHR_materials_unlit: {} },
      }),
    ).toEqual(['emission_color 0.rgb srgb', 'geometry_opacity 0.a srgb']);
  });

  it('binds only parameters that may be textured', () => {
    const all = texture(0);
    const extensions: GltfMaterialExtensions = {
      KHR_materials_specular: { specularTexture: all, specularColorTexture: all },
      KHR_materials_transmission: { transmissionFactor: 1, transmissionTexture: all },
      KHR_materials_clearcoat: { clearcoatFactor: 1, clearcoatTexture: all, clearcoatNormalTexture: all },
      KHR_materials_sheen: { sheenColorFactor: [1, 1, 1], sheenColorTexture: all, sheenRoughnessTexture: all },
      KHR_materials_anisotropy: { anisotropyStrength: 1, anisotropyTexture: all },
      KHR_materials_iridescence: { iridescenceFactor: 1, iridescenceTexture: all, iridescenceThicknessTexture: all },
    };
    const names = gltfTextures({ extensions }).uses.map(({ parameter }) => parameter);
    expect(new Set(names).size).toBe(names.length);
    for (const name of names) expect(OPENPBR_PARAMETERS[name as OpenPbrParameterName].texturable).toBe(true);
  });
});
