import type { PathTracer } from '@glanz/renderer';
import { toneMapPixels, type ToneMapOptions } from '@glanz/tonemap';
import type { Engine } from '@glanz/viewer/engine';

/** What lies behind the model in a saved image: sRGB codes of one colour, or of an image of any size. */
export type SavedBackdrop = { readonly color: readonly [number, number, number] } | { readonly image: ImageData };

/** Puts straight-alpha codes over an opaque background, as the browser's window does. */
export function over(
  codes: Uint8ClampedArray | Uint16Array,
  width: number,
  height: number,
  backdrop: SavedBackdrop,
): void {
  const top = codes instanceof Uint16Array ? 65535 : 255;
  for (let y = 0, i = 0; y < height; y++) {
    for (let x = 0; x < width; x++, i += 4) {
      const alpha = (codes[i + 3] as number) / top;
      if (alpha >= 1) continue;
      for (let k = 0; k < 3; k++) {
        const code =
          'color' in backdrop
            ? (backdrop.color[k] as number)
            : sample(backdrop.image, (x + 0.5) / width, (y + 0.5) / height, k);
        codes[i + k] = Math.round((codes[i + k] as number) * alpha + (code / 255) * top * (1 - alpha));
      }
      codes[i + 3] = top;
    }
  }
}

/** Bilinear. */
function sample({ width, height, data }: ImageData, u: number, v: number, channel: number): number {
  const [x, y] = [
    Math.max(0, Math.min(width - 1.001, u * width - 0.5)),
    Math.max(0, Math.min(height - 1.001, v * height - 0.5)),
  ];
  const [i, j] = [Math.floor(x), Math.floor(y)];
  const at = (dx: number, dy: number) =>
    data[(Math.min(j + dy, height - 1) * width + Math.min(i + dx, width - 1)) * 4 + channel] as number;
  const [fx, fy] = [x - i, y - j];
  return (at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) + (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy;
}

/** The image as PNG with 8 or 16 bits a channel, through the tone map; denoised where the engine's images are. */
export async function imageAsPng(
  { settings: { denoise } }: Engine,
  tracer: PathTracer,
  view: Required<ToneMapOptions>,
  bits: 8 | 16,
  backdrop?: SavedBackdrop,
  signal = new AbortController().signal,
): Promise<Uint8Array<ArrayBuffer>> {
  const { encodePng } = await import('@glanz/image/png');
  const { width, height, samples } = tracer;
  const denoised = await denoise?.still(tracer, signal);
  const beauty = denoised ?? (await tracer.read('beauty'));
  const codes =
    bits === 8
      ? toneMapPixels(beauty, width, height, { ...view, output: 'uint8' })
      : toneMapPixels(beauty, width, height, { ...view, output: 'uint16' });
  if (backdrop) over(codes, width, height, backdrop);
  return encodePng({
    width,
    height,
    data: codes,
    text: {
      Software: 'Glanz',
      Comment: `${samples} samples per pixel`,
      ...(denoised ? { Denoised: 'Open Image Denoise' } : {}),
    },
  });
}

const plane = (data: Float32Array, channel: number) =>
  Float32Array.from({ length: data.length / 4 }, (_, i) => data[4 * i + channel] as number);

/**
 * Everything the film knows as OpenEXR: linear radiance and the layers, and the light of each group where they are kept
 * apart.
 */
export async function imageAsExr(tracer: PathTracer): Promise<Uint8Array<ArrayBuffer>> {
  const { encodeExr } = await import('@glanz/image/exr');
  const { width, height, samples } = tracer;
  const beauty = await tracer.read('beauty');
  const albedo = await tracer.read('albedo');
  const normal = await tracer.read('normal');
  const groups =
    tracer.lightGroups.length > 1 && !tracer.scene.instances.some(({ catcher }) => catcher) ? tracer.lightGroups : [];
  const lights = [];
  for (const { name } of groups) {
    const light = await tracer.readLightGroup(name);
    lights.push({
      name: `light_${name.replaceAll('.', '_')}`,
      channels: { R: plane(light, 0), G: plane(light, 1), B: plane(light, 2) },
    });
  }
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
      ...lights,
    ],
  });
}

/** Saves bytes as a download of the browser. */
export function download(bytes: Uint8Array<ArrayBuffer> | string | Blob, name: string, type: string): void {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  // The download holds the data by now, or fails by itself.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** A file name out of a title. */
export const fileName = (title: string): string =>
  title
    .replace(/\.(glb|gltf|obj|stl|usd[acz]?)$/i, '')
    .replace(/[^\p{L}\p{N}]+/gu, '-')
    .replace(/^-|-$/g, '')
    .toLowerCase() || 'image';
