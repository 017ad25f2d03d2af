import { GlanzError } from './error';
import { wgslModule, type WgslModule } from './module';

/**
 * Thrown by {@link struct} and by writers. Codes:
 *
 * - `wgsl/unknown-field`: the struct has no field of this name. Use one that the message lists.
 * - `wgsl/field-length`: a field got too few or too many numbers. Pass as many as the message says.
 * - `wgsl/field-type`: the type of a field is not known. Use one that the message lists.
 * - `wgsl/empty-struct`: the struct has no fields. Give it one.
 * - `wgsl/out-of-range`: an index is outside of the buffer. Pass a larger buffer, or a smaller index.
 */
export class StructError extends GlanzError {}

/** Field types of a host-shareable struct: scalars, vectors, a matrix, other structs, and arrays of them. */
export type WgslFieldType =
  | StructLayout
  | 'f32'
  | 'u32'
  | 'i32'
  | 'vec2f'
  | 'vec3f'
  | 'vec4f'
  | 'vec2u'
  | 'vec3u'
  | 'vec4u'
  | 'mat4x4f'
  | readonly [element: WgslFieldType, count: number];

/** Type of a 32-bit word. */
type Word = 'f' | 'u' | 'i';

interface TypeLayout {
  readonly align: number;
  readonly size: number;
  readonly text: string;
  /** How to write the numbers of a value; `undefined` for nested structs, which are given as bytes. */
  readonly numbers: { readonly word: Word; readonly offsets: readonly number[] } | undefined;
  /** The nested structs. */
  readonly structs: readonly WgslModule[];
}

/** Alignment, size and kind of word; only a vec3's differ, 16 and 12. */
const BASIC: Readonly<Record<string, readonly [align: number, size: number, word: Word]>> = {
  f32: [4, 4, 'f'],
  u32: [4, 4, 'u'],
  i32: [4, 4, 'i'],
  vec2f: [8, 8, 'f'],
  vec3f: [16, 12, 'f'],
  vec4f: [16, 16, 'f'],
  vec2u: [8, 8, 'u'],
  vec3u: [16, 12, 'u'],
  vec4u: [16, 16, 'u'],
  mat4x4f: [16, 64, 'f'],
};

const roundUp = (value: number, to: number) => Math.ceil(value / to) * to;

function layoutOf(type: WgslFieldType, field: string): TypeLayout {
  if (typeof type === 'string') {
    const basic = Object.hasOwn(BASIC, type) ? BASIC[type] : undefined;
    if (!basic)
      throw new StructError(
        'wgsl/field-type',
        `Field "${field}" has the type "${String(type)}"; known: ${Object.keys(BASIC).join(', ')}, structs, and [type, count].`,
      );
    const [align, size, word] = basic;
    return {
      align,
      size,
      text: type,
      numbers: { word, offsets: Array.from({ length: size / 4 }, (_, i) => i * 4) },
      structs: [],
    };
  }
  if ('module' in type)
    return { align: type.align, size: type.size, text: type.name, numbers: undefined, structs: [type.module] };
  const [elementType, count] = type;
  if (!Number.isInteger(count) || count < 1)
    throw new StructError(
      'wgsl/field-type',
      `Field "${field}" is an array of ${count} elements; it needs a whole number from 1 up.`,
    );
  const element = layoutOf(elementType, field);
  const stride = roundUp(element.size, element.align);
  const { numbers } = element;
  return {
    align: element.align,
    size: stride * count,
    text: `array<${element.text}, ${count}>`,
    numbers: numbers && {
      word: numbers.word,
      offsets: Array.from({ length: count }, (_, i) => numbers.offsets.map((offset) => i * stride + offset)).flat(),
    },
    structs: element.structs,
  };
}

/** One field of a {@link StructLayout}. */
export interface StructField {
  /** Name in WGSL. */
  readonly name: string;
  /** Byte offset from the start of the struct, as WGSL lays it out. */
  readonly offset: number;
  /** Size in bytes. */
  readonly size: number;
  /** WGSL type text. */
  readonly type: string;
}

/**
 * The value of a field as the writer takes it. Arrays are given flat, without padding, matrices column-major. A
 * nested struct, or an array of them, is given as its packed bytes, e.g. from its own `allocate()` and `write()`.
 */
export type StructValue = number | ArrayLike<number> | ArrayBuffer;

/** The layout of one GPU struct: its WGSL text and its TypeScript packing come from the same table. */
export interface StructLayout<Name extends string = string> {
  /** Name in WGSL. */
  readonly name: string;
  /** Alignment in bytes. */
  readonly align: number;
  /** Size in bytes, rounded up to the alignment: the stride in an array. */
  readonly size: number;
  /** The fields in order. */
  readonly fields: readonly StructField[];
  /** The struct's declaration as a module that shader modules depend on. */
  readonly module: WgslModule;
  /** Byte offset of a field. @throws {StructError} `wgsl/unknown-field` */
  offsetOf(field: Name): number;
  /** An all-zero buffer for `count` structs (default 1). */
  allocate(count?: number): ArrayBuffer;
  /**
   * Writes the given fields of the struct at `index`; fields not named keep their bytes.
   * @throws {StructError} `wgsl/unknown-field`, `wgsl/field-length`, `wgsl/field-type`, `wgsl/out-of-range`
   */
  write(buffer: ArrayBuffer, index: number, values: Partial<Record<Name, StructValue>>): void;
}

/**
 * Describes a host-shareable struct once. Offsets follow WGSL's rules (vec3 aligns to 16, arrays have padded strides).
 * They are those of storage buffers; uniform buffers require more of arrays and nested structs (multiples of 16 bytes),
 * which the shader compiler checks.
 *
 * @param name WGSL name of the struct.
 * @param fields Field names and types, in order.
 * @param gates Flags of fields that only programs with the flag declare: the last ones, within the struct's padding.
 * @throws {StructError} `wgsl/empty-struct`, `wgsl/field-type`
 * @example
 * const Frame = struct('Frame', { size: 'vec2u', sample: 'u32', exposure: 'f32' });
 * const bytes = Frame.allocate();
 * Frame.write(bytes, 0, { size: [640, 480], exposure: 1 });
 */
export function struct<const Fields extends Readonly<Record<string, WgslFieldType>>>(
  name: string,
  fields: Fields,
  gates: Partial<Record<keyof Fields, string>> = {},
): StructLayout<keyof Fields & string> {
  const table = new Map<string, StructField & { readonly layout: TypeLayout }>();
  let end = 0;
  let align = 4;
  for (const [field, type] of Object.entries(fields)) {
    const layout = layoutOf(type, `${name}.${field}`);
    const offset = roundUp(end, layout.align);
    table.set(field, { name: field, offset, size: layout.size, type: layout.text, layout });
    end = offset + layout.size;
    align = Math.max(align, layout.align);
  }
  if (table.size === 0) throw new StructError('wgsl/empty-struct', `Struct "${name}" has no fields.`);
  const size = roundUp(end, align);
  const all = [...table.values()];
  const find = (field: string) => {
    const found = table.get(field);
    if (!found)
      throw new StructError(
        'wgsl/unknown-field',
        `Struct "${name}" has no field "${field}". Fields: ${[...table.keys()].join(', ')}.`,
      );
    return found;
  };
  return {
    name,
    align,
    size,
    fields: all.map(({ layout: _layout, ...field }) => field),
    module: wgslModule(
      `struct/${name}`,
      `struct ${name} {\n${all
        .map((field) => {
          const member = `  ${field.name}: ${field.type},`;
          const flag = gates[field.name];
          return flag === undefined ? member : `//#if ${flag}\n${member}\n//#endif`;
        })
        .join('\n')}\n}`,
      [...new Set(all.flatMap(({ layout }) => layout.structs))],
    ),
    offsetOf: (field) => find(field).offset,
    allocate: (count = 1) => new ArrayBuffer(size * count),
    write(buffer, index, values) {
      if (!Number.isInteger(index) || index < 0 || (index + 1) * size > buffer.byteLength) {
        throw new StructError(
          'wgsl/out-of-range',
          `Struct "${name}" at index ${index} is outside of a buffer of ${Math.floor(buffer.byteLength / size)}.`,
        );
      }
      const view = new DataView(buffer, index * size, size);
      for (const [field, value] of Object.entries(values) as [string, StructValue | undefined][]) {
        if (value === undefined) continue;
        const { layout, offset, size: bytes } = find(field);
        if (value instanceof ArrayBuffer) {
          if (value.byteLength !== bytes)
            throw new StructError(
              'wgsl/field-length',
              `Field "${name}.${field}" takes ${bytes} bytes, got ${value.byteLength}.`,
            );
          new Uint8Array(buffer, index * size + offset, bytes).set(new Uint8Array(value));
          continue;
        }
        const { numbers } = layout;
        if (!numbers)
          throw new StructError(
            'wgsl/field-type',
            `Field "${name}.${field}" is a ${layout.text}: give its ${bytes} bytes as an ArrayBuffer.`,
          );
        const given = typeof value === 'number' ? 1 : value.length;
        if (given !== numbers.offsets.length)
          throw new StructError(
            'wgsl/field-length',
            `Field "${name}.${field}" takes ${numbers.offsets.length} numbers, got ${given}.`,
          );
        for (const [i, at] of numbers.offsets.entries()) {
          const number = typeof value === 'number' ? value : (value[i] as number);
          if (numbers.word === 'f') view.setFloat32(offset + at, number, true);
          else if (numbers.word === 'u') view.setUint32(offset + at, number, true);
          else view.setInt32(offset + at, number, true);
        }
      }
    },
  };
}
