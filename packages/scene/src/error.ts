import { GlanzError } from '@glanz/wgsl/error';

/**
 * Thrown for scenes whose parts do not fit together. Codes: `scene/reference` (an index out of range), `scene/length`
 * (an array of a wrong length), `scene/not-finite` (a number is NaN or infinite), `scene/value` (a number out of its
 * range), `scene/empty` (a scene without vertices has no bounds), `scene/texture-budget` (images do not fit into a
 * budget, with all levels dropped that can be).
 */
export class SceneError extends GlanzError {}
