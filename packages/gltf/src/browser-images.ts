// A 2D canvas stores premultiplied colours: reading them back loses precision where alpha is low, and the colour where
// alpha is 0. glTF needs the colours: an OPAQUE material ignores alpha, and a roughness texture may have an unused
// alpha channel. WebGL uploads a bitmap unchanged, but needs a context: only images with transparency are read through
// WebGL.
import type { Image } from '@glanz/scene';
import { GltfError } from './error';
import type { DecodedImage, ImageDecoder } from './decoded-image';
import { imageOfPixels } from './lazy-pixels';
import { opaqueImageParts } from './image-header';

/** Files of fewer bytes are read so quickly that {@link browserReads} does not wait for them. */
const MIN_AWAITED_BYTES = 100_000;

let reads: Promise<unknown> | undefined;

/**
 * Resolves when the browser has read the bytes of all images passed to it so far. It decodes on other threads, but
 * reads the bytes on the calling thread: if this one is busy, a load of large images takes a quarter longer.
 */
export async function browserReads(): Promise<void> {
  const last = reads;
  await last;
  // Release the promise when no newer read has been added.
  if (reads === last) reads = undefined;
}

/**
 * Decodes an image with the browser. The values are exactly those of the file, whatever their alpha. The image stays a
 * bitmap until its `data` are read.
 */
export const decodeImageInBrowser: ImageDecoder = async (bytes, mimeType) => {
  if (typeof createImageBitmap === 'undefined' || typeof OffscreenCanvas === 'undefined') {
    throw new GltfError(
      'gltf/missing-decoder',
      'Images cannot be decoded without a browser: use loadGltfFile() of @glanz/gltf/node, or pass decodeImage.',
    );
  }
  // glTF ignores colour profiles (3.8.1), and colours are not premultiplied. Requesting this costs the browser another
  // pass over the pixels (half the time of decoding), even for images that have neither a profile nor alpha.
  const plain = opaqueImageParts(bytes);
  const blob = new Blob(plain ?? [bytes], { type: mimeType });
  if (bytes.length > MIN_AWAITED_BYTES) reads = Promise.all([reads, blob.arrayBuffer()]).catch(() => undefined);
  return imageOfBitmap(
    await (plain
      ? createImageBitmap(blob)
      : createImageBitmap(blob, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' })),
  );
};

/**
 * An image whose `data` are read from a bitmap (straight alpha, no colour conversion) on first access.
 */
export function imageOfBitmap(bitmap: ImageBitmap): DecodedImage & { readonly bitmap: ImageBitmap } {
  return imageOfPixels({ width: bitmap.width, height: bitmap.height, bitmap }, () => {
    const drawn = readByCanvas(bitmap);
    return hasTransparency(drawn) ? (readByWebGl(bitmap) ?? drawn) : drawn;
  });
}

/** An image with a name. Copies the accessor of `data`, so that a bitmap is not read. */
export const namedImage = (name: string, image: Omit<DecodedImage, 'data'>): Image =>
  Object.defineProperties({ name }, Object.getOwnPropertyDescriptors(image)) as Image;

function hasTransparency(data: ArrayLike<number>): boolean {
  for (let i = 3; i < data.length; i += 4) if (data[i] !== 255) return true;
  return false;
}

function readByCanvas(bitmap: ImageBitmap): DecodedImage['data'] {
  const { width, height } = bitmap;
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true, colorSpace: 'srgb' });
  if (!context)
    throw new GltfError('gltf/missing-decoder', 'The browser provides no 2D canvas, which is needed to read images.');
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, width, height).data as Uint8ClampedArray<ArrayBuffer>;
}

/** Undefined if WebGL 2 is not available or the image exceeds its texture size. */
function readByWebGl(bitmap: ImageBitmap): DecodedImage['data'] | undefined {
  const { width, height } = bitmap;
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2');
  if (!gl) return undefined;
  try {
    if (Math.max(width, height) > (gl.getParameter(gl.MAX_TEXTURE_SIZE) as number)) return undefined;
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
    gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
    gl.framebufferTexture2D(
      gl.FRAMEBUFFER,
      gl.COLOR_ATTACHMENT0,
      gl.TEXTURE_2D,
      gl.getParameter(gl.TEXTURE_BINDING_2D) as WebGLTexture,
      0,
    );
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) return undefined;
    const data = new Uint8Array(width * height * 4);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
    return gl.getError() === gl.NO_ERROR ? data : undefined;
  } finally {
    // Browsers limit the number of live contexts: release this one now.
    gl.getExtension('WEBGL_lose_context')?.loseContext();
  }
}
