import { bytesOf, type ExrBlock, type ExrChannelInfo, type ExrType, interleavePlanes } from './exr-block';
import { unpackHuffman } from './exr-huffman';
import { unpackRuns } from './exr-rle';
import { inflateTo, unzipBlock } from './exr-zip';
import { fromHalf, toHalf } from './half';

/** How a channel is packed: as it is through zlib, by cosines, or in runs. */
type Scheme = 'unknown' | 'cosines' | 'runs';
const SCHEMES: readonly Scheme[] = ['unknown', 'cosines', 'runs'];

interface Rule {
  readonly suffix: string;
  readonly scheme: Scheme;
  readonly type: ExrType;
  /** 0, 1, 2: red, green and blue of a colour that is packed as luminance and differences. −1: alone. */
  readonly color: number;
  readonly anyCase: boolean;
}

const HEADER_BYTES = 88;
const TYPES: readonly ExrType[] = ['uint', 'half', 'float'];

/** Rules of files that carry none. */
const legacyRules = (): readonly Rule[] =>
  (['half', 'float'] as const)
    .flatMap((type) =>
      (
        [
          ['r', 0],
          ['red', 0],
          ['g', 1],
          ['grn', 1],
          ['green', 1],
          ['b', 2],
          ['blu', 2],
          ['blue', 2],
          ['y', -1],
          ['by', -1],
          ['ry', -1],
        ] as const
      ).map(([suffix, color]): Rule => ({ suffix, scheme: 'cosines', type, color, anyCase: true })),
    )
    .concat(TYPES.map((type): Rule => ({ suffix: 'a', scheme: 'runs', type, color: -1, anyCase: true })));

/** Where the coefficients of a square stand in the file: by diagonals. */
const ZIGZAG: readonly number[] = /* @__PURE__ */ zigzag();

function zigzag(): number[] {
  const order: number[] = [];
  for (let sum = 0; sum < 15; sum++) {
    for (let k = 0; k <= sum; k++) {
      const [row, column] = sum % 2 === 0 ? [sum - k, k] : [k, sum - k];
      if (row < 8 && column < 8) order.push(8 * row + column);
    }
  }
  return order;
}

/**
 * The halves that the stored ones stand for, which are spaced as the eye sees: a power of 2.2 up to 1, exponential
 * above.
 */
function toLinear(value: number): number {
  if (!Number.isFinite(value)) return 0;
  const size = Math.abs(value);
  return Math.sign(value) * (size <= 1 ? size ** 2.2 : Math.E ** (2.2 * (size - 1)));
}

/** OpenEXR's DWAA and DWAB: cosines in squares of 8 × 8 for colours, runs for alpha, zlib for the rest. Lossy. */
export function unpackDwa(packed: Uint8Array, block: ExrBlock): Uint8Array | undefined {
  if (packed.length < HEADER_BYTES) return undefined;
  const view = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
  const header = Array.from({ length: 11 }, (_, i) => Number(view.getBigUint64(8 * i, true)));
  const [
    version,
    unknownSize,
    unknownPacked,
    acPacked,
    dcPacked,
    runsPacked,
    runsUnpacked,
    runsSize,
    acCount,
    dcCount,
    acMethod,
  ] = header as [number, number, number, number, number, number, number, number, number, number, number];
  const { channels, width, lines } = block;
  const pixels = width * lines;
  let at = HEADER_BYTES;
  let rules = version < 2 ? legacyRules() : [];
  if (version > 2) return undefined;
  if (version === 2) {
    if (at + 2 > packed.length) return undefined;
    const size = view.getUint16(at, true);
    const read = readRules(packed.subarray(at + 2, at + size));
    if (size < 2 || at + size > packed.length || !read) return undefined;
    rules = read;
    at += size;
  }
  const take = (length: number) => {
    const part = packed.subarray(at, at + length);
    at += length;
    return part;
  };
  const blocks = Math.ceil(width / 8) * Math.ceil(lines / 8);
  const schemes = channels.map((channel) => ruleOf(channel, rules));
  const sizeOf = (scheme: Scheme) =>
    channels.reduce((sum, channel, c) => sum + (schemes[c]?.scheme === scheme ? pixels * bytesOf(channel) : 0), 0);
  const cosines = schemes.filter(({ scheme }) => scheme === 'cosines').length;
  if (
    unknownSize !== sizeOf('unknown') ||
    runsSize !== sizeOf('runs') ||
    dcCount !== cosines * blocks ||
    acCount > cosines * blocks * 64 ||
    runsUnpacked > 2 * runsSize + 2 ||
    unknownPacked + acPacked + dcPacked + runsPacked > packed.length - at
  )
    return undefined;

  const none = new Uint8Array(0);
  const unknown = unknownSize > 0 ? inflateTo(take(unknownPacked), unknownSize) : none;
  const acBytes = take(acPacked);
  const ac =
    acCount === 0
      ? new Uint16Array(0)
      : acMethod === 0
        ? unpackHuffman(acBytes, acCount)
        : words(inflateTo(acBytes, 2 * acCount));
  const dc = dcCount === 0 ? new Uint16Array(0) : words(unzipBlock(take(dcPacked), 2 * dcCount));
  const runs = runsSize > 0 ? inflateTo(take(runsPacked), runsUnpacked) : none;
  const flat = runs && (runsSize > 0 ? unpackRuns(runs, runsSize) : none);
  if (!unknown || !ac || !dc || !flat) return undefined;

  const planes: Uint8Array[] = channels.map((channel) => new Uint8Array(pixels * bytesOf(channel)));
  const squares = new Squares(ac, dc, width, lines);
  const done = new Set<number>();
  for (const set of colorSets(channels, schemes)) {
    if (
      !squares.read(
        set.map((c) => ({ plane: planes[c] as Uint8Array, type: (channels[c] as ExrChannelInfo).type, linear: false })),
      )
    )
      return undefined;
    for (const c of set) done.add(c);
  }
  let unknownAt = 0,
    runsAt = 0;
  for (const [c, channel] of channels.entries()) {
    const plane = planes[c] as Uint8Array,
      size = bytesOf(channel);
    switch (schemes[c]?.scheme) {
      case 'cosines':
        if (!done.has(c) && !squares.read([{ plane, type: channel.type, linear: channel.linear }])) return undefined;
        break;
      case 'runs':
        // The bytes of the numbers lie apart, all first ones first.
        for (let b = 0; b < size; b++) for (let i = 0; i < pixels; i++) plane[size * i + b] = flat[runsAt++] as number;
        break;
      default:
        plane.set(unknown.subarray(unknownAt, unknownAt + plane.length));
        unknownAt += plane.length;
    }
  }
  return interleavePlanes(block, planes);
}

const words = (bytes: Uint8Array | undefined): Uint16Array | undefined => {
  if (!bytes) return undefined;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  return new Uint16Array(bytes.length >> 1).map((_, i) => view.getUint16(2 * i, true));
};

function readRules(bytes: Uint8Array): Rule[] | undefined {
  const rules: Rule[] = [];
  for (let at = 0; at < bytes.length;) {
    const end = bytes.indexOf(0, at);
    if (end < 0 || end + 2 >= bytes.length) return undefined;
    const bits = bytes[end + 1] as number;
    const scheme = SCHEMES[(bits >> 2) & 3],
      type = TYPES[bytes[end + 2] as number];
    const color = (bits >> 4) - 1;
    if (!scheme || !type || color > 2) return undefined;
    rules.push({
      suffix: String.fromCharCode(...bytes.subarray(at, end)),
      scheme,
      type,
      color,
      anyCase: (bits & 1) === 1,
    });
    at = end + 3;
  }
  return rules;
}

function ruleOf({ name, type }: ExrChannelInfo, rules: readonly Rule[]): Rule {
  const suffix = name.slice(name.lastIndexOf('.') + 1);
  return (
    rules.find(
      (rule) =>
        rule.type === type &&
        (rule.anyCase ? rule.suffix.toLowerCase() === suffix.toLowerCase() : rule.suffix === suffix),
    ) ?? { suffix, scheme: 'unknown', type, color: -1, anyCase: false }
  );
}

/** Red, green and blue of each layer that has them all, by the layers' names. */
function colorSets(channels: readonly ExrChannelInfo[], rules: readonly Rule[]): number[][] {
  const sets = new Map<string, number[]>();
  channels.forEach(({ name }, c) => {
    const { color, scheme } = rules[c] as Rule;
    if (color < 0 || scheme !== 'cosines') return;
    const layer = name.slice(0, name.lastIndexOf('.') + 1);
    const set = sets.get(layer) ?? [-1, -1, -1];
    set[color] = c;
    sets.set(layer, set);
  });
  return [...sets]
    .sort(([a], [b]) => (a < b ? -1 : 1))
    .map(([, set]) => set)
    .filter((set) => set.every((c) => c >= 0));
}

/** A channel that is made of squares. */
interface Component {
  readonly plane: Uint8Array;
  readonly type: ExrType;
  readonly linear: boolean;
}

/** cos((2x + 1) u π / 16) with the scale that makes the transform orthonormal, by 8 u + x. */
const COSINES = /* @__PURE__ */ Float64Array.from(
  { length: 64 },
  (_, i) => (i < 8 ? Math.SQRT1_2 : 1) * 0.5 * Math.cos(((2 * (i & 7) + 1) * (i >> 3) * Math.PI) / 16),
);

/** The squares of 8 × 8 of a block, in the order of the file. */
class Squares {
  readonly #ac: Uint16Array;
  readonly #dc: Uint16Array;
  readonly #width: number;
  readonly #lines: number;
  #acAt = 0;
  #dcAt = 0;

  constructor(ac: Uint16Array, dc: Uint16Array, width: number, lines: number) {
    this.#ac = ac;
    this.#dc = dc;
    this.#width = width;
    this.#lines = lines;
  }

  /** Reads one channel, or three that are luminance and two differences. */
  read(components: readonly Component[]): boolean {
    const columns = Math.ceil(this.#width / 8),
      rows = Math.ceil(this.#lines / 8);
    const values = components.map(() => new Float64Array(64));
    const views = components.map(({ plane }) => new DataView(plane.buffer, plane.byteOffset, plane.byteLength));
    for (let row = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++) {
        for (let c = 0; c < components.length; c++) {
          const average = this.#dc[this.#dcAt + c * columns * rows + row * columns + column] as number;
          if (!this.#square(average, values[c] as Float64Array)) return false;
        }
        if (components.length === 3) fromLuminance(values as [Float64Array, Float64Array, Float64Array]);
        components.forEach((component, c) =>
          this.#store(component, views[c] as DataView, values[c] as Float64Array, row, column),
        );
      }
    }
    this.#dcAt += components.length * columns * rows;
    return true;
  }

  #square(average: number, out: Float64Array): boolean {
    const ac = this.#ac;
    const coefficients = new Float64Array(64);
    coefficients[0] = fromHalf(average);
    let flat = true;
    for (let k = 1; k < 64;) {
      if (this.#acAt >= ac.length) return false;
      const word = ac[this.#acAt++] as number;
      // Words that would be NaN count zeros; a count of 0 is all that are left.
      if (word >> 8 === 0xff) k += word & 0xff || 64;
      else {
        coefficients[ZIGZAG[k++] as number] = fromHalf(word);
        flat = false;
      }
    }
    if (flat) out.fill((coefficients[0] as number) / 8);
    else cosineSum(coefficients, out);
    return true;
  }

  #store({ type, linear }: Component, view: DataView, values: Float64Array, row: number, column: number): void {
    for (let j = 0; j < Math.min(8, this.#lines - 8 * row); j++) {
      for (let i = 0; i < Math.min(8, this.#width - 8 * column); i++) {
        const at = (8 * row + j) * this.#width + 8 * column + i;
        const coded = toHalf(values[8 * j + i] as number);
        const half = linear ? coded : toHalf(toLinear(fromHalf(coded)));
        if (type === 'half') view.setUint16(2 * at, half, true);
        else if (type === 'float') view.setFloat32(4 * at, fromHalf(half), true);
        else view.setUint32(4 * at, Math.max(0, Math.round(fromHalf(half))), true);
      }
    }
  }
}

/** The inverse cosine transform of rows and columns. */
function cosineSum(coefficients: Float64Array, out: Float64Array): void {
  const half = new Float64Array(64);
  for (let v = 0; v < 8; v++) {
    for (let x = 0; x < 8; x++) {
      let sum = 0;
      for (let u = 0; u < 8; u++) sum += (coefficients[8 * v + u] as number) * (COSINES[8 * u + x] as number);
      half[8 * v + x] = sum;
    }
  }
  for (let y = 0; y < 8; y++) {
    for (let x = 0; x < 8; x++) {
      let sum = 0;
      for (let v = 0; v < 8; v++) sum += (half[8 * v + x] as number) * (COSINES[8 * v + y] as number);
      out[8 * y + x] = sum;
    }
  }
}

/** Luminance and the two differences of Rec. 709 to red, green and blue, in place. */
function fromLuminance([a, b, c]: readonly [Float64Array, Float64Array, Float64Array]): void {
  for (let i = 0; i < 64; i++) {
    const y = a[i] as number,
      cb = b[i] as number,
      cr = c[i] as number;
    a[i] = y + 1.5747 * cr;
    b[i] = y - 0.1873 * cb - 0.4682 * cr;
    c[i] = y + 1.8556 * cb;
  }
}
