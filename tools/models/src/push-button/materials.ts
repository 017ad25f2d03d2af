import type { Material } from '@glanz/scene';

type Colour = readonly [number, number, number];

const metal = (name: string, base_color: Colour, specular_roughness: number): Material => ({
  name,
  parameters: { base_metalness: 1, base_color, specular_roughness },
});
const plastic = (name: string, base_color: Colour, specular_roughness: number): Material => ({
  name,
  parameters: { base_color, specular_roughness },
});
const glowing = (
  name: string,
  base_color: Colour,
  emission_color: Colour,
  emission_luminance: number,
  specular_roughness: number,
): Material => ({
  name,
  parameters: { base_color, specular_roughness, emission_color, emission_luminance },
});

/** The materials of the push-button, by the name that parts refer to. Colours are linear Rec.709. */
export const MATERIALS = {
  'bezel chrome': metal('bezel chrome', [0.77, 0.78, 0.8], 0.14),
  'plate aluminium': metal('plate aluminium', [0.56, 0.57, 0.59], 0.36),
  'zinc die-cast': metal('zinc die-cast', [0.5, 0.5, 0.51], 0.3),
  'zinc-plated steel': metal('zinc-plated steel', [0.62, 0.61, 0.58], 0.2),
  brass: metal('brass', [0.887, 0.7, 0.35], 0.24),
  copper: metal('copper', [0.926, 0.56, 0.42], 0.26),
  'lens green': glowing('lens green', [0.012, 0.33, 0.08], [0.03, 1, 0.2], 0.14, 0.06),
  'halo light': glowing('halo light', [0.5, 0.6, 0.5], [0.22, 1, 0.42], 3.2, 0.2),
  'legend white': glowing('legend white', [0.8, 0.8, 0.8], [1, 1, 1], 1.4, 0.3),
  'rubber black': plastic('rubber black', [0.018, 0.018, 0.019], 0.65),
  'polyamide black': plastic('polyamide black', [0.028, 0.029, 0.031], 0.38),
  'polyamide grey': plastic('polyamide grey', [0.33, 0.34, 0.35], 0.42),
  'polycarbonate white': plastic('polycarbonate white', [0.74, 0.73, 0.7], 0.26),
  'polyamide green': plastic('polyamide green', [0.02, 0.27, 0.08], 0.34),
  'polyamide red': plastic('polyamide red', [0.5, 0.02, 0.02], 0.34),
  'polyamide orange': plastic('polyamide orange', [0.82, 0.2, 0.015], 0.34),
  'insulation blue': plastic('insulation blue', [0.02, 0.07, 0.35], 0.32),
  'insulation red': plastic('insulation red', [0.48, 0.02, 0.02], 0.32),
  'insulation black': plastic('insulation black', [0.02, 0.02, 0.022], 0.32),
} as const satisfies Record<string, Material>;

/** Name of one of the {@link MATERIALS}. */
export type MaterialName = keyof typeof MATERIALS;
