import { checkSize, ImageError, type DecodeOptions, type ImageWarning } from './error';
import { EXR_COMPRESSION, EXR_MAGIC, EXR_TYPES, type ExrType } from './exr-encode';
import { unzipBlock } from './exr-zip';
import { fromHalf } from './half';

/** One channel of a decoded file. */
export interface ExrChannel {
  readonly type: ExrType;
  /** One number per pixel, row-major, top row first. May hold NaN and infinities if the file does. */
  readonly data: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>;
}

/** A decoded OpenEXR file. */
export interface ExrImage {
  readonly width: number;
  readonly height: number;
  /** By full name, e.g. `R`, `albedo.R`. */
  readonly channels: ReadonlyMap<string, ExrChannel>;
  /** The header's attributes of type `string`. */
  readonly attributes: ReadonlyMap<string, string>;
  /** What was worked around. */
  readonly warnings: readonly ImageWarning[];
}

interface ChannelInfo {
  readonly name: string;
  readonly type: ExrType;
}

const COMPRESSION_NAMES = ['none', 'RLE', 'ZIPS', 'ZIP', 'PIZ', 'PXR24', 'B44', 'B44A', 'DWAA', 'DWAB'];
const NAME_LIMIT = 255;

class Reader {
  readonly view: DataView;
  at = 0;
  constructor(readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }
  need(count: number): void {
    if (count < 0 || this.at + count > this.bytes.length) {
      throw new ImageError('image/truncated', `EXR: the file ends at byte ${this.bytes.length}, but ${count} more bytes are needed at ${this.at}.`, { location: { byteOffset: this.at } });
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
      if (end - this.at >= NAME_LIMIT) throw new ImageError('image/header', `EXR: a name of more than ${NAME_LIMIT} bytes at ${this.at}.`, { location: { byteOffset: this.at } });
      end++;
    }
    const text = String.fromCharCode(...this.take(end - this.at));
    this.take(1);
    return text;
  }
}

function readChannels(value: Uint8Array): ChannelInfo[] {
  const reader = new Reader(value);
  const channels: ChannelInfo[] = [];
  for (let name = reader.name(); name !== ''; name = reader.name()) {
    const type = EXR_TYPES[reader.int()];
    reader.int();
    const [sx, sy] = [reader.int(), reader.int()];
    if (!type) throw new ImageError('image/header', `EXR: channel "${name}" has an unknown pixel type.`);
    if (sx !== 1 || sy !== 1) throw new ImageError(sx > 0 && sy > 0 ? 'image/unsupported' : 'image/header', `EXR: channel "${name}" is subsampled ${sx}×${sy}; only 1×1 is read.`);
    if (channels.some((c) => c.name === name)) throw new ImageError('image/header', `EXR: two channels are called "${name}".`);
    channels.push({ name, type });
  }
  if (channels.length === 0) throw new ImageError('image/header', 'EXR: the file has no channels.');
  return channels;
}

/**
 * Decodes an OpenEXR file: single part, scanlines, uncompressed or ZIP/ZIPS. That is all {@link encodeExr} writes and
 * part of what others write; tiles, several parts, deep data, subsampling and other compressions are refused with
 * `image/unsupported`.
 *
 * @throws {ImageError} `image/format`, `image/header`, `image/size`, `image/truncated`, `image/corrupt`, `image/unsupported`.
 */
export function decodeExr(bytes: Uint8Array, options: DecodeOptions = {}): ExrImage {
  const reader = new Reader(bytes);
  if (bytes.length < 8 || reader.int() !== EXR_MAGIC) throw new ImageError('image/format', 'EXR: the file does not start with the OpenEXR magic number.', { location: { byteOffset: 0 } });
  const version = reader.int();
  if ((version & 0xff) !== 2) throw new ImageError('image/unsupported', `EXR: version ${version & 0xff} of the format is not supported.`);
  if (version & 0x1a00) throw new ImageError('image/unsupported', 'EXR: tiled, deep and multi-part files are not supported; save as a flat scanline image.');

  const header = new Map<string, Uint8Array>();
  const attributes = new Map<string, string>();
  for (let name = reader.name(); name !== ''; name = reader.name()) {
    const type = reader.name();
    const value = reader.take(reader.int());
    header.set(name, value);
    if (type === 'string') attributes.set(name, new TextDecoder().decode(value));
  }
  const attribute = (name: string, length: number): DataView => {
    const value = header.get(name);
    if (!value || value.length < length) throw new ImageError('image/header', `EXR: the attribute "${name}" is missing or too short.`);
    return new DataView(value.buffer, value.byteOffset, value.byteLength);
  };
  attribute('channels', 1);
  const channels = readChannels(header.get('channels') as Uint8Array);
  const compression = attribute('compression', 1).getUint8(0);
  const window = attribute('dataWindow', 16);
  const [x0, y0, x1, y1] = [0, 4, 8, 12].map((at) => window.getInt32(at, true)) as [number, number, number, number];
  const [width, height] = [x1 - x0 + 1, y1 - y0 + 1];
  // The limit counts numbers of channels: each of them is kept.
  checkSize('EXR', width, height, Math.floor(((options.maxPixels ?? 2 ** 26) * 4) / Math.max(4, channels.length)));
  const { none, zip, zips } = EXR_COMPRESSION;
  if (compression !== none && compression !== zip && compression !== zips) {
    throw new ImageError(compression < COMPRESSION_NAMES.length ? 'image/unsupported' : 'image/header', `EXR: compression ${COMPRESSION_NAMES[compression] ?? compression} is not supported; save with ZIP.`);
  }
  const linesPerBlock = compression === zip ? 16 : 1;
  const blocks = Math.ceil(height / linesPerBlock);
  const lineBytes = width * channels.reduce((sum, channel) => sum + (channel.type === 'half' ? 2 : 4), 0);
  // Each block is announced by 8 bytes and deflate cannot expand more than about 1032-fold.
  const least = blocks * 16 + (compression === none ? lineBytes * height : Math.floor((lineBytes * height) / 1040));
  reader.need(least);
  const table = reader.at;
  reader.take(blocks * 8);

  const out = new Map<string, ExrChannel>(
    channels.map(({ name, type }) => [name, { type, data: type === 'uint' ? new Uint32Array(width * height) : new Float32Array(width * height) }]),
  );
  const seen = new Uint8Array(blocks);
  // Blocks come one after the other; the table of offsets is only needed for jumping about, and checked here.
  let misplaced = 0;
  for (let i = 0; i < blocks; i++) {
    const byteOffset = reader.at;
    const corrupt = (what: string) => new ImageError('image/corrupt', `EXR: the block at byte ${byteOffset} ${what}.`, { location: { byteOffset } });
    const index = (reader.int() - y0) / linesPerBlock;
    const packed = reader.take(reader.int());
    if (!Number.isInteger(index) || index < 0 || index >= blocks || seen[index]) throw corrupt('is for a line outside the picture, or repeats one');
    seen[index] = 1;
    if (reader.view.getBigUint64(table + index * 8, true) !== BigInt(byteOffset)) misplaced++;
    const first = index * linesPerBlock;
    const lines = Math.min(linesPerBlock, height - first);
    const raw = compression === none ? (packed.length === lineBytes * lines ? packed : undefined) : unzipBlock(packed, lineBytes * lines);
    if (!raw) throw corrupt(`does not hold ${lines} lines of ${lineBytes} bytes`);
    unpack(raw, out, width, first, lines);
  }
  const warnings: ImageWarning[] = misplaced === 0 ? [] : [{ code: 'image/offsets', message: `EXR: ${misplaced} of ${blocks} line offsets are wrong; the file may be incomplete.` }];
  return { width, height, channels: out, attributes, warnings };
}

function unpack(raw: Uint8Array, channels: ReadonlyMap<string, ExrChannel>, width: number, first: number, lines: number): void {
  const view = new DataView(raw.buffer, raw.byteOffset, raw.byteLength);
  let at = 0;
  for (let y = first; y < first + lines; y++) {
    for (const { type, data } of channels.values()) {
      for (let i = y * width; i < (y + 1) * width; i++) {
        if (type === 'half') data[i] = fromHalf(view.getUint16(at, true));
        else data[i] = type === 'float' ? view.getFloat32(at, true) : view.getUint32(at, true);
        at += type === 'half' ? 2 : 4;
      }
    }
  }
}
