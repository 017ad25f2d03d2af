/** Code lengths have so many bits in the file; from 59 on they count lengths of 0. */
const LENGTH_BITS = 6;
const SHORT_RUN = 59;
const LONG_RUN = 63;
/** Codes that a table finds at once. */
const TABLE_BITS = 12;
/** Longer codes cannot come from images, and would not be exact in a number. */
const LONGEST = 52;

/**
 * OpenEXR's Huffman code of 16-bit words, with runs of the last word.
 *
 * @param packed Header of 20 bytes, table of code lengths, code.
 * @param count Words that come out.
 * @returns `undefined` if the data does not give exactly that.
 */
export function unpackHuffman(packed: Uint8Array, count: number): Uint16Array | undefined {
  if (packed.length < 20) return count === 0 && packed.length === 0 ? new Uint16Array(0) : undefined;
  const header = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
  const [low, high, , bits] = [0, 4, 8, 12].map((at) => header.getUint32(at, true)) as [number, number, number, number];
  if (low > 65536 || high > 65536 || low > high) return undefined;
  const reader = new BitReader(packed.subarray(20));
  const lengths = new Uint8Array(65537);
  for (let symbol = low; symbol <= high; symbol++) {
    const length = reader.read(LENGTH_BITS);
    if (length < SHORT_RUN) lengths[symbol] = length;
    else {
      const run = length === LONG_RUN ? reader.read(8) + LONG_RUN - SHORT_RUN + 2 : length - SHORT_RUN + 2;
      if (symbol + run > high + 1) return undefined;
      symbol += run - 1;
    }
  }
  if (reader.overrun) return undefined;
  const code = packed.subarray(20 + Math.ceil(reader.at / 8));
  if (bits > code.length * 8) return undefined;
  const codes = new Codes(lengths, low, high);
  return codes.valid ? codes.decode(new BitReader(code), bits, high, count) : undefined;
}

class BitReader {
  at = 0;
  readonly #bytes: Uint8Array;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
  }

  get overrun(): boolean {
    return this.at > this.#bytes.length * 8;
  }

  /** The next bits, the first one highest; at most 24. Beyond the end there are zeros. */
  peek(count: number): number {
    const b = this.#bytes,
      i = this.at >> 3;
    const word =
      (((b[i] ?? 0) << 24) | ((b[i + 1] ?? 0) << 16) | ((b[i + 2] ?? 0) << 8) | (b[i + 3] ?? 0)) << (this.at & 7);
    return word >>> (32 - count);
  }

  read(count: number): number {
    const value = this.peek(count);
    this.at += count;
    return value;
  }
}

/** Canonical codes: by length, longer ones have the smaller numbers; by symbol among the same length. */
class Codes {
  readonly valid: boolean;
  readonly #first = new Float64Array(LONGEST + 2);
  readonly #count = new Uint32Array(64);
  /** Symbols by length, then by number; where those of a length begin. */
  readonly #symbols: Uint32Array;
  readonly #start = new Uint32Array(64);
  readonly #table = new Int32Array(1 << TABLE_BITS).fill(-1);

  constructor(lengths: Uint8Array, low: number, high: number) {
    for (let s = low; s <= high; s++) (this.#count[lengths[s] as number] as number)++;
    this.#count[0] = 0;
    let longest = 58;
    while (longest > 0 && this.#count[longest] === 0) longest--;
    let total = 0;
    for (let l = 1; l <= longest; l++) {
      this.#start[l] = total;
      total += this.#count[l] as number;
    }
    this.#symbols = new Uint32Array(total);
    const filled = this.#start.slice();
    for (let s = low; s <= high; s++) if (lengths[s]) this.#symbols[(filled[lengths[s] as number] as number)++] = s;
    let code = 0;
    let fits = longest <= LONGEST && longest > 0;
    for (let l = Math.min(longest, LONGEST); l > 0; l--) {
      this.#first[l] = code;
      if (code + (this.#count[l] as number) > 2 ** l) fits = false;
      code = Math.floor((code + (this.#count[l] as number)) / 2);
    }
    this.valid = fits;
    if (!fits) return;
    for (let l = 1; l <= TABLE_BITS; l++) {
      for (let i = 0; i < (this.#count[l] as number); i++) {
        const from = ((this.#first[l] as number) + i) << (TABLE_BITS - l);
        this.#table.fill(
          ((this.#symbols[(this.#start[l] as number) + i] as number) << 6) | l,
          from,
          from + (1 << (TABLE_BITS - l)),
        );
      }
    }
  }

  decode(reader: BitReader, bits: number, run: number, count: number): Uint16Array | undefined {
    const out = new Uint16Array(count);
    let to = 0;
    while (reader.at < bits) {
      const symbol = this.#next(reader, bits);
      if (symbol < 0 || reader.at > bits) return undefined;
      if (symbol === run) {
        const times = reader.read(8);
        if (to === 0 || to + times > count || reader.at > bits) return undefined;
        out.fill(out[to - 1] as number, to, to + times);
        to += times;
      } else {
        if (to >= count) return undefined;
        out[to++] = symbol;
      }
    }
    return to === count ? out : undefined;
  }

  #next(reader: BitReader, bits: number): number {
    const entry = this.#table[reader.peek(TABLE_BITS)] as number;
    if (entry >= 0) {
      reader.at += entry & 63;
      return entry >> 6;
    }
    let code = reader.read(TABLE_BITS);
    for (let length = TABLE_BITS + 1; length <= LONGEST && reader.at < bits; length++) {
      code = 2 * code + reader.read(1);
      const place = code - (this.#first[length] as number);
      if (place >= 0 && place < (this.#count[length] as number))
        return this.#symbols[(this.#start[length] as number) + place] as number;
    }
    return -1;
  }
}
