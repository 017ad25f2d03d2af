import lightProfile from '../lights/light_profile.wesl';
import dispersion from './dispersion.wesl';
import type { KernelName, KernelParts } from './pipelines';

/**
 * A kernel of a scene with dispersion or measured lights. Loaded where there are some.
 *
 * @param flags Of the kernel.
 * @param parts What it has besides.
 */
export const rareKernel = (
  name: KernelName,
  flags: Readonly<Record<string, boolean>>,
  parts?: KernelParts,
): KernelParts => ({
  ...parts,
  host: [
    ...(parts?.host ?? []),
    flags.DISPERSION && dispersion,
    // Light paths ask for no light samples.
    flags.LIGHT_PROFILES && name !== 'light_trace' && lightProfile,
  ],
});
