import { GlanzError } from '@glanz/wgsl/error';

/** Thrown by reading weights. Code: `denoise-weights/unreadable` (no such weights, or a file that is missing or damaged). */
export class WeightsError extends GlanzError {}
