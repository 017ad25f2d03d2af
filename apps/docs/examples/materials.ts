import {
  OPENPBR_PARAMETERS,
  validateParameters,
  type OpenPbrParameters,
} from '@glanz/openpbr/parameters';
import type { PathTracer } from '@glanz/renderer';
import type { Material } from '@glanz/scene';
import { cssColor } from '@glanz/tonemap/css-color';

// #region materials
export const chrome: Material = {
  name: 'chrome',
  parameters: {
    base_metalness: 1,
    base_color: [0.77, 0.78, 0.8],
    specular_roughness: 0.14,
  },
};

export const rubber: Material = {
  name: 'rubber',
  parameters: { base_color: [0.018, 0.018, 0.019], specular_roughness: 0.65 },
};

export const brushed: Material = {
  name: 'brushed aluminium',
  parameters: {
    base_metalness: 1,
    base_color: [0.91, 0.92, 0.92],
    specular_roughness: 0.35,
    specular_roughness_anisotropy: 0.7,
  },
};
// #endregion materials

// #region draft
export const lacquer: Material = {
  name: 'old lacquer',
  parameters: {
    base_color: [0.02, 0.03, 0.08],
    specular_roughness: 0.05,
    specular_haze: 0.4, // of the facets
    specular_haze_spread: 0.5,
  },
};

export const tape: Material = {
  name: 'reflective tape',
  parameters: {
    base_metalness: 1,
    specular_roughness: 0.3,
    specular_retroreflectivity: 1,
  },
};
// #endregion draft

// #region edit
export async function repaint(tracer: PathTracer) {
  // By name, or by index.
  await tracer.setMaterial('housing', { base_color: [0.8, 0.1, 0.1] });
}

export async function repaintByName(tracer: PathTracer, color: string) {
  await tracer.setMaterial('housing', { base_color: cssColor(color) });
}
// #endregion edit

// #region texture
export const labelled: Material = {
  name: 'label',
  parameters: { base_color: [1, 1, 1], specular_roughness: 1 },
  textures: {
    base_color: { texture: 0, channels: 'rgb' }, // an index into scene.textures
    specular_roughness: { texture: 1, channels: 'g' },
    geometry_normal: { texture: 2, channels: 'rgb', scale: 0.8 },
  },
};
// #endregion texture

// #region validate
export function fromUser(input: Partial<OpenPbrParameters>) {
  // Clamped to each parameter's range.
  const { parameters, warnings } = validateParameters(input);
  for (const { message } of warnings) console.warn(message);
  return parameters;
}

export const sliders = Object.values(OPENPBR_PARAMETERS).filter(
  ({ type }) => type === 'float',
);
// #endregion validate
