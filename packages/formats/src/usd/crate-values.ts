import type { CrateReader } from './crate-reader';
import type { UsdValue } from './layer';

/** Tables of a crate file that its values refer to. */
export interface CrateTables {
  readonly tokens: readonly string[];
  /** Numbers of tokens. */
  readonly strings: ArrayLike<number>;
  readonly paths: readonly (string | undefined)[];
  /** Minor version of the file's format, of major version 0. */
  readonly version: number;
}

type Scalar = 'bool' | 'u8' | 'i32' | 'i64' | 'half' | 'float' | 'double' | 'string' | 'token';
/** Kinds of values that are read: the kind of their numbers, how many, and whether they are a square matrix. */
const KINDS: Readonly<Record<number, readonly [scalar: Scalar, size: number, matrix?: number]>> = {
  1: ['bool', 1],
  2: ['u8', 1],
  3: ['i32', 1],
  4: ['i32', 1],
  5: ['i64', 1],
  6: ['i64', 1],
  7: ['half', 1],
  8: ['float', 1],
  9: ['double', 1],
  10: ['string', 1],
  11: ['token', 1],
  12: ['token', 1],
  13: ['double', 4, 2],
  14: ['double', 9, 3],
  15: ['double', 16, 4],
  16: ['double', 4],
  17: ['float', 4],
  18: ['half', 4],
  19: ['double', 2],
  20: ['float', 2],
  21: ['half', 2],
  22: ['i32', 2],
  23: ['double', 3],
  24: ['float', 3],
  25: ['half', 3],
  26: ['i32', 3],
  27: ['double', 4],
  28: ['float', 4],
  29: ['half', 4],
  30: ['i32', 4],
};
const BYTES: Readonly<Record<Scalar, number>> = {
  bool: 1,
  u8: 1,
  i32: 4,
  i64: 8,
  half: 2,
  float: 4,
  double: 8,
  string: 4,
  token: 4,
};
const SPECIFIER = 42;
const TOKEN_VECTOR = 41;
const PATH_VECTOR = 40;
const PATH_LIST = 34;
const TIME_SAMPLES = 46;
/** Shorter arrays are not compressed. */
const SHORT = 16;
const ARRAY = 1n << 63n;
const INLINED = 1n << 62n;
const COMPRESSED = 1n << 61n;

const numberAt = (reader: CrateReader, scalar: Scalar): number => {
  switch (scalar) {
    case 'bool':
    case 'u8':
      return reader.u8();
    case 'i32':
      return reader.i32();
    case 'i64':
      return reader.i64();
    case 'half':
      return reader.f16();
    case 'float':
      return reader.f32();
    case 'double':
      return reader.f64();
    default:
      return reader.u32();
  }
};

/** A value that lies in its 64 bits: vectors and matrices of small whole numbers, and whatever 32 bits hold. */
function inlined(type: number, payload: number, tables: CrateTables): UsdValue | undefined {
  if (type === SPECIFIER) return payload;
  const kind = KINDS[type];
  if (!kind) return undefined;
  const [scalar, size, matrix] = kind;
  const view = new DataView(new ArrayBuffer(8));
  view.setUint32(0, payload >>> 0, true);
  view.setUint32(4, Math.floor(payload / 2 ** 32), true);
  if (matrix)
    return Array.from({ length: size }, (_, i) =>
      Math.floor(i / matrix) === i % matrix ? view.getInt8(i % matrix) : 0,
    );
  if (size > 1) return Array.from({ length: size }, (_, i) => view.getInt8(i));
  if (scalar === 'token') return tables.tokens[payload];
  if (scalar === 'string') return tables.tokens[tables.strings[payload] ?? -1];
  if (scalar === 'bool') return payload !== 0;
  if (scalar === 'float' || scalar === 'double') return view.getFloat32(0, true);
  if (scalar === 'half') {
    const bits = payload & 0xffff;
    return (
      (bits & 0x8000 ? -1 : 1) *
      (bits & 0x7c00 ? (1024 + (bits & 1023)) * 2 ** (((bits >> 10) & 31) - 25) : (bits & 1023) * 2 ** -24)
    );
  }
  return view.getInt32(0, true);
}

function arrayAt(reader: CrateReader, type: number, compressed: boolean, tables: CrateTables): UsdValue | undefined {
  const kind = KINDS[type];
  if (!kind) return undefined;
  const [scalar, size] = kind;
  // Before version 0.5 arrays had a rank, always 1.
  if (tables.version < 5) reader.u32();
  const count = (tables.version < 7 ? reader.u32() : reader.i64()) * size;
  const packed = compressed && tables.version >= 5 && count >= SHORT && size === 1;
  if (!(count >= 0) || (!packed && count * BYTES[scalar] > reader.length - reader.at))
    throw new RangeError(`an array of ${count} numbers does not fit into the file`);
  if (packed && (scalar === 'i32' || scalar === 'i64')) return reader.integers(count, scalar === 'i64');
  if (packed && (scalar === 'half' || scalar === 'float' || scalar === 'double')) {
    const how = String.fromCharCode(reader.u8());
    if (how === 'i') return Float64Array.from(reader.integers(count));
    if (how !== 't') throw new RangeError(`an array is compressed in the unknown way "${how}"`);
    const length = reader.u32();
    if (length * BYTES[scalar] > reader.length - reader.at) throw new RangeError('a table of numbers is cut off');
    const table = Array.from({ length }, () => numberAt(reader, scalar));
    return Float64Array.from(reader.integers(count), (index) => table[index] ?? NaN);
  }
  if (scalar === 'token' || scalar === 'string')
    return Array.from({ length: count }, () => {
      const index = reader.u32();
      return tables.tokens[scalar === 'token' ? index : (tables.strings[index] ?? -1)] ?? '';
    });
  const numbers = new Float64Array(count);
  for (let i = 0; i < count; i++) numbers[i] = numberAt(reader, scalar);
  return numbers;
}

/** Items of a list of changes to a list of paths: those that it adds, or all where it is explicit. */
function pathList(reader: CrateReader, tables: CrateTables): string[] {
  const flags = reader.u8();
  const found: string[] = [];
  // Explicit, added, prepended, appended, deleted, ordered.
  for (const bit of [2, 4, 32, 64, 8, 16]) {
    if (!(flags & bit)) continue;
    const items = Array.from({ length: reader.count(4) }, () => tables.paths[reader.u32()] ?? '');
    if (bit !== 8 && bit !== 16) found.push(...items);
  }
  return found;
}

/** Times and values; the value of the first time. */
function firstSample(reader: CrateReader, tables: CrateTables, depth: number): UsdValue | undefined {
  const jump = () => {
    const start = reader.at;
    reader.at = start + reader.i64();
  };
  jump();
  reader.bits64();
  jump();
  return reader.count(8) > 0 ? valueOf(reader, reader.bits64(), tables, depth + 1) : undefined;
}

/**
 * The value that 64 bits stand for; undefined for those of kinds that a scene has no use for.
 *
 * @throws {RangeError} if it does not lie in the file.
 */
export function valueOf(reader: CrateReader, bits: bigint, tables: CrateTables, depth = 0): UsdValue | undefined {
  const type = Number((bits >> 48n) & 255n);
  const payload = Number(bits & 0xffffffffffffn);
  const array = (bits & ARRAY) !== 0n;
  if ((bits & INLINED) !== 0n && !array) return inlined(type, payload, tables);
  if (array && payload === 0) return [];
  reader.at = payload;
  if (array) return arrayAt(reader, type, (bits & COMPRESSED) !== 0n, tables);
  if (type === TOKEN_VECTOR) return Array.from({ length: reader.count(4) }, () => tables.tokens[reader.u32()] ?? '');
  if (type === PATH_VECTOR) return Array.from({ length: reader.count(4) }, () => tables.paths[reader.u32()] ?? '');
  if (type === PATH_LIST) return pathList(reader, tables);
  if (type === TIME_SAMPLES) return depth === 0 ? firstSample(reader, tables, depth) : undefined;
  const kind = KINDS[type];
  if (!kind) return undefined;
  const [scalar, size] = kind;
  if (size > 1) return Array.from({ length: size }, () => numberAt(reader, scalar));
  return scalar === 'token' || scalar === 'string' ? undefined : numberAt(reader, scalar);
}
