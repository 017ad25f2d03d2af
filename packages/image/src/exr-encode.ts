import type { ExrType } from './exr-block';
import { concat } from './bytes';
import { checkSize, ImageError } from './error';
import { zipBlock } from './exr-zip';
import { toHalf } from './half';

/** Channels that belong together. */
export interface ExrLayer {
  /** Prefix of the channels' names: layer `albedo` and channel `R` make `albedo.R`. Empty for the main layer. */
  readonly name: string;
  /** Default `half`, or `uint` for `Uint32Array`s. */
  readonly type?: ExrType;
  /** One number per pixel and channel, row-major, top row first. */
  readonly channels: Readonly<Record<string, Float32Array | Uint32Array>>;
}

/** Input of {@link encodeExr}. */
export interface ExrSource {
  readonly width: number;
  readonly height: number;
  readonly layers: readonly ExrLayer[];
  /** Default `zip`: lossless, blocks of 16 lines. */
  readonly compression?: 'zip' | 'none';
  /** String attributes for the header, e.g. `{ software: 'glanz', samples: '256' }`. */
  readonly attributes?: Readonly<Record<string, string>>;
}

interface Channel {
  readonly name: string;
  readonly type: ExrType;
  readonly data: Float32Array | Uint32Array;
}

/** Numbers of the OpenEXR file layout. */
export const EXR_MAGIC = 20000630;
export const EXR_TYPES: readonly ExrType[] = ['uint', 'half', 'float'];
export const EXR_COMPRESSION = { none: 0, zips: 2, zip: 3 } as const;
/** Version 2, and the bit that allows names of more than 31 bytes. */
const VERSION = 2;
const LONG_NAMES = 0x400;

function flatten(layers: readonly ExrLayer[], pixels: number): Channel[] {
  const channels: Channel[] = [];
  for (const layer of layers) {
    for (const [key, data] of Object.entries(layer.channels)) {
      const name = layer.name === '' ? key : `${layer.name}.${key}`;
      if (data.length !== pixels)
        throw new ImageError('image/size', `EXR: channel "${name}" has ${data.length} numbers instead of ${pixels}.`);
      if (!/^[\x20-\x7e]{1,255}$/.test(name))
        throw new ImageError(
          'image/channels',
          `EXR: "${name}" is not a valid channel name (1–255 characters of ASCII).`,
        );
      channels.push({ name, type: layer.type ?? (data instanceof Uint32Array ? 'uint' : 'half'), data });
    }
  }
  // Readers rely on the order of bytes, not of locales.
  channels.sort((a, b) => (a.name < b.name ? -1 : a.name > b.name ? 1 : 0));
  const twin = channels.find((channel, i) => channel.name === channels[i + 1]?.name);
  if (channels.length === 0 || twin)
    throw new ImageError(
      'image/channels',
      twin ? `EXR: two channels are called "${twin.name}".` : 'EXR: there is no channel to write.',
    );
  return channels;
}

const text = (s: string) => new TextEncoder().encode(s);

function numbers(kinds: string, ...values: number[]): Uint8Array {
  const out = new Uint8Array(values.reduce((sum, _, i) => sum + (kinds[i] === 'b' ? 1 : 4), 0));
  const view = new DataView(out.buffer);
  let at = 0;
  for (const [i, value] of values.entries()) {
    if (kinds[i] === 'b') view.setUint8(at++, value);
    else {
      if (kinds[i] === 'i') view.setInt32(at, value, true);
      else view.setFloat32(at, value, true);
      at += 4;
    }
  }
  return out;
}

function header(
  width: number,
  height: number,
  channels: readonly Channel[],
  compression: number,
  attributes: Readonly<Record<string, string>>,
): Uint8Array {
  const attribute = (name: string, type: string, value: Uint8Array) =>
    concat([text(`${name}\0${type}\0`), numbers('i', value.length), value]);
  const list = concat([
    ...channels.map(({ name, type }) => concat([text(`${name}\0`), numbers('iiii', EXR_TYPES.indexOf(type), 0, 1, 1)])),
    Uint8Array.of(0),
  ]);
  const window = numbers('iiii', 0, 0, width - 1, height - 1);
  const long = [...channels.map((c) => c.name), ...Object.keys(attributes)].some((name) => name.length > 31);
  return concat([
    numbers('ii', EXR_MAGIC, VERSION | (long ? LONG_NAMES : 0)),
    attribute('channels', 'chlist', list),
    attribute('compression', 'compression', numbers('b', compression)),
    attribute('dataWindow', 'box2i', window),
    attribute('displayWindow', 'box2i', window),
    attribute('lineOrder', 'lineOrder', numbers('b', 0)),
    attribute('pixelAspectRatio', 'float', numbers('f', 1)),
    attribute('screenWindowCenter', 'v2f', numbers('ff', 0, 0)),
    attribute('screenWindowWidth', 'float', numbers('f', 1)),
    // Rec.709 primaries and D65, which readers also assume when it is missing; written to be explicit.
    attribute('chromaticities', 'chromaticities', numbers('ffffffff', 0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329)),
    ...Object.entries(attributes).map(([name, value]) => attribute(name, 'string', text(value))),
    Uint8Array.of(0),
  ]);
}

/** The lines from `first` on: per line, channel after channel. */
function block(
  channels: readonly Channel[],
  width: number,
  first: number,
  count: number,
  bytesPerPixel: number,
): Uint8Array {
  const out = new Uint8Array(width * count * bytesPerPixel);
  const view = new DataView(out.buffer);
  let at = 0;
  for (let y = first; y < first + count; y++) {
    for (const { type, data } of channels) {
      for (let i = y * width; i < (y + 1) * width; i++) {
        const value = data[i] as number;
        if (type === 'half') view.setUint16(at, toHalf(value), true);
        else if (type === 'float') view.setFloat32(at, value, true);
        else view.setUint32(at, value, true);
        at += type === 'half' ? 2 : 4;
      }
    }
  }
  return out;
}

/**
 * Encodes layers of linear numbers as an OpenEXR file: scanlines, single part, ZIP or no compression.
 *
 * @throws {ImageError} `image/size` for a channel of the wrong length, `image/channels` for missing, duplicate or
 * invalid names.
 * @example
 * encodeExr({ width, height, layers: [{ name: '', channels: { R, G, B, A } }, { name: 'depth', type: 'float', channels:
 * { Z } }] });
 */
export function encodeExr({
  width,
  height,
  layers,
  compression = 'zip',
  attributes = {},
}: ExrSource): Uint8Array<ArrayBuffer> {
  checkSize('EXR', width, height, Infinity);
  const channels = flatten(layers, width * height);
  const head = header(width, height, channels, EXR_COMPRESSION[compression], attributes);
  const linesPerBlock = compression === 'zip' ? 16 : 1;
  const blocks = Math.ceil(height / linesPerBlock);
  const bytesPerPixel = channels.reduce((sum, channel) => sum + (channel.type === 'half' ? 2 : 4), 0);
  const table = new Uint8Array(blocks * 8);
  const offsets = new DataView(table.buffer);
  const parts: Uint8Array[] = [head, table];
  let offset = head.length + table.length;
  for (let i = 0; i < blocks; i++) {
    const first = i * linesPerBlock;
    const raw = block(channels, width, first, Math.min(linesPerBlock, height - first), bytesPerPixel);
    const data = compression === 'zip' ? zipBlock(raw) : raw;
    offsets.setBigUint64(i * 8, BigInt(offset), true);
    parts.push(numbers('ii', first, data.length), data);
    offset += 8 + data.length;
  }
  return concat(parts);
}
