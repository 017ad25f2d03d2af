import { GlanzError } from '@glanz/wgsl/error';

/** Thrown by the builders and queries. Codes: `bvh/positions`, `bvh/indices`, `bvh/transform`, `bvh/too-many`, `bvh/options`, `bvh/batch`, `bvh/region`, `bvh/worker`, `bvh/destroyed`. */
export class BvhError extends GlanzError {}
