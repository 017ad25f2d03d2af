import type { Material } from './material';

/** The material of things that come without one: OpenPBR's defaults, a grey plastic of base colour 0.8. */
export function defaultMaterial(): Material {
  return { name: 'default', parameters: {} };
}
