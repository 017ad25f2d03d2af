import { dataUri } from '../uri';
import type { CheckContext } from './context';
import { own, quote, type Raw } from '../json-value';

const MAX = Number.MAX_SAFE_INTEGER;

/** Types that a buffer's data: uri may have (glTF 2.0, 3.6.1.1). */
const BUFFER_TYPES: readonly string[] = ['application/octet-stream', 'application/gltf-buffer'];

/** Bytes of one component, by glTF's number for its type. */
const COMPONENT_BYTES: Readonly<Record<number, number>> = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 };

/** Rows and columns by type. */
const SHAPES: ReadonlyMap<unknown, readonly [number, number]> = new Map([
  ['SCALAR', [1, 1]],
  ['VEC2', [2, 1]],
  ['VEC3', [3, 1]],
  ['VEC4', [4, 1]],
  ['MAT2', [2, 2]],
  ['MAT3', [3, 3]],
  ['MAT4', [4, 4]],
]);

/**
 * Max bytes of accessors without a buffer view (zeros, perhaps with sparse values), all together. A few hundred bytes
 * of JSON could request terabytes.
 */
export const ZERO_FILL_LIMIT = 1 << 28;

/** Max compression ratio of meshopt: a control of 2 bits for 256 bytes. */
const MESHOPT_RATIO = 1024;

/** An accessor that has been checked. Only of such ones the bytes may be read. */
export interface AccessorFacts {
  readonly componentType: number;
  readonly type: string;
  readonly normalized: boolean;
  readonly count: number;
}

/** How elements of an accessor lie in a buffer view. */
interface ElementLayout {
  /** Bytes from one element to the next where the buffer view has no stride. */
  readonly step: number;
  /** Bytes up to the end of the last component: what the last element must have. */
  readonly used: number;
  /** Bytes of a component, of which each element starts at a multiple. */
  readonly alignment: number;
}

/** Columns of matrices start at multiples of 4 bytes (glTF 2.0, 3.6.2.4); nothing is read after the last one. */
function layoutOf(type: unknown, componentType: number): ElementLayout {
  const [rows, columns] = SHAPES.get(type) as readonly [number, number];
  const alignment = COMPONENT_BYTES[componentType] as number;
  const column = rows * alignment;
  const padded = columns === 1 ? column : Math.ceil(column / 4) * 4;
  return { step: padded * columns, used: padded * (columns - 1) + column, alignment };
}

/** Checks buffers and buffer views: whole numbers, and each view within its buffer. Returns the views. */
export function checkBuffers(context: CheckContext): readonly Raw[] {
  const buffers = context.list('buffers');
  buffers.forEach((buffer, index) => {
    const path = `/buffers/${index}`;
    context.integer(buffer, 'byteLength', path, 1, MAX);
    const uri = own(buffer, 'uri');
    if (uri !== undefined && typeof uri !== 'string')
      context.fail(`${path}/uri`, `is ${quote(uri)}, but must be a text`);
    const data = typeof uri === 'string' ? dataUri(uri) : undefined;
    if (data && !(data.base64 && BUFFER_TYPES.includes(data.type))) {
      const what = `${data.base64 ? 'base64' : 'text'} of the type "${data.type}"`;
      context.warn(
        'gltf/data',
        `${path}/uri`,
        `is a data: uri of ${what}, but must be base64 of ${BUFFER_TYPES.join(' or ')}; it is read anyway`,
      );
    }
  });
  const within = (view: Raw, path: string): number => {
    const buffer = buffers[context.integer(view, 'buffer', path, 0, buffers.length - 1)] as Raw;
    const offset = context.integer(view, 'byteOffset', path, 0, MAX, 0);
    const length = context.integer(view, 'byteLength', path, 1, MAX);
    if (offset + length > (buffer['byteLength'] as number))
      context.fail(path, `reaches to byte ${offset + length}, but its buffer has ${buffer['byteLength']}`);
    return length;
  };
  const views = context.list('bufferViews');
  views.forEach((view, index) => {
    const path = `/bufferViews/${index}`;
    const length = within(view, path);
    const stride = context.integer(view, 'byteStride', path, 4, 252, 4);
    const target = own(view, 'target');
    if (target !== undefined && target !== 34962 && target !== 34963)
      context.warn('gltf/data', `${path}/target`, `is ${quote(target)}, which is not a kind of data`);
    if (stride % 4 !== 0) context.fail(`${path}/byteStride`, 'must be a multiple of 4');
    if (own(view, 'byteStride') !== undefined && (stride > length || target === 34963))
      context.warn(
        'gltf/data',
        `${path}/byteStride`,
        `is ${stride} in a view of ${stride > length ? `${length} bytes` : 'indices, which have none'}`,
      );
    for (const name of ['EXT_meshopt_compression', 'KHR_meshopt_compression']) {
      const packed = context.extension(view, name, path);
      if (!packed) continue;
      const at = `${path}/extensions/${name}`;
      within(packed, at);
      const step = context.integer(packed, 'byteStride', at, 1, 256);
      const count = context.integer(packed, 'count', at, 1, MAX);
      if (step * count > length)
        context.fail(at, `unpacks to ${step * count} bytes, but its buffer view has ${length}`);
      if (length > MESHOPT_RATIO * ((packed['byteLength'] as number) + 16))
        context.fail(
          at,
          `says that ${packed['byteLength']} bytes unpack to ${length}, which is more than the format can do`,
        );
    }
  });
  return views;
}

/** Checks accessors: known types, and every byte they read within their views. */
export function checkAccessors(
  context: CheckContext,
  views: readonly Raw[],
  needed: ReadonlySet<number>,
): readonly (AccessorFacts | undefined)[] {
  let zeroFilled = 0;
  return context.list('accessors').map((accessor, index) => {
    const path = `/accessors/${index}`;
    const count = context.integer(accessor, 'count', path, 1, MAX);
    const componentType = own(accessor, 'componentType');
    const type = own(accessor, 'type');
    const known = typeof componentType === 'number' && COMPONENT_BYTES[componentType] !== undefined && SHAPES.has(type);
    if (!known) {
      // Types of later versions are accepted in accessors that are not read.
      const what = `has the type ${quote(type)} of ${quote(componentType)}, which glTF 2.0 does not know`;
      if (needed.has(index)) context.fail(path, what);
      context.warn('gltf/accessor', path, what);
      return undefined;
    }
    const layout = layoutOf(type, componentType);
    const view = context.index(accessor, 'bufferView', path, views, 'buffer view');
    const offset = context.integer(accessor, 'byteOffset', path, 0, MAX, 0);
    if (view !== undefined) checkRange(context, path, views[view] as Raw, offset, count, layout, true);
    else {
      const bytes = count * layout.step;
      zeroFilled += bytes;
      if (zeroFilled > ZERO_FILL_LIMIT)
        context.fail(
          path,
          `requests ${bytes} bytes of zeros that are not in the file; the maximum is ${ZERO_FILL_LIMIT} in total`,
        );
    }
    const sparse = context.object(accessor, 'sparse', path);
    if (sparse) checkSparse(context, `${path}/sparse`, sparse, views, count, layout);
    for (const key of ['min', 'max']) {
      const bounds = own(accessor, key);
      const [rows, columns] = SHAPES.get(type) as readonly [number, number];
      if (
        bounds !== undefined &&
        !(Array.isArray(bounds) && bounds.length === rows * columns && bounds.every((x) => typeof x === 'number'))
      )
        context.warn(
          'gltf/accessor',
          `${path}/${key}`,
          `is ${quote(bounds)}, but must be ${rows * columns} numbers; it is not used`,
        );
    }
    const normalized = own(accessor, 'normalized') ?? false;
    if (typeof normalized !== 'boolean' || (normalized && (componentType === 5125 || componentType === 5126))) {
      context.warn(
        'gltf/accessor',
        `${path}/normalized`,
        `is ${quote(normalized)} for components of ${componentType}; they are taken as they are`,
      );
    }
    return { componentType, type: type as string, normalized: normalized === true, count };
  });
}

function checkRange(
  context: CheckContext,
  path: string,
  view: Raw,
  offset: number,
  count: number,
  { step, used, alignment }: ElementLayout,
  strided: boolean,
): void {
  const stride = strided ? ((own(view, 'byteStride') as number | undefined) ?? step) : step;
  if (stride < step) context.fail(path, `has elements of ${step} bytes in a buffer view with a stride of ${stride}`);
  const start = ((own(view, 'byteOffset') as number | undefined) ?? 0) + offset;
  if (offset % alignment !== 0 || start % alignment !== 0)
    context.fail(path, `starts at byte ${start}, which is not a multiple of its components' ${alignment} bytes`);
  const end = offset + stride * (count - 1) + used;
  if (end > (view['byteLength'] as number))
    context.fail(path, `reads to byte ${end} of a buffer view of ${view['byteLength']}`);
}

function checkSparse(
  context: CheckContext,
  path: string,
  sparse: Raw,
  views: readonly Raw[],
  length: number,
  layout: ElementLayout,
): void {
  const count = context.integer(sparse, 'count', path, 1, length);
  const indices = context.object(sparse, 'indices', path) ?? context.fail(path, 'has no indices');
  const values = context.object(sparse, 'values', path) ?? context.fail(path, 'has no values');
  const indexBytes =
    { 5121: 1, 5123: 2, 5125: 4 }[own(indices, 'componentType') as number] ??
    context.fail(
      `${path}/indices/componentType`,
      `is ${quote(own(indices, 'componentType'))}, but must be 5121, 5123 or 5125`,
    );
  const index: ElementLayout = { step: indexBytes, used: indexBytes, alignment: indexBytes };
  for (const [name, part, elements] of [
    ['indices', indices, index],
    ['values', values, layout],
  ] as const) {
    const at = `${path}/${name}`;
    const view = views[context.integer(part, 'bufferView', at, 0, views.length - 1)] as Raw;
    checkRange(context, at, view, context.integer(part, 'byteOffset', at, 0, MAX, 0), count, elements, false);
    if (own(view, 'byteStride') !== undefined) {
      context.warn(
        'gltf/data',
        at,
        'lie in a buffer view with a byteStride, which sparse data must not have; they are read without gaps',
      );
    }
  }
}

/**
 * Checks the bytes of sparse indices: they must increase and name elements that exist.
 * @param viewBytes Bytes of a buffer view, checked to lie within its buffer; undefined if the buffer does not exist,
 * since nothing reads it.
 */
export function checkSparseIndices(
  context: CheckContext,
  facts: readonly (AccessorFacts | undefined)[],
  viewBytes: (index: number) => Uint8Array | undefined,
): void {
  context.list('accessors').forEach((accessor, index) => {
    const sparse = own(accessor, 'sparse') as Raw | undefined;
    if (!sparse || !facts[index]) return;
    const path = `/accessors/${index}/sparse/indices`;
    const {
      bufferView,
      byteOffset = 0,
      componentType,
    } = sparse['indices'] as { bufferView: number; byteOffset?: number; componentType: number };
    const bytes = viewBytes(bufferView);
    if (!bytes) return;
    const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    let last = -1;
    for (let i = 0; i < (sparse['count'] as number); i++) {
      const at =
        componentType === 5121
          ? data.getUint8(byteOffset + i)
          : componentType === 5123
            ? data.getUint16(byteOffset + 2 * i, true)
            : data.getUint32(byteOffset + 4 * i, true);
      if (at <= last) context.fail(path, `must grow, but ${last} is followed by ${at}`);
      if (at >= (accessor['count'] as number)) context.fail(path, `names element ${at} of ${accessor['count']}`);
      last = at;
    }
  });
}
