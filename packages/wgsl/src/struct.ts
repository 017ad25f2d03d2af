import { GlanzError } from './error';
import { wgslModule, type WgslModule } from './module';

/** Thrown by {@link struct} and by writers. Codes: `wgsl/unknown-field`, `wgsl/field-length`, `wgsl/empty-struct`. */
export class StructError extends GlanzError {}

/** The types a host-shareable struct may hold: scalars, vectors, a matrix, other structs, and arrays of them. */
export type WgslFieldType = StructLayout | 'f32' | 'u32' | 'i32' | 'vec2f' | 'vec3f' | 'vec4f' | 'vec2u' | 'vec3u' | 'vec4u' | 'mat4x4f' | readonly [element: WgslFieldType, count: number];

interface TypeLayout {
  readonly align: number;
  readonly size: number;
  readonly words: number;
  readonly integer: 'f' | 'u' | 'i';
  readonly text: string;
}

const BASIC: Record<string, TypeLayout> = {
  f32: { align: 4, size: 4, words: 1, integer: 'f', text: 'f32' },
  u32: { align: 4, size: 4, words: 1, integer: 'u', text: 'u32' },
  i32: { align: 4, size: 4, words: 1, integer: 'i', text: 'i32' },
  vec2f: { align: 8, size: 8, words: 2, integer: 'f', text: 'vec2f' },
  vec3f: { align: 16, size: 12, words: 3, integer: 'f', text: 'vec3f' },
  vec4f: { align: 16, size: 16, words: 4, integer: 'f', text: 'vec4f' },
  vec2u: { align: 8, size: 8, words: 2, integer: 'u', text: 'vec2u' },
  vec3u: { align: 16, size: 12, words: 3, integer: 'u', text: 'vec3u' },
  vec4u: { align: 16, size: 16, words: 4, integer: 'u', text: 'vec4u' },
  mat4x4f: { align: 16, size: 64, words: 16, integer: 'f', text: 'mat4x4f' },
};

const roundUp = (value: number, to: number) => Math.ceil(value / to) * to;

function layoutOf(type: WgslFieldType): TypeLayout & { readonly stride?: number } {
  if (typeof type === 'string') return BASIC[type] as TypeLayout;
  if ('module' in type) return { align: type.align, size: type.size, words: type.size / 4, integer: 'f', text: type.name };
  const element = layoutOf(type[0]);
  const stride = roundUp(element.size, element.align);
  return { align: element.align, size: stride * type[1], words: element.words, integer: element.integer, text: `array<${element.text}, ${type[1]}>`, stride };
}

/** One field of a {@link StructLayout}. */
export interface StructField {
  readonly name: string;
  /** Byte offset from the start of the struct, as WGSL lays it out. */
  readonly offset: number;
  /** Size in bytes. */
  readonly size: number;
  /** WGSL type text. */
  readonly type: string;
}

/** The value of a field as the writer takes it. Arrays are given flat, without padding; a nested struct as its packed bytes. */
export type StructValue = number | ArrayLike<number> | ArrayBuffer;

/** The layout of one GPU struct: its WGSL text and its TypeScript packing come from the same table. */
export interface StructLayout<Name extends string = string> {
  readonly name: string;
  /** Alignment in bytes. */
  readonly align: number;
  /** Size in bytes, rounded up to the alignment: the stride in an array. */
  readonly size: number;
  readonly fields: readonly StructField[];
  /** The struct's declaration as a module that shader modules depend on. */
  readonly module: WgslModule;
  /** Byte offset of a field. @throws {StructError} `wgsl/unknown-field` */
  offsetOf(field: Name): number;
  /** An all-zero buffer for `count` structs. */
  allocate(count?: number): ArrayBuffer;
  /**
   * Writes the given fields of the struct at `index`; fields not named keep their bytes.
   * @throws {StructError} `wgsl/unknown-field`, `wgsl/field-length`
   */
  write(buffer: ArrayBuffer, index: number, values: Partial<Record<Name, StructValue>>): void;
}

/**
 * Describes a host-shareable struct once. Offsets follow WGSL's rules (vec3 aligns to 16, arrays have padded strides).
 *
 * @param name WGSL name of the struct.
 * @param fields Field names and types, in order.
 * @example
 * const Frame = struct('Frame', { size: 'vec2u', sample: 'u32', exposure: 'f32' });
 * const bytes = Frame.allocate();
 * Frame.write(bytes, 0, { size: [640, 480], exposure: 1 });
 */
export function struct<const Fields extends Readonly<Record<string, WgslFieldType>>>(name: string, fields: Fields): StructLayout<keyof Fields & string> {
  const entries = Object.entries(fields);
  if (entries.length === 0) throw new StructError('wgsl/empty-struct', `Struct "${name}" has no fields.`);
  let offset = 0;
  let align = 4;
  const nested: WgslModule[] = [];
  const table = new Map<string, StructField & { readonly layout: ReturnType<typeof layoutOf>; readonly count: number }>();
  for (const [field, type] of entries) {
    const layout = layoutOf(type);
    offset = roundUp(offset, layout.align);
    if (typeof type !== 'string' && 'module' in type) nested.push(type.module);
    table.set(field, { name: field, offset, size: layout.size, type: layout.text, layout, count: typeof type === 'string' || 'module' in type ? 1 : type[1] });
    offset += layout.size;
    align = Math.max(align, layout.align);
  }
  const size = roundUp(offset, align);
  const text = `struct ${name} {\n${[...table.values()].map((f) => `  ${f.name}: ${f.type},`).join('\n')}\n}`;
  const find = (field: string) => {
    const found = table.get(field);
    if (!found) throw new StructError('wgsl/unknown-field', `Struct "${name}" has no field "${field}". Fields: ${[...table.keys()].join(', ')}.`);
    return found;
  };
  return {
    name,
    align,
    size,
    fields: [...table.values()].map(({ name: fieldName, offset: at, size: bytes, type }) => ({ name: fieldName, offset: at, size: bytes, type })),
    module: wgslModule(`struct/${name}`, text, nested),
    offsetOf: (field) => find(field).offset,
    allocate: (count = 1) => new ArrayBuffer(size * count),
    write(buffer, index, values) {
      const view = new DataView(buffer);
      for (const [field, value] of Object.entries(values) as [string, StructValue | undefined][]) {
        if (value === undefined) continue;
        const { layout, offset: at, count, size: bytes } = find(field);
        if (value instanceof ArrayBuffer) {
          if (value.byteLength !== bytes) throw new StructError('wgsl/field-length', `Field "${name}.${field}" takes ${bytes} bytes, got ${value.byteLength}.`);
          new Uint8Array(buffer, index * size + at, bytes).set(new Uint8Array(value));
          continue;
        }
        const flat = typeof value === 'number' ? [value] : value;
        if (flat.length !== layout.words * count) {
          throw new StructError('wgsl/field-length', `Field "${name}.${field}" takes ${layout.words * count} numbers, got ${flat.length}.`);
        }
        for (let i = 0; i < flat.length; i++) {
          const element = Math.floor(i / layout.words);
          const byte = index * size + at + element * (layout.stride ?? 0) + (i % layout.words) * 4;
          const number = flat[i] as number;
          if (layout.integer === 'f') view.setFloat32(byte, number, true);
          else if (layout.integer === 'u') view.setUint32(byte, number, true);
          else view.setInt32(byte, number, true);
        }
      }
    },
  };
}
