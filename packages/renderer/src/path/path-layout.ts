import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { blockLayout, type BlockLayout } from '../storage/blocks';
import { filmLightPasses } from '../storage/film-light-passes';
import path from './path.wesl';

/** What decides how much a path carries. */
export interface PathShape {
  /** Sums of light that are kept apart: one for each light group, four times as many with catchers. */
  readonly lightPasses: number;
  /**
   * With `PATH_STATE` paths remember what kinds of bounces they have made, with `CATCHER` what they are traced for,
   * with `MEDIA` the interiors they are in, with `AOVS` and the flags of single AOVs the words of `path_aov.wesl`.
   */
  readonly flags: Readonly<Record<string, boolean>>;
}

/** A path between two kernels, and the functions by which kernels add light to it. */
export interface PathLayout {
  /** How paths lie in memory. */
  readonly records: BlockLayout;
  /**
   * `fn path_<field>(index: u32)` and `fn path_set_<field>(index: u32, value)` for each field, see {@link blockLayout},
   * and `path.wesl`.
   */
  readonly module: WgslModule;
  /** The numbers of light passes and groups, see {@link filmLightPasses}. */
  readonly lightPasses: WgslModule;
}

const layouts = new Map<string, PathLayout>();

const COMMON = {
  origin: 'vec3f',
  /** Solid-angle density with which the direction was chosen. */
  pdf: 'f32',
  direction: 'vec3f',
  /** Width of its footprint at the origin, and the normal there; see `path_cone.wesl`. */
  cone: 'u32',
  throughput: 'vec3f',
  alpha: 'f32',
  /** Barycentrics as float bits, triangle, instance; see BvhHit. */
  hit: 'vec4u',
} as const;

const STATE = {
  /** Bounces so far, a byte each: diffuse, specular, transmitted, in volumes. */
  bounces: 'u32',
  /** Widest bounce so far, as the α of a GGX lobe as wide. */
  spread: 'f32',
} as const;

/** What a path carries in a scene with interiors. */
const INTERIOR = {
  /** The interiors it is in; see the media module. */
  media: 'vec2u',
  /** Low half: edges so far; high half: scattering events in media. */
  counters: 'u32',
  /** Metres from the last vertex to the origin, past null interfaces. */
  travelled: 'f32',
  /** Nanometres, once dispersion has chosen one; 0 before. */
  wavelength: 'f32',
} as const;

/** The light sample that was chosen for a path's first vertex, see reservoirs.wesl. */
const CHOSEN = {
  /** Its record. */
  chosen_light: 'u32',
  /** Place on it, two numbers as bits. */
  chosen_place: 'vec2u',
  /** What its light counts for; below 0 where none was to be chosen. */
  chosen_weight: 'f32',
} as const;

/** By the flag that brings them: words that no requested AOV needs would cost their memory traffic. */
const AOVS = {
  AOVS: { aov_state: 'u32', aov_color: 'u32', aov_depth: 'f32' },
  AOV_NORMAL: { aov_normal: 'u32' },
  AOV_POSITION: { aov_reach: 'f32' },
  AOV_IDS: { aov_instance: 'u32' },
} as const;

const WITH_AOVS = Object.keys(AOVS) as (keyof typeof AOVS)[];

/** The layout of paths for a scene. Kernels touch the light of a path through its functions only. */
export function pathLayout({ lightPasses, flags }: PathShape): PathLayout {
  const key = `${lightPasses} ${['PATH_STATE', 'CATCHER', 'MEDIA', 'LIGHT_PATHS', 'LIGHT_REUSE', 'REFRACTED_LIGHT', ...WITH_AOVS].map((flag) => flags[flag] === true).join()}`;
  let layout = layouts.get(key);
  if (!layout) {
    const fields = {
      ...COMMON,
      ...(lightPasses > 1 ? { light: ['vec4f', lightPasses] as const } : { radiance: 'vec3f' as const }),
      /** Index in the film. */ pixel: 'u32',
    } as const;
    const records = blockLayout('Path', 'path', 'paths', {
      ...fields,
      ...(flags.PATH_STATE ? STATE : {}),
      ...(flags.CATCHER ? { role: 'u32' } : {}),
      ...(flags.MEDIA ? INTERIOR : {}),
      /** See light_chains.wesl; light paths that a rough surface has reflected keep its hit, and their light. */
      ...(flags.LIGHT_PATHS ? { chain: 'f32', gloss: 'vec4u', gloss_light: 'vec4f' } : {}),
      ...(flags.LIGHT_REUSE ? CHOSEN : {}),
      /** See refracted_light.wesl. */
      ...(flags.REFRACTED_LIGHT ? { scattered: 'vec4f', refracted: 'f32' } : {}),
      ...Object.assign({}, ...WITH_AOVS.map((flag) => (flags[flag] ? AOVS[flag] : {}))),
    });
    const film = filmLightPasses(lightPasses, flags.CATCHER === true);
    const module = wgslModule('renderer/path-of-scene', '', [records.module, gated('PASSES', film), path]);
    layouts.set(key, (layout = { records, module, lightPasses: film }));
  }
  return layout;
}
