import { GlanzError } from '@glanz/wgsl';

/**
 * WebGPU is missing, refused, too small, or gone. Codes: `renderer/no-webgpu`, `renderer/no-adapter`,
 * `renderer/no-device`, `renderer/limit`, `renderer/out-of-memory`, `renderer/device-lost`, `renderer/gpu-error`.
 */
export class DeviceError extends GlanzError {}

/** The error of a device that has gone. */
export const deviceLost = ({ reason, message }: GPUDeviceLostInfo): DeviceError =>
  new DeviceError(
    'renderer/device-lost',
    `The GPU device was lost (${reason}): ${message || 'no details'}. Request a new device and create the tracer again.`,
  );

/**
 * The renderer was asked for something it cannot do. Codes: `renderer/size`, `renderer/samples`, `renderer/camera`,
 * `renderer/filter`, `renderer/light-groups`, `renderer/option`, `renderer/film-state`, `renderer/material`,
 * `renderer/instance`, `renderer/mesh`, `renderer/light`, `renderer/environment`, `renderer/transform`,
 * `renderer/variant`, `renderer/aov`, `renderer/shutter`, `renderer/destroyed`, `renderer/busy`, `renderer/no-triangles`.
 */
export class RenderError extends GlanzError {}
