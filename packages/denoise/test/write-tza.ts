/** A tensor to write. */
export interface TensorToWrite {
  readonly name: string;
  readonly shape: readonly number[];
  /** `h`: half, `f`: single precision. */
  readonly type: 'h' | 'f';
  readonly data: ArrayLike<number>;
  /** Default `x` for one dimension, `oihw` for four. */
  readonly layout?: string;
}

/** Half-precision bits of a number that half precision holds, or rounded to nearest, ties away from zero. */
export function halfBits(value: number): number {
  const sign = value < 0 || Object.is(value, -0) ? 0x8000 : 0;
  const size = Math.abs(value);
  if (size === Infinity) return sign | 0x7c00;
  if (size < 2 ** -14) return sign | Math.round(size * 2 ** 24);
  const exponent = Math.floor(Math.log2(size));
  return sign | (((exponent + 15) << 10) + Math.round((size / 2 ** exponent - 1) * 1024));
}

/** An archive of TZA 2.0 with these tensors. */
export function writeTza(tensors: readonly TensorToWrite[]): Uint8Array<ArrayBuffer> {
  const bytes: number[] = [];
  const little = (value: number | bigint, count: number) => {
    for (let i = 0, rest = BigInt(value); i < count; i++, rest >>= 8n) bytes.push(Number(rest & 255n));
  };
  const text = (value: string) => bytes.push(...new TextEncoder().encode(value));
  const align = () => {
    while (bytes.length % 64) bytes.push(0);
  };
  little(0x41d7, 2);
  little(2, 1);
  little(0, 1);
  little(0, 8);
  const offsets = tensors.map(({ type, data }) => {
    align();
    const offset = bytes.length;
    for (const value of Array.from(data))
      if (type === 'h') little(halfBits(value), 2);
      else little(new Uint32Array(Float32Array.of(value).buffer)[0]!, 4);
    return offset;
  });
  align();
  const table = bytes.length;
  little(tensors.length, 4);
  for (const [i, { name, shape, type, layout }] of tensors.entries()) {
    little(name.length, 2);
    text(name);
    little(shape.length, 1);
    for (const size of shape) little(size, 4);
    text((layout ?? (shape.length === 4 ? 'oihw' : 'x')).padEnd(shape.length, 'x'));
    text(type);
    little(offsets[i]!, 8);
  }
  const result = Uint8Array.from(bytes);
  new DataView(result.buffer).setBigUint64(4, BigInt(table), true);
  return result;
}
