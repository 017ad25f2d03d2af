import { ImageError, type DecodeOptions, type ImageWarning } from './error';
import { EXR_MAGIC } from './exr-encode';
import { decodeExr } from './exr-decode';
import { decodeHdr, type HdrImage } from './hdr-decode';

const MAX_FLOAT = 3.4028234663852886e38;

/**
 * Decodes a picture of the surroundings, Radiance HDR or OpenEXR by its first bytes, into radiance that is safe to
 * light a scene with: NaN and negative values become 0 and infinities the largest float, with a warning.
 *
 * @returns RGB, stride 3, linear, top row first: what a `LatLongEnvironment` of `@glanz/scene` wants.
 * @throws {ImageError} `image/format` if it is neither, `image/channels` if an EXR has no R, G and B (or Y), and what
 * the decoders throw.
 */
export function decodeEnvironment(bytes: Uint8Array, options: DecodeOptions = {}): HdrImage {
  const magic = bytes.length >= 4 ? new DataView(bytes.buffer, bytes.byteOffset).getInt32(0, true) : 0;
  if (magic !== EXR_MAGIC) {
    if (bytes[0] === 0x23 && bytes[1] === 0x3f) return decodeHdr(bytes, options);
    throw new ImageError('image/format', 'The environment is neither a Radiance HDR nor an OpenEXR picture.', { location: { byteOffset: 0 } });
  }
  const { width, height, channels, warnings } = decodeExr(bytes, options);
  const grey = channels.get('Y');
  const planes = ['R', 'G', 'B'].map((name) => channels.get(name) ?? grey);
  if (planes.some((plane) => !plane)) throw new ImageError('image/channels', `EXR: there are no channels R, G and B, only ${[...channels.keys()].slice(0, 8).join(', ')}.`);
  const data = new Float32Array(width * height * 3);
  let mended = 0;
  for (let k = 0; k < 3; k++) {
    const plane = planes[k]?.data as Float32Array | Uint32Array;
    for (let i = 0; i < plane.length; i++) {
      const value = plane[i] as number;
      const good = value > 0 ? Math.min(value, MAX_FLOAT) : 0;
      if (good !== value) mended++;
      data[i * 3 + k] = good;
    }
  }
  const mending: ImageWarning[] = mended === 0 ? [] : [{ code: 'image/not-radiance', message: `EXR: ${mended} negative or non-finite numbers were replaced.` }];
  return { width, height, data, warnings: [...warnings, ...mending] };
}
