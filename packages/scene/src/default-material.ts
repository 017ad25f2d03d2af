import type { Material } from './material';

/** The material of meshes that have none: OpenPBR's defaults, a grey plastic of base colour 0.8. */
export function defaultMaterial(): Material {
  return { name: 'default', parameters: {} };
}
