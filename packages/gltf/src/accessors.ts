import type { GltfAccessor, GltfJson } from './json';
import type { Budget } from './limits';

/** Numbers as glTF stores them. */
export type Numbers =
  | Int8Array<ArrayBuffer>
  | Uint8Array<ArrayBuffer>
  | Int16Array<ArrayBuffer>
  | Uint16Array<ArrayBuffer>
  | Uint32Array<ArrayBuffer>
  | Float32Array<ArrayBuffer>;

interface NumbersType {
  new (length: number): Numbers;
  new (buffer: ArrayBuffer, byteOffset: number, length: number): Numbers;
  readonly BYTES_PER_ELEMENT: number;
}

const TYPES: Readonly<Record<number, NumbersType>> = {
  5120: Int8Array,
  5121: Uint8Array,
  5122: Int16Array,
  5123: Uint16Array,
  5125: Uint32Array,
  5126: Float32Array,
};

/** The integer that stands for 1 in a normalised type; the smallest signed integer is clamped to −1. */
const NORMALISED: Readonly<Record<number, number>> = { 5120: 127, 5121: 255, 5122: 32767, 5123: 65535 };

/** Numbers per element. */
export const ELEMENT_SIZE: Readonly<Record<string, number>> = {
  SCALAR: 1,
  VEC2: 2,
  VEC3: 3,
  VEC4: 4,
  MAT2: 4,
  MAT3: 9,
  MAT4: 16,
};
const MATRIX_EDGE: Readonly<Record<string, number>> = { MAT2: 2, MAT3: 3, MAT4: 4 };

/**
 * Converts numbers with `own` per element to floats with `size` per element: decodes normalised integers (glTF 2.0,
 * 3.6.2.2) and fills missing components with 1. Always a copy.
 */
export function toFloats(
  numbers: Numbers,
  componentType: number,
  normalized: boolean,
  own: number,
  size: number,
): Float32Array<ArrayBuffer> {
  if (own === size && !normalized) return new Float32Array(numbers);
  const count = numbers.length / own;
  const floats = new Float32Array(count * size);
  const one = normalized ? NORMALISED[componentType] : undefined;
  const shared = Math.min(own, size);
  for (let i = 0, from = 0, to = 0; i < count; i++, from += own, to += size) {
    for (let k = 0; k < shared; k++) {
      const value = numbers[from + k] as number;
      floats[to + k] = one === undefined ? value : Math.max(value / one, -1);
    }
    for (let k = shared; k < size; k++) floats[to + k] = 1;
  }
  return floats;
}

/** Reads accessors of a checked document: all of their bytes exist. */
export class Accessors {
  readonly #list: readonly GltfAccessor[];
  readonly #strides: readonly (number | undefined)[];
  readonly #viewBytes: (index: number) => Uint8Array<ArrayBuffer>;
  readonly #budget: Budget;

  constructor(json: GltfJson, viewBytes: (index: number) => Uint8Array<ArrayBuffer>, budget: Budget) {
    this.#list = json.accessors ?? [];
    this.#strides = (json.bufferViews ?? []).map(({ byteStride }) => byteStride);
    this.#viewBytes = viewBytes;
    this.#budget = budget;
  }

  /** The accessor in the document. */
  at(index: number): GltfAccessor {
    return this.#list[index] as GltfAccessor;
  }

  /** The elements as `size` floats each (default: as stored), decoded if normalised. A copy. */
  floats(index: number, size?: number): Float32Array<ArrayBuffer> {
    const { type, count, componentType, normalized = false } = this.at(index);
    const own = ELEMENT_SIZE[type] as number;
    this.#budget.take(4 * count * (size ?? own), `/accessors/${index}`);
    return toFloats(this.#numbers(index), componentType, normalized, own, size ?? own);
  }

  /** Indices as 32-bit integers. A copy. */
  indices(index: number): Uint32Array<ArrayBuffer> {
    this.#budget.take(4 * this.at(index).count, `/accessors/${index}`);
    return new Uint32Array(this.#numbers(index));
  }

  /** The numbers, tightly packed, with sparse values applied; may be a view of the file's bytes. */
  #numbers(index: number): Numbers {
    const { bufferView, byteOffset = 0, componentType, count, type, sparse } = this.at(index);
    const Type = TYPES[componentType] as NumbersType;
    const size = ELEMENT_SIZE[type] as number;
    let numbers =
      bufferView === undefined ? new Type(count * size) : this.#dense(bufferView, byteOffset, Type, count, type);
    if (sparse) {
      const copy = new Type(count * size);
      copy.set(numbers);
      numbers = copy;
      const at = this.#dense(
        sparse.indices.bufferView,
        sparse.indices.byteOffset ?? 0,
        TYPES[sparse.indices.componentType] as NumbersType,
        sparse.count,
        'SCALAR',
        false,
      );
      const values = this.#dense(
        sparse.values.bufferView,
        sparse.values.byteOffset ?? 0,
        Type,
        sparse.count,
        type,
        false,
      );
      for (let i = 0; i < sparse.count; i++)
        copy.set(values.subarray(size * i, size * i + size), size * (at[i] as number));
    }
    return numbers;
  }

  #dense(view: number, byteOffset: number, Type: NumbersType, count: number, type: string, strided = true): Numbers {
    const bytes = this.#viewBytes(view);
    const size = ELEMENT_SIZE[type] as number;
    const bytesPer = Type.BYTES_PER_ELEMENT;
    const edge = MATRIX_EDGE[type];
    // Columns of matrices start at multiples of 4 bytes.
    const column = edge === undefined ? size * bytesPer : Math.ceil((edge * bytesPer) / 4) * 4;
    const element = edge === undefined ? column : column * edge;
    const stride = (strided ? this.#strides[view] : undefined) ?? element;
    const start = bytes.byteOffset + byteOffset;
    if (stride === size * bytesPer && element === stride) {
      if (start % bytesPer === 0) return new Type(bytes.buffer, start, count * size);
      const copy = new Type(count * size);
      new Uint8Array(copy.buffer).set(bytes.subarray(byteOffset, byteOffset + count * element));
      return copy;
    }
    const copy = new Type(count * size);
    if (element === size * bytesPer && start % bytesPer === 0 && stride % bytesPer === 0) {
      const step = stride / bytesPer;
      const from = new Type(bytes.buffer, start, step * (count - 1) + size);
      for (let i = 0; i < count; i++) for (let k = 0; k < size; k++) copy[size * i + k] = from[step * i + k] as number;
      return copy;
    }
    const target = new Uint8Array(copy.buffer);
    const columns = edge ?? 1,
      used = (size / columns) * bytesPer;
    for (let i = 0; i < count; i++) {
      for (let c = 0; c < columns; c++) {
        const from = byteOffset + stride * i + column * c;
        target.set(bytes.subarray(from, from + used), (size * i + (size / columns) * c) * bytesPer);
      }
    }
    return copy;
  }
}
