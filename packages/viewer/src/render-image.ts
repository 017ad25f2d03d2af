import type { PathTracer } from '@glanz/renderer';
import type { Engine } from './engine';
import { ViewerError } from './errors';
import { renderCopy, type RenderImageOptions } from './render-copy';

export { imageProgress, type ImageProgress, type RenderImageOptions } from './render-copy';

/**
 * Renders the scene and the view that an engine shows, at any size, on a path tracer of its own. The screen's image
 * keeps its samples, and the scene may change meanwhile: the image shows it as it was at the call. Kernels and
 * hierarchies are shared; the scene's buffers and textures take GPU memory a second time until the tracer is destroyed.
 *
 * @returns The tracer with the finished film. The caller reads it and destroys it.
 * @throws {ViewerError} `viewer/no-scene` before a scene is shown; `viewer/device-lost` while the GPU is replaced.
 * @throws {DeviceError} `renderer/limit`, `renderer/out-of-memory` for a size that the GPU cannot hold;
 * `renderer/device-lost`.
 * @throws {RenderError} `renderer/size`, `renderer/samples`
 * @throws the signal's reason, when aborted.
 */
export const renderImage = (engine: Engine, options: RenderImageOptions): Promise<PathTracer> =>
  renderCopy(engine, options, ViewerError);
