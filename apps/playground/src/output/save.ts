import { encodeExr } from '@glanz/image/exr';
import { encodePng } from '@glanz/image/png';
import type { PathTracer } from '@glanz/renderer';
import { toneMapPixels, type ToneMapOptions } from '@glanz/tonemap';

/** The picture as PNG, through the tone map. */
export async function pictureAsPng(tracer: PathTracer, view: Required<ToneMapOptions>): Promise<Uint8Array<ArrayBuffer>> {
  const { width, height, samples } = tracer;
  const data = toneMapPixels(await tracer.read('beauty'), width, height, { ...view, output: 'uint8' });
  return encodePng({ width, height, data: new Uint8Array(data.buffer), text: { Software: 'Glanz', Comment: `${samples} samples per pixel` } });
}

const plane = (data: Float32Array, channel: number) => Float32Array.from({ length: data.length / 4 }, (_, i) => data[4 * i + channel] as number);

/** Everything the film knows as OpenEXR: linear radiance and the layers. */
export async function pictureAsExr(tracer: PathTracer): Promise<Uint8Array<ArrayBuffer>> {
  const { width, height, samples } = tracer;
  const beauty = await tracer.read('beauty');
  const albedo = await tracer.read('albedo');
  const normal = await tracer.read('normal');
  return encodeExr({
    width,
    height,
    attributes: { software: 'Glanz', samples: String(samples) },
    layers: [
      { name: '', channels: { R: plane(beauty, 0), G: plane(beauty, 1), B: plane(beauty, 2), A: plane(beauty, 3) } },
      { name: 'albedo', channels: { R: plane(albedo, 0), G: plane(albedo, 1), B: plane(albedo, 2) } },
      { name: 'normal', channels: { X: plane(normal, 0), Y: plane(normal, 1), Z: plane(normal, 2) } },
      { name: 'depth', type: 'float', channels: { Z: await tracer.read('depth') } },
      { name: 'object', channels: { id: await tracer.read('objectId') } },
      { name: 'material', channels: { id: await tracer.read('materialId') } },
    ],
  });
}

/** Hands bytes to the browser's downloads. */
export function download(bytes: Uint8Array<ArrayBuffer>, name: string, type: string): void {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  // The download holds the data by now, or fails by itself.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** A file name out of a title. */
export const fileName = (title: string): string => title.replace(/\.(glb|gltf)$/i, '').replace(/[^\p{L}\p{N}]+/gu, '-').replace(/^-|-$/g, '').toLowerCase() || 'picture';
