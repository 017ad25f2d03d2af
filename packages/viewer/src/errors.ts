import { GlanzError } from '@glanz/scene';

export { loadPart } from '@glanz/scene';

/**
 * Thrown by the viewer. Codes:
 *
 * - `viewer/no-canvas`: the canvas gives no WebGPU context. Use a canvas that has no context of another kind.
 * - `viewer/destroyed`: a method was called after `destroy()`. Create another viewer.
 * - `viewer/no-scene`: nothing is loaded yet. Wait for `load()`.
 * - `viewer/no-model`: there is no model in the files, or its address cannot be fetched. Check the address and CORS.
 * - `viewer/environment`: the environment cannot be read. Check the address, the file and CORS.
 * - `viewer/camera`: there is no such camera, or a number of a view is invalid. Pass what the message asks for.
 * - `viewer/option`: a value is out of its range. Pass one in the range of the message.
 * - `viewer/blob`: the browser cannot write the image. Ask for `image/png`.
 * - `viewer/device-lost`: the GPU was lost and did not come back. Show a smaller model, or fewer pixels.
 * - `viewer/gpu`: the GPU reports an error. Report it: it is a fault of Glanz or of the driver.
 * - `viewer/out-of-memory`: the GPU has no memory left. Show a smaller model, or fewer pixels.
 * - `viewer/denoise`: the image is shown with its noise. Remove the `cause` and set `denoise` again.
 * - `viewer/animation`: the model has no such animation. Use one that the message lists.
 * - `viewer/video`: the browser cannot encode the video. Leave out type and codec, or choose a smaller size.
 * - `viewer/missing-package`: an optional package is needed. Install it as the message says.
 */
export class ViewerError extends GlanzError {}

/** The error of a viewer that has been destroyed. */
export const destroyed = (): ViewerError => new ViewerError('viewer/destroyed', 'This viewer has been destroyed.');
