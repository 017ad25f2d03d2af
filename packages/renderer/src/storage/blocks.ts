import { wgslModule, type StructField, type WgslModule } from '@glanz/wgsl';

/** Records of a block. As many as a workgroup has threads. */
export const BLOCK = 64;

/** Fields of records that lie in blocks: the types of the words they are made of. */
export type BlockFields = Readonly<
  Record<string, 'f32' | 'u32' | 'vec3f' | 'vec4f' | 'vec2u' | 'vec4u' | readonly ['vec4f', number]>
>;

/** Records in a storage buffer, laid out for workgroups. */
export interface BlockLayout {
  /** WGSL name of the block's struct; the buffer is an array of it. */
  readonly block: string;
  /** Bytes of a record. */
  readonly size: number;
  /**
   * The struct, and for every field `fn <prefix>_<field>(index: u32) -> T` and
   * `fn <prefix>_set_<field>(index: u32, value: T)`; for a field of several vec4f, both have the number of the vec4f
   * after the index. With a record struct also `fn <prefix>_load(index: u32) -> Record` and
   * `fn <prefix>_store(index: u32, record: Record)`.
   */
  readonly module: WgslModule;
  /** Bytes that a buffer for so many records needs. */
  bytes(count: number): number;
}

const WORDS = { f32: 1, u32: 1, vec3f: 3, vec4f: 4, vec2u: 2, vec4u: 4 } as const;

/**
 * Lays records out in blocks of {@link BLOCK}: within a block, one field of all records after another, a vec3f as three
 * numbers. Neighbouring threads then read and write neighbouring words, in whole lines of memory. Records one after
 * another make each of their stores touch as many lines as there are threads: on an H200, starting four million paths
 * of 80 bytes takes 0.75 ms that way, and 0.07 ms in blocks.
 *
 * @param name WGSL name of a record; the block is called so too, with "Block" behind.
 * @param prefix Of the accessors, without the underscore.
 * @param buffer The variable of type `array<‹name›Block>`.
 * @param record A struct of the same fields, for whole records.
 */
export function blockLayout(
  name: string,
  prefix: string,
  buffer: string,
  fields: BlockFields,
  record?: { readonly fields: readonly StructField[]; readonly module: WgslModule },
): BlockLayout {
  const members: string[] = [];
  const accessors: string[] = [];
  const place = (member: string, lane = 'index & 63u') => `${buffer}[index >> 6u].${member}[${lane}]`;
  let size = 0;
  for (const [field, type] of Object.entries(fields)) {
    if (typeof type !== 'string') {
      const lane = `${BLOCK}u * part + (index & 63u)`;
      members.push(`${field}: array<vec4f, ${BLOCK * type[1]}>`);
      accessors.push(
        `fn ${prefix}_${field}(index: u32, part: u32) -> vec4f { return ${place(field, lane)}; }`,
        `fn ${prefix}_set_${field}(index: u32, part: u32, value: vec4f) { ${place(field, lane)} = value; }`,
      );
      size += 16 * type[1];
      continue;
    }
    size += 4 * WORDS[type];
    if (type === 'vec3f') {
      const parts = ['x', 'y', 'z'];
      members.push(...parts.map((part) => `${field}_${part}: array<f32, ${BLOCK}>`));
      accessors.push(
        `fn ${prefix}_${field}(index: u32) -> vec3f { return vec3f(${parts.map((part) => place(`${field}_${part}`)).join(', ')}); }`,
        `fn ${prefix}_set_${field}(index: u32, value: vec3f) { ${parts.map((part) => `${place(`${field}_${part}`)} = value.${part};`).join(' ')} }`,
      );
    } else {
      members.push(`${field}: array<${type}, ${BLOCK}>`);
      accessors.push(
        `fn ${prefix}_${field}(index: u32) -> ${type} { return ${place(field)}; }`,
        `fn ${prefix}_set_${field}(index: u32, value: ${type}) { ${place(field)} = value; }`,
      );
    }
  }
  if (record) {
    accessors.push(
      `fn ${prefix}_load(index: u32) -> ${name} { return ${name}(${record.fields.map((field) => `${prefix}_${field.name}(index)`).join(', ')}); }`,
      `fn ${prefix}_store(index: u32, record: ${name}) { ${record.fields.map((field) => `${prefix}_set_${field.name}(index, record.${field.name});`).join(' ')} }`,
    );
  }
  const block = `${name}Block`;
  const module = wgslModule(
    `renderer/${prefix}-block`,
    `struct ${block} {\n  ${members.join(',\n  ')},\n}\n${accessors.join('\n')}\n`,
    record ? [record.module] : [],
  );
  return { block, size, module, bytes: (count) => Math.ceil(count / BLOCK) * BLOCK * size };
}
