import { GlanzError } from '@glanz/wgsl/error';

/** Thrown by the builders. Codes: `bvh/positions`, `bvh/indices`, `bvh/transform`, `bvh/too-many`, `bvh/options`, `bvh/worker`, `bvh/destroyed`. */
export class BvhError extends GlanzError {}
