/** LZ4 makes at most 255 bytes of one. */
export const LZ4_RATIO = 255;

/**
 * Unpacks one LZ4 block (LZ4 Block Format Description) into `target` from `at` on.
 *
 * @returns Where the written bytes end.
 * @throws {RangeError} if the block is cut off, or leads beyond what has been written or beyond the end of the output.
 */
function unpackBlock(block: Uint8Array, target: Uint8Array, at: number): number {
  let from = 0;
  const byte = (): number => {
    if (from >= block.length) throw new RangeError('an LZ4 block is cut off');
    return block[from++] as number;
  };
  const lengthOf = (nibble: number): number => {
    let length = nibble;
    for (let more = nibble === 15 ? 255 : 0; more === 255;) length += more = byte();
    return length;
  };
  while (from < block.length) {
    const token = byte();
    const literals = lengthOf(token >> 4);
    if (from + literals > block.length || at + literals > target.length)
      throw new RangeError('an LZ4 block has more bytes than there is room for');
    target.set(block.subarray(from, from + literals), at);
    from += literals;
    at += literals;
    // The last sequence ends after its literals.
    if (from >= block.length) break;
    const offset = byte() | (byte() << 8);
    const length = lengthOf(token & 15) + 4;
    if (offset === 0 || offset > at || at + length > target.length)
      throw new RangeError('an LZ4 block refers to bytes that do not exist');
    // Ranges may overlap: copied byte by byte.
    for (let i = 0; i < length; i++, at++) target[at] = target[at - offset] as number;
  }
  return at;
}

/**
 * Unpacks what OpenUSD's `TfFastCompression` packed: the number of chunks, 0 for a single one without a length, and
 * LZ4 blocks.
 *
 * @param max Most bytes that it may unpack to.
 * @returns The bytes, of their own length.
 */
export function unpackChunks(bytes: Uint8Array, max: number): Uint8Array<ArrayBuffer> {
  const target = new Uint8Array(Math.min(max, LZ4_RATIO * bytes.length));
  const chunks = bytes[0] ?? 0;
  let end = 0;
  if (chunks === 0) end = unpackBlock(bytes.subarray(1), target, 0);
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let i = 0, at = 1; i < chunks; i++) {
    const length = view.getInt32(at, true);
    if (length < 0 || at + 4 + length > bytes.length) throw new RangeError('a compressed chunk is cut off');
    end = unpackBlock(bytes.subarray(at + 4, at + 4 + length), target, end);
    at += 4 + length;
  }
  return target.subarray(0, end);
}

/**
 * Unpacks OpenUSD's integer coding: differences in 2-bit codes (0 the common difference, else a number of 1, 2 or 4
 * bytes; of 2, 4 or 8 for 64 bits), packed by {@link unpackChunks}.
 */
export function unpackIntegers(bytes: Uint8Array, count: number, wide = false): Int32Array | Float64Array {
  const unit = wide ? 8 : 4;
  const codes = Math.ceil(count / 4);
  if (codes > LZ4_RATIO * bytes.length) throw new RangeError('an array claims more numbers than its bytes can hold');
  const packed = unpackChunks(bytes, unit + codes + unit * count);
  const view = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
  const result = wide ? new Float64Array(count) : new Int32Array(count);
  const number = (at: number, size: number): number =>
    size === 1
      ? view.getInt8(at)
      : size === 2
        ? view.getInt16(at, true)
        : size === 4
          ? view.getInt32(at, true)
          : Number(view.getBigInt64(at, true));
  const common = number(0, unit);
  for (let i = 0, at = unit + codes, value = 0; i < count; i++) {
    const code = (view.getUint8(unit + (i >> 2)) >> (2 * (i & 3))) & 3;
    const size = code === 0 ? 0 : (wide ? 2 : 1) << (code - 1);
    value += size === 0 ? common : number(at, size);
    at += size;
    if (!wide) value |= 0;
    result[i] = value;
  }
  return result;
}
