import { allocateFloats, ImageError, type DecodeOptions, type ImageWarning } from './error';
import { EXR_MAGIC } from './exr-encode';
import { decodeExr, type ExrChannel } from './exr-decode';
import { decodeHdr, type HdrImage } from './hdr-decode';
import { primariesWarning } from './primaries';

const MAX_FLOAT = 3.4028234663852886e38;

/**
 * Decodes an environment image, Radiance HDR or OpenEXR by its first bytes, into radiance that is safe to light a
 * scene with: NaN and negative values become 0 and infinities the largest float, with a warning. Colours are
 * taken as those of Rec.709; a file with other primaries, or with a part of its colours in channels that are not read,
 * gives a warning.
 *
 * @returns RGB, stride 3, linear, top row first: as in a `LatLongEnvironment` of `@glanz/scene`.
 * @throws {ImageError} `image/format` if it is neither, `image/channels` if an EXR has no R, G and B (or Y), and what
 * the decoders throw.
 */
export function decodeEnvironment(bytes: Uint8Array, options: DecodeOptions = {}): HdrImage {
  const magic = bytes.length >= 4 ? new DataView(bytes.buffer, bytes.byteOffset).getInt32(0, true) : 0;
  if (magic !== EXR_MAGIC) {
    if (bytes[0] === 0x23 && bytes[1] === 0x3f) return decodeHdr(bytes, options);
    throw new ImageError('image/format', 'The environment is neither a Radiance HDR nor an OpenEXR image.', {
      location: { byteOffset: 0 },
    });
  }
  const { width, height, channels, chromaticities, warnings } = decodeExr(bytes, options);
  const { planes, unread } = colourPlanes(channels);
  const meaning: ImageWarning[] = primariesWarning('EXR', chromaticities);
  if (unread.length > 0)
    meaning.push({
      code: 'image/grey',
      message: `EXR: there are no channels R, G and B together; Y is taken as grey and ${unread.join(', ')} not read. Convert the image to R, G and B if it has colours.`,
    });
  const data = allocateFloats('EXR', width, height, 3);
  let replaced = 0;
  for (let k = 0; k < 3; k++) {
    const plane = planes[k]?.data as Float32Array | Uint32Array;
    for (let i = 0; i < plane.length; i++) {
      const value = plane[i] as number;
      const good = value > 0 ? Math.min(value, MAX_FLOAT) : 0;
      if (good !== value) replaced++;
      data[i * 3 + k] = good;
    }
  }
  const replacement: ImageWarning[] =
    replaced === 0
      ? []
      : [{ code: 'image/not-radiance', message: `EXR: ${replaced} negative or non-finite numbers were replaced.` }];
  return { width, height, data, warnings: [...warnings, ...meaning, ...replacement] };
}

/** Channels that hold a part of the colour: of RGB, of XYZ, and chroma beside a luminance. Z by itself is a depth. */
const COLOURS = ['R', 'G', 'B', 'X', 'RY', 'BY'];

/** The channels to take red, green and blue from, and those that hold colours and are not read. */
function colourPlanes(channels: ReadonlyMap<string, ExrChannel>): {
  planes: readonly ExrChannel[];
  unread: readonly string[];
} {
  const planes = ['R', 'G', 'B'].flatMap((name) => channels.get(name) ?? []);
  if (planes.length === 3) return { planes, unread: [] };
  const grey = channels.get('Y');
  if (!grey)
    throw new ImageError(
      'image/channels',
      `EXR: there are no channels R, G and B, only ${[...channels.keys()].slice(0, 8).join(', ')}.`,
    );
  const colours = COLOURS.filter((name) => channels.has(name));
  return {
    planes: [grey, grey, grey],
    unread: colours.includes('X') && channels.has('Z') ? [...colours, 'Z'] : colours,
  };
}
