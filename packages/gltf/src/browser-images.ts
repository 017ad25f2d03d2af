// A 2D canvas stores colours multiplied by alpha: reading them back loses bits where alpha is low and everything where
// it is 0. glTF needs them: an OPAQUE material ignores the alpha, and roughness may lie beside an alpha that means
// nothing. WebGL uploads a bitmap as it is. It costs a context, so only pictures that have transparency go that way.
import type { Image } from '@glanz/scene';
import { GltfError } from './error';
import type { DecodedImage, ImageDecoder } from './decoded-image';
import { imageOfPixels } from './lazy-pixels';
import { plainPicture } from './picture-header';

/** Smaller pictures than this are read and decoded in no time. */
const WORTH_WAITING = 100_000;

let taken: Promise<unknown> | undefined;

/**
 * Resolves when the browser has read the pictures that it was given to decode so far. It decodes on threads of its own,
 * but reads on the one that gave them, which must not be busy until then: a load of large pictures would take a quarter
 * longer.
 */
export async function picturesTaken(): Promise<void> {
  const last = taken;
  await last;
  // Nothing is held on to for the sake of the next load.
  if (taken === last) taken = undefined;
}

/**
 * Decodes by the browser; exact to the codes in the file, whatever their alpha. The picture stays the browser's bitmap
 * until somebody asks for its `data`.
 */
export const decodeImageInBrowser: ImageDecoder = async (bytes, mimeType) => {
  if (typeof createImageBitmap === 'undefined' || typeof OffscreenCanvas === 'undefined') {
    throw new GltfError(
      'gltf/missing-decoder',
      'There is no browser to decode pictures: use loadGltfFile() of @glanz/gltf/node, or pass decodeImage.',
    );
  }
  // Colour profiles do not count in glTF (3.8.1), nor does alpha for colours. Saying so costs the browser another pass
  // over the pixels, half as long again as decoding, even where there is nothing of the kind.
  const plain = plainPicture(bytes);
  const blob = new Blob(plain ?? [bytes], { type: mimeType });
  if (bytes.length > WORTH_WAITING) taken = Promise.all([taken, blob.arrayBuffer()]).catch(() => undefined);
  return imageOfBitmap(
    await (plain
      ? createImageBitmap(blob)
      : createImageBitmap(blob, { colorSpaceConversion: 'none', premultiplyAlpha: 'none' })),
  );
};

/**
 * A picture whose `data` are read from a bitmap (straight alpha, no colour conversion) when they are first asked for.
 */
export function imageOfBitmap(bitmap: ImageBitmap): DecodedImage & { readonly bitmap: ImageBitmap } {
  return imageOfPixels({ width: bitmap.width, height: bitmap.height, bitmap }, () => {
    const drawn = readByCanvas(bitmap);
    return hasTransparency(drawn) ? (readByWebGl(bitmap) ?? drawn) : drawn;
  });
}

/** A picture with a name; one that is still a bitmap stays one. */
export const namedImage = (name: string, image: Omit<DecodedImage, 'data'>): Image =>
  Object.defineProperties({ name }, Object.getOwnPropertyDescriptors(image)) as Image;

function hasTransparency(data: ArrayLike<number>): boolean {
  for (let i = 3; i < data.length; i += 4) if (data[i] !== 255) return true;
  return false;
}

function readByCanvas(bitmap: ImageBitmap): DecodedImage['data'] {
  const { width, height } = bitmap;
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true, colorSpace: 'srgb' });
  if (!context) throw new GltfError('gltf/missing-decoder', 'The browser gives no 2D canvas to read pictures with.');
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, width, height).data as Uint8ClampedArray<ArrayBuffer>;
}

/** Undefined where there is no WebGL 2, or the picture is too large for it. */
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
    // Browsers keep few contexts alive; this one is not left to the garbage collector.
    gl.getExtension('WEBGL_lose_context')?.loseContext();
  }
}
