import type { KernelParts } from './pipelines';
import shadowSoftness from './shadow_softness.wesl';

/** The shading kernel of softer shadows on catchers. Loaded where they are requested. @param parts What it has besides. */
export const softened = (parts?: KernelParts): KernelParts => ({
  ...parts,
  host: [...(parts?.host ?? []), shadowSoftness],
});
