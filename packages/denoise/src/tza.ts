import { DenoiseError } from './error';

/** A tensor of a TZA archive. */
export interface TzaTensor {
  /** Name in the archive, e.g. `enc_conv0.weight`. */
  readonly name: string;
  /** Sizes, the slowest first: `[out, in, rows, columns]` of a convolution's weights, `[out]` of its biases. */
  readonly shape: readonly number[];
  /** Values in C order, widened from half precision where the archive holds that. */
  readonly data: Float32Array<ArrayBuffer>;
}

/** Largest number of elements in a tensor. The largest one in Open Image Denoise's archives has 663,552. */
const MAX_ELEMENTS = 1 << 26;

/** By sign and exponent of a half-precision number: what the last bit of its fraction is worth. */
const HALF_UNITS = /* @__PURE__ */ Float64Array.from(
  { length: 64 },
  (_, i) => (i & 32 ? -1 : 1) * 2 ** (Math.max(i & 31, 1) - 25),
);

/** What a half-precision number means. */
function halfValue(bits: number): number {
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : HALF_UNITS[bits >> 10]! * Infinity;
  return HALF_UNITS[bits >> 10]! * (exponent === 0 ? fraction : 1024 + fraction);
}

/** Reads in the archive with every access checked. */
class Reader {
  readonly view: DataView;
  at = 0;

  constructor(bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  /** Moves over `count` bytes and returns where they begin. */
  take(count: number, what: string): number {
    const from = this.at;
    if (!(count <= this.view.byteLength - from)) throw this.broken(`${what} at byte ${from} lies beyond the end`, from);
    this.at = from + count;
    return from;
  }

  u8 = (what: string): number => this.view.getUint8(this.take(1, what));
  u16 = (what: string): number => this.view.getUint16(this.take(2, what), true);
  u32 = (what: string): number => this.view.getUint32(this.take(4, what), true);
  /** Offsets; those beyond 2^53 round, and are beyond any end all the same. */
  u64 = (what: string): number => Number(this.view.getBigUint64(this.take(8, what), true));
  text(length: number, what: string): string {
    const from = this.take(length, what);
    let text = '';
    for (let i = 0; i < length; i++) text += String.fromCharCode(this.view.getUint8(from + i));
    return text;
  }

  broken(what: string, byteOffset: number): DenoiseError {
    return new DenoiseError(
      'denoise/weights',
      `The TZA archive of ${this.view.byteLength} bytes is damaged: ${what}. Load it again.`,
      { location: { byteOffset } },
    );
  }
}

function readTensor(reader: Reader): TzaTensor {
  const entry = reader.at;
  const name = reader.text(reader.u16('the length of a name'), 'a name');
  const rank = reader.u8('a rank');
  const shape = Array.from({ length: rank }, () => reader.u32('a size'));
  const layout = reader.text(rank, 'a layout');
  const type = reader.text(1, 'a type');
  const offset = reader.u64('an offset');
  if (!((layout === 'x' || layout === 'oihw') && (type === 'h' || type === 'f')))
    throw reader.broken(`tensor "${name}" has layout "${layout}" and type "${type}", which are unknown`, entry);
  const count = shape.reduce((product, size) => product * size, 1);
  const size = type === 'h' ? 2 : 4;
  if (!(count > 0 && count <= MAX_ELEMENTS && offset + count * size <= reader.view.byteLength))
    throw reader.broken(`the ${count} values of tensor "${name}" at byte ${offset} lie beyond the end`, entry);
  const data = new Float32Array(count);
  const { view } = reader;
  // Millions of values: a loop for each type.
  if (size === 2) for (let i = 0; i < count; i++) data[i] = halfValue(view.getUint16(offset + 2 * i, true));
  else for (let i = 0; i < count; i++) data[i] = view.getFloat32(offset + 4 * i, true);
  return { name, shape, data };
}

/**
 * Reads a TZA archive, version 2: the tensors of a neural network, as Open Image Denoise stores them. It never reads
 * outside of the bytes, whatever they are.
 *
 * @param bytes The whole file.
 * @returns The tensors by name, in the order of the archive.
 * @throws {DenoiseError} `denoise/weights` for bytes that are not an archive, truncated or damaged.
 * @example
 * const tensors = parseTza(await (await fetch('rt_hdr_small.tza')).arrayBuffer());
 * tensors.get('enc_conv0.weight')?.shape; // → [32, 3, 3, 3]
 */
export function parseTza(bytes: Uint8Array | ArrayBuffer): ReadonlyMap<string, TzaTensor> {
  const reader = new Reader(bytes instanceof ArrayBuffer ? new Uint8Array(bytes) : bytes);
  const { view } = reader;
  if (view.byteLength < 12 || view.getUint16(0, true) !== 0x41d7 || view.getUint8(2) !== 2)
    throw new DenoiseError(
      'denoise/weights',
      `These ${view.byteLength} bytes are not a TZA archive of version 2. Pass the whole content of a .tza file.`,
      { location: { byteOffset: 0 } },
    );
  reader.at = 4;
  const table = reader.u64('the table');
  if (table > view.byteLength) throw reader.broken(`the table at byte ${table} lies beyond the end`, 4);
  reader.at = table;
  const tensors = new Map<string, TzaTensor>();
  const count = reader.u32('the number of tensors');
  for (let i = 0; i < count; i++) {
    const tensor = readTensor(reader);
    if (tensors.has(tensor.name)) throw reader.broken(`tensor "${tensor.name}" is there twice`, reader.at);
    tensors.set(tensor.name, tensor);
  }
  return tensors;
}
