import { GlanzError } from '@glanz/wgsl/error';

/** An error of reading weights: `denoise-weights/unreadable`. */
export class WeightsError extends GlanzError {}
