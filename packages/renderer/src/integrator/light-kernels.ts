import type { WgslModule } from '@glanz/wgsl';
import lightAreaWeight from '../lights/light_paths/light_area_weight.wesl';
import lightBegin from '../lights/light_paths/light_begin.wesl';
import lightChains from '../lights/light_paths/light_chains.wesl';
import lightPicked from '../lights/light_paths/light_picked.wesl';
import lightSampleWeight from '../lights/light_paths/light_sample_weight.wesl';
import lightSplats from '../lights/light_paths/light_splats.wesl';
import lightStart from '../lights/light_paths/light_start.wesl';
import lightTrace from '../lights/light_paths/light_trace.wesl';
import lightWeights from '../lights/light_paths/light_weights.wesl';
import { modulesOf } from './modules-of';
import type { KernelFeatures, KernelName, KernelParts } from './pipelines';
import type { ResourceName } from '../storage/resources';

/** Light paths have random numbers of their own, and no surface of theirs asks for lights. */
const START = { SCREEN_NOISE: false, GUIDE: false, DISPERSION: false, LIGHT_PROFILES: false };
const TRACE = {
  SCREEN_NOISE: false,
  LIGHTS: false,
  LIGHT_TREE: false,
  LIGHT_PROFILES: false,
  AREA_LIGHTS: false,
  EMISSION_TEXTURES: false,
};

const SURFACES: readonly ResourceName[] = [
  'frame',
  'batch',
  'paths',
  'queues',
  'triangles',
  'instances',
  'attributes',
  'materials',
  'energy_dielectric',
  'energy_conductor',
  'energy_sampler',
  'environment',
  'environment_table',
  'light_casters',
];

/** Modules of the renderer that kernels of light paths call, by name: see `light_paths/main/host.wesl`. */
const CALLED = ['area-lights', 'light-choice', 'environment', 'material-records', 'path-sample', 'random'];
const START_CALLED = [...CALLED, 'area-light-sampling', 'tangent'];
const TRACE_CALLED = [
  'closure',
  'vertex',
  'path-depth',
  'path-cone',
  'path-sample',
  'random',
  'material-records',
  'instances',
  'tangent',
  'triangles',
];

/**
 * A kernel of a tracer with light paths. Loaded where they are requested.
 *
 * @param parts What it has besides.
 * @param own What the renderer has anyway: the text of the shade kernel, which names all of it, and the queries of rays.
 */
export function lightKernel(
  name: KernelName,
  features: KernelFeatures,
  parts: KernelParts = {},
  [shade, ...queries]: readonly [WgslModule, ...WgslModule[]],
): readonly [KernelFeatures, KernelParts] {
  const extended = (host: readonly WgslModule[], more: KernelParts) => ({
    ...parts,
    ...more,
    host: [...(parts.host ?? []), ...host],
  });
  const flagged = (flags: Readonly<Record<string, boolean>>) => ({
    ...features,
    flags: { ...features.flags, ...flags },
  });
  switch (name) {
    case 'shade':
    // The text that light samples are reused with is that of shade.
    case 'reservoirs':
      return [features, extended([lightChains, lightSampleWeight, lightWeights], { more: ['light_casters'] })];
    case 'intersect':
      return [features, features.flags.AREA_LIGHTS ? extended([lightAreaWeight], { more: ['light_casters'] }) : parts];
    case 'resolve':
      return [features, extended([lightSplats], { more: ['frame', 'light_splats'] })];
    case 'light_begin':
      return [features, { ...parts, root: lightBegin }];
    case 'light_start':
      return [
        flagged(START),
        extended([lightPicked, ...modulesOf(shade, START_CALLED)], {
          root: lightStart,
          resources: [...SURFACES, 'lights'],
        }),
      ];
    case 'light_trace':
      return [
        flagged(TRACE),
        extended([...queries, ...modulesOf(shade, TRACE_CALLED)], {
          root: lightTrace,
          resources: [...SURFACES, 'nodes', 'light_splats', ...(features.flags.GUIDE ? (['guide'] as const) : [])],
        }),
      ];
    default:
      return [features, parts];
  }
}
