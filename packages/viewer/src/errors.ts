import { GlanzError } from '@glanz/scene';

/**
 * The viewer was asked for something it cannot do. Codes: `viewer/no-canvas`, `viewer/destroyed`, `viewer/no-scene`,
 * `viewer/no-model`, `viewer/environment`, `viewer/camera`, `viewer/option`, `viewer/blob`, `viewer/device-lost`,
 * `viewer/gpu`, `viewer/out-of-memory`, `viewer/denoise`, `viewer/animation`, `viewer/video`, `viewer/missing-package`.
 */
export class ViewerError extends GlanzError {}

/** The error of a viewer that has been destroyed. */
export const destroyed = (): ViewerError => new ViewerError('viewer/destroyed', 'This viewer has been destroyed.');
