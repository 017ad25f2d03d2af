import { GlanzError } from '@glanz/wgsl';

/**
 * Thrown where WebGPU or its device cannot be used. Codes: `renderer/no-webgpu` (WebGPU is not available),
 * `renderer/no-adapter` (there is no usable GPU), `renderer/no-device` (the adapter provides no device),
 * `renderer/limit` (a limit of the device is too low), `renderer/out-of-memory`, `renderer/device-lost`,
 * `renderer/gpu-error` (the GPU reports an error).
 */
export class DeviceError extends GlanzError {}

/** The error of a device that has gone. */
export const deviceLost = ({ reason, message }: GPUDeviceLostInfo): DeviceError =>
  new DeviceError(
    'renderer/device-lost',
    `The GPU device was lost (${reason}): ${message || 'no details'}. Request a new device and create the tracer again.`,
  );

/**
 * Thrown for scenes, options and calls that the renderer does not accept. Codes: `renderer/size`, `renderer/samples`,
 * `renderer/camera`, `renderer/filter`, `renderer/light-groups`, `renderer/option`, `renderer/film-state`,
 * `renderer/material`, `renderer/instance`, `renderer/mesh`, `renderer/light`, `renderer/environment`,
 * `renderer/transform`, `renderer/variant`, `renderer/aov`, `renderer/shutter`, `renderer/destroyed`, `renderer/busy`,
 * `renderer/no-triangles`.
 */
export class RenderError extends GlanzError {}
