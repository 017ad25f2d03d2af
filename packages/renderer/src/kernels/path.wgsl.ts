import { struct, wgslModule, type StructLayout, type WgslModule } from '@glanz/wgsl';

/** What decides how much a path carries. */
export interface PathShape {
  /** Sums of light that are kept apart: one, or one for each light group. */
  readonly planes: number;
  /** With `PATH_STATE` paths remember what kinds of bounces they have made. */
  readonly flags: Readonly<Record<string, boolean>>;
}

/** A path between two kernels, and the functions by which kernels add light to it. */
export interface PathLayout {
  readonly struct: StructLayout;
  /**
   * - `fn path_deposit(index: u32, group: u32, value: vec3f)`: light of a group arrives.
   * - `fn path_clear(index: u32)`: no light so far.
   * - `fn path_plane(index: u32, plane: u32) -> vec4f`: what arrived; the first plane's w is the path's coverage.
   */
  readonly module: WgslModule;
}

const layouts = new Map<string, PathLayout>();

const COMMON = {
  origin: 'vec3f',
  /** Solid-angle density with which the direction was chosen. */
  pdf: 'f32',
  direction: 'vec3f',
  cone_width: 'f32',
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

/** The layout of paths for a scene. Kernels touch the light of a path through its functions only. */
export function pathLayout({ planes, flags }: PathShape): PathLayout {
  const key = `${planes} ${flags.PATH_STATE === true}`;
  let layout = layouts.get(key);
  if (!layout) {
    const several = planes > 1;
    const fields = { ...COMMON, ...(several ? { planes: ['vec4f', planes] as const } : { radiance: 'vec3f' as const }), /** Index in the film. */ pixel: 'u32' } as const;
    const path: StructLayout = flags.PATH_STATE ? struct('Path', { ...fields, ...STATE }) : struct('Path', fields);
    const module = wgslModule(
      'renderer/path',
      several
        ? /* wgsl */ `
fn path_deposit(index: u32, group: u32, value: vec3f) { paths[index].planes[group] += vec4f(value, 0.0); }
fn path_clear(index: u32) {
  for (var plane = 0u; plane < ${planes}u; plane++) { paths[index].planes[plane] = vec4f(0.0); }
}
fn path_plane(index: u32, plane: u32) -> vec4f { return vec4f(paths[index].planes[plane].xyz, select(0.0, paths[index].alpha, plane == 0u)); }
`
        : /* wgsl */ `
fn path_deposit(index: u32, group: u32, value: vec3f) { paths[index].radiance += value; }
fn path_clear(index: u32) { paths[index].radiance = vec3f(0.0); }
fn path_plane(index: u32, plane: u32) -> vec4f { return vec4f(paths[index].radiance, paths[index].alpha); }
`,
      [path.module],
    );
    layouts.set(key, (layout = { struct: path, module }));
  }
  return layout;
}
