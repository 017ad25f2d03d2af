import { struct, wgslModule, type StructLayout, type WgslModule } from '@glanz/wgsl';

/** What decides how much a path carries. */
export interface PathShape {
  /** Sums of light that are kept apart: one, or one for each light group. */
  readonly planes: number;
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

const layouts = new Map<number, PathLayout>();

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

/** The layout of paths for a scene. Kernels touch the light of a path through its functions only. */
export function pathLayout({ planes }: PathShape): PathLayout {
  let layout = layouts.get(planes);
  if (!layout) {
    const several = planes > 1;
    const path = several
      ? struct('Path', { ...COMMON, planes: ['vec4f', planes], /** Index in the film. */ pixel: 'u32' })
      : struct('Path', { ...COMMON, radiance: 'vec3f', pixel: 'u32' });
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
    layouts.set(planes, (layout = { struct: path, module }));
  }
  return layout;
}
