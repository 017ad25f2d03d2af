import type { PathTracerOptions, Tracer } from '../backend';
import type { RenderCommandOptions } from '../options';
import type { RenderedImage, ImageLayers } from '../output/image';
import { version } from '../version';

/** The first-hit AOVs that the outputs show or the denoiser is guided by, for the film to record with the image. */
export function imageAovs({
  outputs,
  denoise,
}: Pick<RenderCommandOptions, 'outputs' | 'denoise'>): PathTracerOptions['aovs'] & {} {
  if (outputs.some(({ format }) => format === 'exr'))
    return ['albedo', 'normal', 'position', 'depth', 'objectId', 'materialId'];
  return denoise ? ['albedo', 'normal'] : [];
}

async function lightLayers(tracer: Tracer): Promise<ImageLayers['lights']> {
  const groups = tracer.lightGroups;
  if (groups.length < 2) return [];
  return Promise.all(groups.map(async ({ name }) => ({ name, data: await tracer.readLightGroup(name) })));
}

/** Copies from the GPU what the outputs need. */
export async function readImage(
  tracer: Tracer,
  options: RenderCommandOptions,
  samples: number,
  denoised?: RenderedImage['denoised'],
): Promise<RenderedImage> {
  const { width, height, outputs } = options;
  const beauty = await tracer.read('beauty');
  const base = { width, height, beauty, samples, software: `Glanz ${version()}`, ...(denoised ? { denoised } : {}) };
  if (!outputs.some(({ format }) => format === 'exr')) return base;
  return {
    ...base,
    layers: {
      albedo: await tracer.read('albedo'),
      normal: await tracer.read('normal'),
      position: await tracer.read('position'),
      variance: await tracer.read('variance'),
      lights: await lightLayers(tracer),
      depth: await tracer.read('depth'),
      objectId: await tracer.read('objectId'),
      materialId: await tracer.read('materialId'),
    },
  };
}
