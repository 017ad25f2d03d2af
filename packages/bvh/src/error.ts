import { GlanzError } from '@glanz/wgsl/error';

/**
 * Thrown by all functions of this package. Codes: `bvh/positions`, `bvh/indices`, `bvh/transform`, `bvh/instance`,
 * `bvh/too-many`, `bvh/options`, `bvh/batch`, `bvh/region`, `bvh/worker`, `bvh/destroyed`; when reading stored
 * hierarchies: `bvh/not-serialized`, `bvh/version`, `bvh/truncated`, `bvh/checksum`, `bvh/corrupt`, `bvh/other-mesh`;
 * of builds on the GPU: `bvh/limit` (the device binds less than a build needs), `bvh/memory` (the GPU has no memory
 * left), `bvh/pipeline` (the driver does not compile a shader), `bvh/device` (the device was lost).
 */
export class BvhError extends GlanzError {}
