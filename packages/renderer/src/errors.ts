import { GlanzError } from '@glanz/wgsl';

/**
 * Thrown where WebGPU or its device cannot be used. Codes:
 *
 * - `renderer/no-webgpu`: WebGPU is not available. Use a current browser and a page from `https:` or `localhost`; in
 *   Node, pass `createGpu()`.
 * - `renderer/no-adapter`: there is no usable GPU. Update its driver, or allow a software adapter.
 * - `renderer/no-device`: the adapter provides no device. Wait and request one again.
 * - `renderer/limit`: the scene or the film exceeds a limit of the device, which the message names. Request higher
 *   limits, or make them smaller.
 * - `renderer/out-of-memory`: the GPU has no memory left. Render fewer pixels or AOVs, or use smaller textures.
 * - `renderer/device-lost`: the device was lost. Request another one and create the tracer again.
 * - `renderer/gpu-error`: the GPU rejected a resource or a kernel. Report it: it is a fault of Glanz or of the
 *   driver.
 */
export class DeviceError extends GlanzError {}

/** The error of a device that has gone. */
export const deviceLost = ({ reason, message }: GPUDeviceLostInfo): DeviceError =>
  new DeviceError(
    'renderer/device-lost',
    `The GPU device was lost (${reason}): ${message || 'no details'}. Request a new device and create the tracer again.`,
  );

/**
 * Thrown for scenes, options and calls that the renderer does not accept. Codes:
 *
 * - `renderer/size`: a width, height or render scale is out of range. Wait until the canvas is laid out, or pass
 *   whole numbers.
 * - `renderer/samples`: `samples`, `noise`, `maxSubmitMs` or `firstSample` is out of range. Pass a number in the
 *   range of the message.
 * - `renderer/camera`: there is no such camera, or it cannot form an image. Pass a camera whose transform has three
 *   axes and whose view has a size.
 * - `renderer/filter`: the pixel filter does not exist, or its radius is out of range. Choose one of the message.
 * - `renderer/light-groups`: there is no such light group, a factor is invalid, or the tracer keeps none. Create it
 *   with light groups.
 * - `renderer/option`: an option is out of its range. Pass a value in the range of the message.
 * - `renderer/film-state`: a saved film is damaged, or of another scene, size or version. Render again from the
 *   start.
 * - `renderer/material`: there is no material of this name or index. Use one that the message lists.
 * - `renderer/instance`: there is no instance of this name or index. Use one that the message lists.
 * - `renderer/mesh`: there is no mesh of this name or index. Use one that the message lists.
 * - `renderer/light`: there is no light of this name or index. Use one that the message lists.
 * - `renderer/environment`: the environment does not have what is to be changed. Set another one by
 *   `setEnvironment()`.
 * - `renderer/transform`: a transform is not 16 finite numbers. Pass a column-major matrix.
 * - `renderer/variant`: there is no material variant of this name or index. Use one that the message lists.
 * - `renderer/aov`: the film does not keep the AOV. Name it in `aovs`, or await `setAovs()`.
 * - `renderer/shutter`: the film restarted during `renderShutter()`. Edit the scene in `pose` only.
 * - `renderer/destroyed`: the tracer was used after `destroy()`. Create another one.
 * - `renderer/busy`: `render()` was called while another one runs. Finish that loop, or abort it.
 * - `renderer/textures-reduced` (a warning, see `PathTracerOptions.onWarning`): textures have lost levels to fit into
 *   memory. Raise `memory.budgetMiB`, or free GPU memory.
 * - `renderer/no-triangles`: nothing in the scene is visible. Show an instance whose transform keeps it an extent.
 */
export class RenderError extends GlanzError {}

/** Names listed in an error message, at most. */
const LISTED_NAMES = 50;

/** The error where the scene has nothing of a kind with this name or index. @param code `renderer/` and the kind. */
export function notFound(code: string, nameOrIndex: unknown, list: readonly { readonly name: string }[]): RenderError {
  const names = list.slice(0, LISTED_NAMES).map(({ name }) => name);
  const more = list.length > LISTED_NAMES ? ` and ${list.length - LISTED_NAMES} more` : '';
  return new RenderError(
    code,
    `The scene has no ${code.slice(9)} ${JSON.stringify(nameOrIndex)}; it has: ${names.join(', ') || 'none'}${more}.`,
  );
}
