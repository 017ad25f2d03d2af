import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { blockLayout, type BlockLayout } from '../storage/blocks';

/** What decides how much a path carries. */
export interface PathShape {
  /** Sums of light that are kept apart: one for each light group, four times as many with catchers. */
  readonly planes: number;
  /**
   * With `PATH_STATE` paths remember what kinds of bounces they have made, with `CATCHER` what they are traced for,
   * with `MEDIA` the interiors they are in.
   */
  readonly flags: Readonly<Record<string, boolean>>;
}

/** A path between two kernels, and the functions by which kernels add light to it. */
export interface PathLayout {
  /** How paths lie in memory. */
  readonly records: BlockLayout;
  /**
   * - `fn path_<field>(index: u32)` and `fn path_set_<field>(index: u32, value)` for each field, see
   *   {@link blockLayout}.
   * - `fn path_deposit(index: u32, group: u32, value: vec3f)`: light of a group arrives.
   * - `fn path_clear(index: u32)`: no light so far.
   * - `fn path_plane(index: u32, plane: u32) -> vec4f`: what arrived; the first plane's w is the path's coverage.
   *
   * With catchers every sample has two paths: one as usual, and one that after a catcher sees nothing but catchers and
   * what glows. Planes come four by four: objects, catchers with the objects, catchers without them, what lies behind
   * catchers.
   */
  readonly module: WgslModule;
}

const layouts = new Map<string, PathLayout>();

const COMMON = {
  origin: 'vec3f',
  /** Solid-angle density with which the direction was chosen. */
  pdf: 'f32',
  direction: 'vec3f',
  /** Width of its footprint at the origin, and the normal there; see `pathCone`. */
  cone: 'u32',
  throughput: 'vec3f',
  alpha: 'f32',
  /** Barycentrics as float bits, triangle, instance; see BvhHit. */
  hit: 'vec4u',
} as const;

/** `fn path_sample(index: u32) -> u32`: number of the sample that the path at this place of the batch belongs to. */
export const pathSample = wgslModule(
  'renderer/path-sample',
  /* wgsl */ `
fn path_sample(index: u32) -> u32 {
  //#if CATCHER
  return batch.sample_offset + (index % (batch.pixel_count * batch.sample_count)) / batch.pixel_count;
  //#else
  return batch.sample_offset + index / batch.pixel_count;
  //#endif
}
`,
);

/**
 * A footprint's width and a normal in one word: the upper half of the width's bits, and two bytes of an octahedral
 * normal (Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors", JCGT 2014).
 *
 * - `fn cone_pack(width: f32, normal: vec3f) -> u32`; a normal of 0 is kept as such.
 * - `fn cone_width(cone: u32) -> f32`
 * - `fn cone_normal(cone: u32) -> vec3f`
 */
export const pathCone = wgslModule(
  'renderer/path-cone',
  /* wgsl */ `
fn cone_fold(p: vec2f) -> vec2f { return (1.0 - abs(p.yx)) * select(vec2f(-1.0), vec2f(1.0), p >= vec2f(0.0)); }

fn cone_pack(width: f32, normal: vec3f) -> u32 {
  let upper = bitcast<u32>(width) & 0xffff0000u;
  if (all(normal == vec3f(0.0))) { return upper; }
  let flat = normal.xy / (abs(normal.x) + abs(normal.y) + abs(normal.z));
  let folded = select(flat, cone_fold(flat), normal.z < 0.0);
  let bytes = vec2u(128.5 + 127.0 * clamp(folded, vec2f(-1.0), vec2f(1.0)));
  return upper | (bytes.y << 8u) | bytes.x;
}

fn cone_width(cone: u32) -> f32 { return bitcast<f32>(cone & 0xffff0000u); }

fn cone_normal(cone: u32) -> vec3f {
  if ((cone & 0xffffu) == 0u) { return vec3f(0.0); }
  let folded = (vec2f(f32(cone & 255u), f32((cone >> 8u) & 255u)) - 128.0) / 127.0;
  let z = 1.0 - abs(folded.x) - abs(folded.y);
  return normalize(vec3f(select(folded, cone_fold(folded), z < 0.0), z));
}
`,
);

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
  /** Metres from the last vertex to the origin, past surfaces that are not there. */
  travelled: 'f32',
  /** Nanometres, once dispersion has chosen one; 0 before. */
  wavelength: 'f32',
} as const;

/** The layout of paths for a scene. Kernels touch the light of a path through its functions only. */
export function pathLayout({ planes, flags }: PathShape): PathLayout {
  const key = `${planes} ${flags.PATH_STATE === true} ${flags.CATCHER === true} ${flags.MEDIA === true}`;
  let layout = layouts.get(key);
  if (!layout) {
    const several = planes > 1;
    const fields = {
      ...COMMON,
      ...(several ? { planes: ['vec4f', planes] as const } : { radiance: 'vec3f' as const }),
      /** Index in the film. */ pixel: 'u32',
    } as const;
    const records = blockLayout('Path', 'path', 'paths', {
      ...fields,
      ...(flags.PATH_STATE ? STATE : {}),
      ...(flags.CATCHER ? { role: 'u32' } : {}),
      ...(flags.MEDIA ? INTERIOR : {}),
    });
    const groups = flags.CATCHER ? planes / 4 : planes;
    const module = wgslModule(
      'renderer/path',
      several
        ? /* wgsl */ `
fn path_add(index: u32, plane: u32, value: vec3f) { path_set_planes(index, plane, path_planes(index, plane) + vec4f(value, 0.0)); }
//#if CATCHER
const PATH_OBJECT = 0u;
const PATH_WITH = 1u;
const PATH_WITHOUT = 2u;
fn path_deposit(index: u32, group: u32, value: vec3f) { path_add(index, path_role(index) * ${groups}u + group, value); }
fn path_behind(index: u32, group: u32, value: vec3f) { path_add(index, ${3 * groups}u + group, value); }
//#else
fn path_deposit(index: u32, group: u32, value: vec3f) { path_add(index, group, value); }
//#endif
fn path_clear(index: u32) {
  for (var plane = 0u; plane < ${planes}u; plane++) { path_set_planes(index, plane, vec4f(0.0)); }
}
fn path_plane(index: u32, plane: u32) -> vec4f {
  var coverage = select(0.0, min(path_alpha(index), 1.0), plane == 0u);
  //#if CATCHER
  coverage = select(coverage, 1.0, plane == ${groups}u && path_role(index) == PATH_WITH);
  //#endif
  return vec4f(path_planes(index, plane).xyz, coverage);
}
`
        : /* wgsl */ `
fn path_deposit(index: u32, group: u32, value: vec3f) { path_set_radiance(index, path_radiance(index) + value); }
fn path_clear(index: u32) { path_set_radiance(index, vec3f(0.0)); }
fn path_plane(index: u32, plane: u32) -> vec4f { return vec4f(path_radiance(index), min(path_alpha(index), 1.0)); }
`,
      [records.module],
    );
    layouts.set(key, (layout = { records, module }));
  }
  return layout;
}
