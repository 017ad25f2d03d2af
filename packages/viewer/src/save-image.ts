import type { PathTracer } from '@glanz/renderer';
import { toneMapPixels, type ToneMapOptions } from '@glanz/tonemap/tone-map';
import { ViewerError } from './errors';

/** What `Viewer.toBlob` may be told. */
export interface BlobOptions {
  /** A type that the browser can write: `image/png` (default), `image/jpeg`, `image/webp`. */
  readonly type?: string;
  /** 0..1 for types that lose something. */
  readonly quality?: number;
  /** Samples per pixel to wait for. Default 1: the picture as it is. */
  readonly samples?: number;
  readonly signal?: AbortSignal;
}

/** Reads the film, through the tone map, into a file of the browser's making. */
export async function pictureBlob(tracer: PathTracer, view: ToneMapOptions, { type = 'image/png', quality, signal }: BlobOptions): Promise<Blob> {
  const { width, height } = tracer;
  const film = await tracer.read('beauty');
  signal?.throwIfAborted();
  const opaque = type === 'image/jpeg';
  const pixels = toneMapPixels(film, width, height, { ...view, alpha: opaque ? 'opaque' : 'straight' });
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext('2d');
  if (!context) throw new ViewerError('viewer/blob', 'The browser gives no canvas to write the picture with.');
  context.putImageData(new ImageData(pixels, width, height), 0, 0);
  const blob = await canvas.convertToBlob({ type, ...(quality === undefined ? {} : { quality }) });
  if (blob.type !== type) throw new ViewerError('viewer/blob', `This browser cannot write "${type}": choose image/png.`);
  return blob;
}
