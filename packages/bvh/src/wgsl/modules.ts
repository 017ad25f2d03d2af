// The modules in WESL that are published, with their types and documentation.
import type { WgslModule } from '@glanz/wgsl/module';
import offset from './offset.wesl';

/**
 * `fn bvh_offset_origin(position: vec3f, normal: vec3f, magnitude: f32) -> vec3f`: the origin of a secondary ray,
 * offset so that the ray does not hit the surface that it leaves; `const BVH_OFFSET`: the offset as a fraction of
 * `magnitude`.
 *
 * `normal` is the geometric normal, unit, on the side that the ray goes to. `magnitude` is the largest coordinate that
 * went into `position`, before anything cancels out: of the triangle's vertices in the world, with the translation of
 * the instance. Rounding errors are proportional to it. The step is `BVH_OFFSET`, 2^-18, of it: 4 µm for a model of one
 * metre.
 */
export const bvhOffset: WgslModule = offset;
