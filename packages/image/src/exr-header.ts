import { ImageError } from './error';
import { bytesOf, type ExrChannelInfo } from './exr-block';
import { EXR_MAGIC, EXR_TYPES } from './exr-encode';

const NAME_LIMIT = 255;
export const COMPRESSION_NAMES = ['none', 'RLE', 'ZIPS', 'ZIP', 'PIZ', 'PXR24', 'B44', 'B44A', 'DWAA', 'DWAB'] as const;
export type ExrCompressionName = (typeof COMPRESSION_NAMES)[number];

/** Reads little-endian numbers and names from a file, and says where it ends. */
export class Reader {
  readonly view: DataView;
  at = 0;
  constructor(readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }
  need(count: number): void {
    if (count < 0 || this.at + count > this.bytes.length) {
      throw new ImageError(
        'image/truncated',
        `EXR: the file ends at byte ${this.bytes.length}, but ${count} more bytes are needed at ${this.at}.`,
        { location: { byteOffset: this.at } },
      );
    }
  }
  int(): number {
    this.need(4);
    this.at += 4;
    return this.view.getInt32(this.at - 4, true);
  }
  take(count: number): Uint8Array {
    this.need(count);
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }
  name(): string {
    let end = this.at;
    while (end < this.bytes.length && this.bytes[end] !== 0) {
      if (end - this.at >= NAME_LIMIT)
        throw new ImageError('image/header', `EXR: a name of more than ${NAME_LIMIT} bytes at ${this.at}.`, {
          location: { byteOffset: this.at },
        });
      end++;
    }
    const text = String.fromCharCode(...this.take(end - this.at));
    this.take(1);
    return text;
  }
}

/** The header of an image. */
export interface ExrHeader {
  readonly channels: readonly ExrChannelInfo[];
  readonly compression: ExrCompressionName;
  readonly x0: number;
  readonly y0: number;
  readonly width: number;
  readonly height: number;
  /** Absent: lines. */
  readonly tile?: { readonly width: number; readonly height: number };
  readonly attributes: ReadonlyMap<string, string>;
  /**
   * Whether the stored pixels differ from those of the whole image (data window and display window).
   */
  readonly cropped: boolean;
  /** x and y of red, green, blue and white. */
  readonly chromaticities?: readonly number[];
  /** Bytes of an uncompressed line. */
  readonly lineBytes: number;
}

function readChannels(value: Uint8Array): ExrChannelInfo[] {
  const reader = new Reader(value);
  const channels: ExrChannelInfo[] = [];
  for (let name = reader.name(); name !== ''; name = reader.name()) {
    const type = EXR_TYPES[reader.int()];
    const linear = (reader.take(4)[0] as number) !== 0;
    const [sx, sy] = [reader.int(), reader.int()];
    if (!type) throw new ImageError('image/header', `EXR: channel "${name}" has an unknown pixel type.`);
    if (sx !== 1 || sy !== 1)
      throw new ImageError(
        sx > 0 && sy > 0 ? 'image/unsupported' : 'image/header',
        `EXR: channel "${name}" is subsampled ${sx}×${sy}; only 1×1 is read.`,
      );
    if (channels.some((c) => c.name === name))
      throw new ImageError('image/header', `EXR: two channels are called "${name}".`);
    channels.push({ name, type, linear });
  }
  if (channels.length === 0) throw new ImageError('image/header', 'EXR: the file has no channels.');
  return channels;
}

/** Checks the beginning of a file. Returns whether it holds several parts, or one in tiles. */
export function readVersion(reader: Reader): { readonly several: boolean; readonly tiled: boolean } {
  if (reader.bytes.length < 8 || reader.int() !== EXR_MAGIC)
    throw new ImageError('image/format', 'EXR: the file does not start with the OpenEXR magic number.', {
      location: { byteOffset: 0 },
    });
  const version = reader.int();
  if ((version & 0xff) !== 2)
    throw new ImageError('image/unsupported', `EXR: version ${version & 0xff} of the format is not supported.`);
  if (version & 0x800)
    throw new ImageError('image/unsupported', 'EXR: deep images are not supported; save as a flat image.');
  return { several: (version & 0x1000) !== 0, tiled: (version & 0x200) !== 0 };
}

/** Reads one header; undefined for the empty one that ends those of several parts. */
export function readHeader(reader: Reader, tiled: boolean): ExrHeader | undefined {
  const header = new Map<string, Uint8Array>();
  const attributes = new Map<string, string>();
  for (let name = reader.name(); name !== ''; name = reader.name()) {
    const type = reader.name();
    const value = reader.take(reader.int());
    header.set(name, value);
    if (type === 'string') attributes.set(name, new TextDecoder().decode(value));
  }
  if (header.size === 0) return undefined;
  const attribute = (name: string, length: number): DataView => {
    const value = header.get(name);
    if (!value || value.length < length)
      throw new ImageError('image/header', `EXR: the attribute "${name}" is missing or too short.`);
    return new DataView(value.buffer, value.byteOffset, value.byteLength);
  };
  attribute('channels', 1);
  const channels = readChannels(header.get('channels') as Uint8Array);
  const code = attribute('compression', 1).getUint8(0);
  const compression = COMPRESSION_NAMES[code];
  if (!compression) throw new ImageError('image/header', `EXR: compression ${code} is unknown.`);
  const window = attribute('dataWindow', 16);
  const [x0, y0, x1, y1] = [0, 4, 8, 12].map((at) => window.getInt32(at, true)) as [number, number, number, number];
  const width = x1 - x0 + 1;
  const display = header.get('displayWindow');
  const cropped = display?.length === 16 && display.some((byte, i) => byte !== window.getUint8(i));
  const colours = header.get('chromaticities');
  const chromaticities =
    colours?.length === 32
      ? Array.from({ length: 8 }, (_, i) => new DataView(colours.buffer, colours.byteOffset).getFloat32(4 * i, true))
      : undefined;
  const common = {
    channels,
    compression,
    x0,
    y0,
    width,
    height: y1 - y0 + 1,
    attributes,
    cropped,
    ...(chromaticities ? { chromaticities } : {}),
    lineBytes: width * channels.reduce((sum, channel) => sum + bytesOf(channel), 0),
  };
  const type = attributes.get('type');
  if (type?.startsWith('deep'))
    throw new ImageError('image/unsupported', 'EXR: deep images are not supported; save as a flat image.');
  if (!tiled && type !== 'tiledimage') return common;
  const tiles = attribute('tiles', 9);
  const tile = { width: tiles.getUint32(0, true), height: tiles.getUint32(4, true) };
  if (tile.width < 1 || tile.height < 1 || (tiles.getUint8(8) & 15) > 2)
    throw new ImageError('image/header', `EXR: tiles of ${tile.width}×${tile.height} are not possible.`);
  return { ...common, tile };
}
