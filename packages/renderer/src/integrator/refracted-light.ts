import type { WgslModule } from '@glanz/wgsl';
import refractedIntersect from '../lights/refracted/refracted_intersect.wesl';
import { modulesOf } from './modules-of';
import type { KernelParts } from './pipelines';

/**
 * The intersect kernel of a scene whose media scatter behind smooth glass. Loaded where there are such.
 *
 * @param parts What it has besides.
 * @param own What the renderer has anyway: the shade kernel and the intersect kernel, which name all that it calls.
 */
export const refracted = (
  parts: KernelParts | undefined,
  [shade, intersect]: readonly [WgslModule, WgslModule],
): KernelParts => ({
  ...parts,
  host: [
    ...(parts?.host ?? []),
    ...modulesOf(shade, ['biased-options', 'path-depth']),
    ...modulesOf(intersect, ['volume']),
  ],
  root: refractedIntersect,
});
