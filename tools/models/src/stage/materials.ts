import type { Material } from '@glanz/scene';

type Colour = readonly [number, number, number];
type Extra = Material['parameters'];

/** A matte surface. Colours here are linear Rec.709. */
export const matte = (name: string, base_color: Colour, extra: Extra = {}): Material => ({
  name,
  parameters: { base_color, base_metalness: 0, specular_roughness: 0.7, specular_weight: 0.4, ...extra },
});

/** A plastic or lacquer. */
export const plastic = (name: string, base_color: Colour, specular_roughness = 0.3, extra: Extra = {}): Material => ({
  name,
  parameters: { base_color, base_metalness: 0, specular_roughness, ...extra },
});

/** A metal, by its reflectance at normal incidence. */
export const metal = (name: string, base_color: Colour, specular_roughness = 0.2, extra: Extra = {}): Material => ({
  name,
  parameters: { base_color, base_metalness: 1, specular_roughness, ...extra },
});

/** A surface that emits light from its front, black otherwise. */
export const emitter = (name: string, emission_luminance: number, emission_color: Colour = [1, 1, 1]): Material => ({
  name,
  parameters: {
    base_color: [0, 0, 0],
    base_metalness: 0,
    specular_weight: 0,
    specular_roughness: 1,
    emission_color,
    emission_luminance,
  },
});

/** A clear solid. `depth` (metres) is how far light goes until it has `transmission_color`. */
export const glass = (
  name: string,
  {
    color = [1, 1, 1],
    depth = 0,
    ior = 1.5,
    roughness = 0,
    extra = {},
  }: { color?: Colour; depth?: number; ior?: number; roughness?: number; extra?: Extra } = {},
): Material => ({
  name,
  parameters: {
    base_color: [1, 1, 1],
    base_metalness: 0,
    specular_roughness: roughness,
    specular_ior: ior,
    transmission_weight: 1,
    transmission_color: color,
    ...(depth > 0 ? { transmission_depth: depth } : {}),
    ...extra,
  },
});

/** A translucent solid: light enters and scatters. `radius` is the mean free path, metres. */
export const translucent = (
  name: string,
  {
    color,
    radius,
    scale = [1, 1, 1],
    roughness = 0.4,
    extra = {},
  }: { color: Colour; radius: number; scale?: Colour; roughness?: number; extra?: Extra },
): Material => ({
  name,
  parameters: {
    base_color: color,
    base_metalness: 0,
    specular_roughness: roughness,
    subsurface_weight: 1,
    subsurface_color: color,
    subsurface_radius: radius,
    subsurface_radius_scale: scale,
    ...extra,
  },
});

/** Cloth with fibres that scatter light at grazing angles. */
export const cloth = (name: string, base_color: Colour, fuzz: Colour, weight = 0.8, fuzz_roughness = 0.5): Material => {
  // The brightest channel of the fuzz is part of its weight, as in glTF.
  const brightest = Math.max(...fuzz);
  return {
    name,
    parameters: {
      base_color,
      base_metalness: 0,
      specular_roughness: 0.9,
      specular_weight: 0.2,
      fuzz_color: [fuzz[0] / brightest, fuzz[1] / brightest, fuzz[2] / brightest],
      fuzz_weight: weight * brightest,
      fuzz_roughness,
    },
  };
};

/** A clear lacquer over another material: glTF's coat, of index 1.5. */
export const coated = ({ name, parameters }: Material, coat_roughness = 0.02, coat_weight = 1): Material => ({
  name,
  parameters: { ...parameters, coat_weight, coat_roughness, coat_ior: 1.5, coat_darkening: 0 },
});

export const GOLD: Colour = [1, 0.766, 0.336];
export const SILVER: Colour = [0.95, 0.93, 0.89];
export const STEEL: Colour = [0.62, 0.61, 0.6];
export const CHROME: Colour = [0.78, 0.79, 0.81];
export const ALUMINIUM: Colour = [0.91, 0.92, 0.92];
export const COPPER: Colour = [0.955, 0.638, 0.538];
export const ROSE_GOLD: Colour = [0.95, 0.64, 0.52];
export const BRASS: Colour = [0.91, 0.74, 0.4];
