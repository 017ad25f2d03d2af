import { GlanzError } from '@glanz/wgsl/error';

/** Thrown by the builders. Codes: `bvh/positions`, `bvh/indices`, `bvh/transform`, `bvh/too-many`, `bvh/options`. */
export class BvhError extends GlanzError {}
