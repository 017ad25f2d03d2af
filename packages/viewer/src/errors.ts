import { GlanzError } from '@glanz/scene';

/**
 * Thrown by the viewer. Codes: `viewer/no-canvas` (not a canvas, or one with a context of another kind),
 * `viewer/destroyed`, `viewer/no-scene` (nothing is loaded yet), `viewer/no-model` (the model cannot be read),
 * `viewer/environment` (the environment cannot be read), `viewer/camera`, `viewer/option` (a value out of its range),
 * `viewer/blob` (the browser cannot write the image), `viewer/device-lost`, `viewer/gpu` (the GPU reports an error),
 * `viewer/out-of-memory`, `viewer/denoise`, `viewer/animation`, `viewer/video` (the browser cannot encode the video),
 * `viewer/missing-package`.
 */
export class ViewerError extends GlanzError {}

/** The error of a viewer that has been destroyed. */
export const destroyed = (): ViewerError => new ViewerError('viewer/destroyed', 'This viewer has been destroyed.');
