import { allocateFloats, checkSize, ImageError, type DecodeOptions, type ImageWarning } from './error';
import { unpackB44 } from './exr-b44';
import { unpackDwa } from './exr-dwa';
import { bytesOf, type ExrBlock, type ExrType, rawSize } from './exr-block';
import { readHeader, Reader, readVersion, type ExrCompressionName, type ExrHeader } from './exr-header';
import { unpackPiz } from './exr-piz';
import { unpackPxr24 } from './exr-pxr24';
import { unpackRle } from './exr-rle';
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
  /** x and y of red, green, blue and white, if the file has them; otherwise Rec.709's. */
  readonly chromaticities?: readonly number[];
  /** Faults that were worked around. */
  readonly warnings: readonly ImageWarning[];
}

interface Method {
  readonly lines: number;
  /**
   * Maximum number of bytes that one packed byte can expand to: data that claims more is refused before allocation.
   */
  readonly ratio: number;
  readonly unpack: (packed: Uint8Array, block: ExrBlock, size: number) => Uint8Array | undefined;
}

const zip = (packed: Uint8Array, _: ExrBlock, size: number) => unzipBlock(packed, size);

/** Deflate expands at most about 1032-fold; DWA deflates words of which one can stand for 64 numbers. */
const METHODS: Readonly<Record<ExrCompressionName, Method>> = {
  none: { lines: 1, ratio: 1, unpack: () => undefined },
  RLE: { lines: 1, ratio: 64, unpack: (packed, _, size) => unpackRle(packed, size) },
  ZIPS: { lines: 1, ratio: 1040, unpack: zip },
  ZIP: { lines: 16, ratio: 1040, unpack: zip },
  PIZ: { lines: 32, ratio: 1040, unpack: unpackPiz },
  PXR24: { lines: 16, ratio: 1400, unpack: unpackPxr24 },
  B44: { lines: 32, ratio: 16, unpack: unpackB44 },
  B44A: { lines: 32, ratio: 16, unpack: unpackB44 },
  DWAA: { lines: 32, ratio: 140_000, unpack: unpackDwa },
  DWAB: { lines: 256, ratio: 140_000, unpack: unpackDwa },
};

/**
 * Decodes an OpenEXR file: lines or tiles (of several resolutions the finest), all of the format's own compressions
 * (RLE, ZIP, ZIPS, PIZ, PXR24, B44, B44A, DWAA, DWAB); of several parts in a file, the first. Deep data and
 * subsampled channels are refused with `image/unsupported`.
 *
 * @throws {ImageError} `image/format`, `image/header`, `image/size`, `image/truncated`, `image/corrupt`,
 * `image/unsupported`.
 */
export function decodeExr(bytes: Uint8Array, options: DecodeOptions = {}): ExrImage {
  const reader = new Reader(bytes);
  const { several, tiled } = readVersion(reader);
  const header = readHeader(reader, tiled);
  if (!header) throw new ImageError('image/header', 'EXR: the header is empty.');
  if (several) while (readHeader(reader, false));
  const { channels, width, height, compression, lineBytes } = header;
  // The limit counts numbers of channels: each of them is kept.
  checkSize('EXR', width, height, Math.floor(((options.maxPixels ?? 2 ** 26) * 4) / Math.max(4, channels.length)));
  const { lines, ratio } = METHODS[compression];
  const tile = header.tile ?? { width, height: lines };
  const columns = Math.ceil(width / tile.width),
    blocks = columns * Math.ceil(height / tile.height);
  // Each block is announced in the table of offsets, and has a head of its own.
  reader.need(blocks * 16 + Math.floor((lineBytes * height) / ratio));
  const table = reader.at;
  const target: Target = {
    header,
    several,
    tile,
    columns,
    out: new Map(
      channels.map(({ name, type }) => [
        name,
        {
          type,
          data:
            type === 'uint'
              ? new Uint32Array(allocateFloats('EXR', width, height, 1).buffer)
              : allocateFloats('EXR', width, height, 1),
        },
      ]),
    ),
    seen: new Uint8Array(blocks),
  };
  const misplaced = header.tile || several ? readByTable(reader, table, target) : readInOrder(reader, table, target);
  const warnings: ImageWarning[] =
    misplaced === 0
      ? []
      : [
          {
            code: 'image/offsets',
            message: `EXR: ${misplaced} of ${blocks} line offsets are wrong; the file may be incomplete.`,
          },
        ];
  if (header.cropped)
    warnings.push({
      code: 'image/window',
      message: `EXR: the ${width}×${height} pixels of the data window are read, which are not those of the display window.`,
    });
  return {
    width,
    height,
    channels: target.out,
    attributes: header.attributes,
    ...(header.chromaticities ? { chromaticities: header.chromaticities } : {}),
    warnings,
  };
}

interface Target {
  readonly header: ExrHeader;
  readonly several: boolean;
  readonly tile: { readonly width: number; readonly height: number };
  readonly columns: number;
  readonly out: ReadonlyMap<string, ExrChannel>;
  /** Blocks that have been read. */
  readonly seen: Uint8Array;
}

/** Lines come one block after the other; the table of offsets is only needed for jumping about, and checked here. */
function readInOrder(reader: Reader, table: number, target: Target): number {
  const blocks = target.seen.length;
  reader.take(blocks * 8);
  let misplaced = 0;
  for (let i = 0; i < blocks; i++) {
    const byteOffset = reader.at;
    const index = readBlock(reader, target);
    if (reader.view.getBigUint64(table + index * 8, true) !== BigInt(byteOffset)) misplaced++;
  }
  return misplaced;
}

/** Tiles, and blocks among those of other parts, are found by the table; the finest resolution comes first in it. */
function readByTable(reader: Reader, table: number, target: Target): number {
  const { length } = reader.bytes;
  for (let i = 0; i < target.seen.length; i++) {
    const at = reader.view.getBigUint64(table + i * 8, true);
    if (at < BigInt(table) || at >= BigInt(length))
      throw new ImageError('image/corrupt', `EXR: block ${i} should lie at byte ${at}, which is not in the file.`, {
        location: { byteOffset: table + i * 8 },
      });
    reader.at = Number(at);
    if (target.several && reader.int() !== 0)
      throw new ImageError('image/corrupt', `EXR: the block at byte ${at} belongs to another part.`, {
        location: { byteOffset: Number(at) },
      });
    readBlock(reader, target);
  }
  return 0;
}

/** Reads the block at the reader's place. Returns its number. */
function readBlock(reader: Reader, { header, tile, columns, out, seen }: Target): number {
  const { channels, width, height, y0, compression } = header;
  const byteOffset = reader.at;
  const corrupt = (what: string) =>
    new ImageError('image/corrupt', `EXR: the block at byte ${byteOffset} ${what}.`, { location: { byteOffset } });
  let index: number;
  if (header.tile) {
    const [column, row, levelX, levelY] = [reader.int(), reader.int(), reader.int(), reader.int()] as [
      number,
      number,
      number,
      number,
    ];
    if (levelX !== 0 || levelY !== 0 || column < 0 || column >= columns || row < 0)
      throw corrupt('is for another tile than the table says');
    index = row * columns + column;
  } else index = (reader.int() - y0) / tile.height;
  const packed = reader.take(reader.int());
  if (!Number.isInteger(index) || index < 0 || index >= seen.length || seen[index])
    throw corrupt('is for a line outside the image, or repeats one');
  seen[index] = 1;
  const x = (index % columns) * tile.width,
    y = Math.floor(index / columns) * tile.height;
  const block: ExrBlock = {
    channels,
    width: Math.min(tile.width, width - x),
    lines: Math.min(tile.height, height - y),
  };
  const size = rawSize(block);
  const { ratio, unpack } = METHODS[compression];
  if (packed.length < Math.floor(size / ratio))
    throw corrupt(`has ${packed.length} bytes, which cannot hold the ${size} that its lines have`);
  // What does not get smaller is kept as it is, by all compressions.
  const raw = packed.length === size ? packed : packed.length < size ? unpack(packed, block, size) : undefined;
  if (!raw) throw corrupt(`does not hold ${block.lines} lines of ${size / block.lines} bytes`);
  store(raw, block, out, width, x, y);
  return index;
}

function store(
  raw: Uint8Array,
  block: ExrBlock,
  channels: ReadonlyMap<string, ExrChannel>,
  width: number,
  x: number,
  y: number,
): void {
  const view = new DataView(raw.buffer, raw.byteOffset, raw.byteLength);
  let at = 0;
  for (let line = y; line < y + block.lines; line++) {
    for (const channel of block.channels) {
      const { type, data } = channels.get(channel.name) as ExrChannel;
      const size = bytesOf(channel);
      for (let i = line * width + x; i < line * width + x + block.width; i++) {
        if (type === 'half') data[i] = fromHalf(view.getUint16(at, true));
        else data[i] = type === 'float' ? view.getFloat32(at, true) : view.getUint32(at, true);
        at += size;
      }
    }
  }
}
