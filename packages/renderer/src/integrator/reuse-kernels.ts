import type { WgslModule } from '@glanz/wgsl';
import reservoirs from '../lights/reservoirs/reservoirs.wesl';
import reservoirsArrived from '../lights/reservoirs/reservoirs_arrived.wesl';
import reservoirsDirect from '../lights/reservoirs/reservoirs_direct.wesl';
import { modulesOf } from './modules-of';
import type { KernelFeatures, KernelName, KernelParts } from './pipelines';

/** What the choice of a light sample does without: it only decides which of them are worth more. */
const FLAGS = { GUIDE: false, DISPERSION: false, SCREEN_NOISE: false };

/** Modules of the renderer that the kernel calls, by name: see `reservoirs/main/host.wesl`. */
const CALLED = ['vertex', 'closure', 'path-cone', 'path-sample', 'random'];

/**
 * A kernel of a tracer that reuses light samples. Loaded where that is requested.
 *
 * @param parts What it has besides.
 * @param shade What the renderer has anyway: its text names all that the kernel calls.
 */
export function reuseKernel(
  name: KernelName,
  features: KernelFeatures,
  parts: KernelParts = {},
  shade: WgslModule,
): readonly [KernelFeatures, KernelParts] {
  const extended = (host: readonly WgslModule[], more: KernelParts) => ({
    ...parts,
    ...more,
    host: [...(parts.host ?? []), ...host],
  });
  switch (name) {
    case 'shade':
      return [features, extended([reservoirsDirect], {})];
    case 'connect':
      return [
        features,
        extended([...modulesOf(shade, ['path-sample']), reservoirsArrived], {
          more: ['frame', 'batch', 'reservoirs_visible'],
        }),
      ];
    case 'reservoirs':
      return [
        { ...features, flags: { ...features.flags, ...FLAGS } },
        extended(modulesOf(shade, CALLED), {
          root: reservoirs,
          resources: [
            'frame',
            'batch',
            'history',
            'history_moves',
            'paths',
            'triangles',
            'instances',
            'attributes',
            'materials',
            'lights',
            'light_index',
            'environment',
            'environment_table',
            'energy_dielectric',
            'energy_conductor',
            'energy_sampler',
            'reservoirs_before',
            'reservoirs_surfaces_before',
            'reservoirs_visible_before',
            'reservoirs_kept',
            'reservoirs_surfaces',
          ],
        }),
      ];
    default:
      return [features, parts];
  }
}
