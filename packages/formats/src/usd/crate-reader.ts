import { LZ4_RATIO, unpackChunks, unpackIntegers } from './lz4';

/** Reads little-endian numbers of a crate file in order. What lies beyond its end is a `RangeError`. */
export class CrateReader {
  readonly #view: DataView;
  readonly #bytes: Uint8Array;
  at = 0;

  constructor(bytes: Uint8Array) {
    this.#bytes = bytes;
    this.#view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get length(): number {
    return this.#bytes.length;
  }

  u8(): number {
    return this.#view.getUint8(this.at++);
  }

  u32(): number {
    this.at += 4;
    return this.#view.getUint32(this.at - 4, true);
  }

  i32(): number {
    this.at += 4;
    return this.#view.getInt32(this.at - 4, true);
  }

  f32(): number {
    this.at += 4;
    return this.#view.getFloat32(this.at - 4, true);
  }

  f64(): number {
    this.at += 8;
    return this.#view.getFloat64(this.at - 8, true);
  }

  /** 64 bits as a number: exact up to 2⁵³, which no file reaches. */
  i64(): number {
    this.at += 8;
    return Number(this.#view.getBigInt64(this.at - 8, true));
  }

  bits64(): bigint {
    this.at += 8;
    return this.#view.getBigUint64(this.at - 8, true);
  }

  /** Half precision, IEEE 754 binary16. */
  f16(): number {
    this.at += 2;
    const bits = this.#view.getUint16(this.at - 2, true);
    const exponent = (bits >> 10) & 31;
    const fraction = bits & 1023;
    const magnitude =
      exponent === 31
        ? fraction
          ? NaN
          : Infinity
        : exponent === 0
          ? fraction * 2 ** -24
          : (1024 + fraction) * 2 ** (exponent - 25);
    return bits & 0x8000 ? -magnitude : magnitude;
  }

  /** A number of elements of at least `size` bytes each that lie in the file. */
  count(size: number): number {
    const count = this.i64();
    if (!(count >= 0 && count * size <= this.length - this.at))
      throw new RangeError(`${count} elements do not fit into the file`);
    return count;
  }

  bytes(length: number): Uint8Array {
    if (!(length >= 0 && this.at + length <= this.length)) throw new RangeError('it is cut off');
    this.at += length;
    return this.#bytes.subarray(this.at - length, this.at);
  }

  /** Compressed bytes after their size. */
  packed(max: number): Uint8Array<ArrayBuffer> {
    return unpackChunks(this.bytes(this.count(1)), max);
  }

  /** Compressed integers after their size in bytes. */
  integers(count: number, wide = false): Int32Array | Float64Array {
    return unpackIntegers(this.bytes(this.count(1)), count, wide);
  }

  /** A number of compressed elements of at least two bits each. */
  packedCount(): number {
    const count = this.i64();
    if (!(count >= 0 && count <= 4 * LZ4_RATIO * (this.length - this.at)))
      throw new RangeError(`${count} elements do not fit into the file`);
    return count;
  }
}
