import { bindGroup, type Window } from './gpu';
import type { BoundImages } from './images';
import type { Job } from './jobs';
import { tileStruct } from './kernels/layouts';
import type { Prelude } from './prelude-kernels';
import type { Tile } from './tiles';

/** Multiply-adds that take as long as encoding a pixel, roughly. */
export const ENCODE_COST = 200;

/** Bytes for the means of an image's blocks. */
export const blockBytes = (width: number, height: number): number => Math.ceil(width / 16) * Math.ceil(height / 16) * 8;

/** The uniform of a tile of images: where it is, and how pixels are found. */
export function tileUniform(
  images: BoundImages,
  tile: Tile,
  size: readonly [width: number, height: number],
  quads: number,
): ArrayBuffer {
  const bytes = tileStruct.allocate();
  tileStruct.write(bytes, 0, {
    image_size: [images.width, images.height],
    origin: [tile.x, tile.y],
    size: [...size],
    inner_from: [tile.innerX[0], tile.innerY[0]],
    inner_to: [tile.innerX[1], tile.innerY[1]],
    quads,
    main_image: images.main.layout,
    albedo_image: images.albedo?.layout ?? [0, 0, 0, 0],
    normal_image: images.normal?.layout ?? [0, 0, 0, 0],
    output_image: images.output.layout,
  });
  return bytes;
}

/** The dispatches that find the scale of images that come without one. */
export function exposureJobs(
  device: GPUDevice,
  { exposure, scale }: Prelude,
  images: BoundImages,
  windows: { readonly blocks: Window; readonly tile: Window; readonly scale: Window },
): Job[] {
  if (images.scale !== undefined) return [];
  const { blocks, tile } = windows;
  const once = { fromRow: 0, toRow: 1, z: 1, offsets: () => [0] };
  return [
    {
      ...once,
      name: 'exposure',
      pipeline: exposure.pipeline,
      group: bindGroup(device, exposure, { 2: blocks, 6: tile, 7: images.main.window }),
      x: Math.ceil(images.width / 16),
      yOfRow: Math.ceil(images.height / 16),
      costOfRow: images.width * images.height * ENCODE_COST,
    },
    {
      ...once,
      name: 'scale',
      pipeline: scale.pipeline,
      group: bindGroup(device, scale, { 2: blocks, 5: windows.scale, 6: tile }),
      x: 1,
      yOfRow: 1,
      costOfRow: images.width * images.height,
    },
  ];
}
