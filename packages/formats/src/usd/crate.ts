import { CrateReader } from './crate-reader';
import { valueOf, type CrateTables } from './crate-values';
import { ARCS, emptyPrim, type UsdLayer, type UsdPrim, type UsdValue } from './layer';
import { LZ4_RATIO } from './lz4';

/** How a crate file begins. */
export const CRATE_MAGIC = 'PXR-USDC';
const NEWEST = 13;
const TERMINATOR = -1;
const ATTRIBUTE = 1;
const PRIM = 6;
const PSEUDO_ROOT = 7;
const RELATIONSHIP = 8;

/** A tree of paths in depth-first order: a jump to the next sibling, 0, −1 for a child alone, −2 for neither. */
function readPaths(reader: CrateReader, tokens: readonly string[]): (string | undefined)[] {
  const paths = Array.from<string | undefined>({ length: reader.packedCount() });
  const count = reader.packedCount();
  const indices = reader.integers(count);
  const elements = reader.integers(count);
  const jumps = reader.integers(count);
  const stack: { at: number; parent: string | undefined }[] = [{ at: 0, parent: undefined }];
  const seen = new Uint8Array(count);
  for (let entry = stack.pop(); entry; entry = stack.pop()) {
    let { at, parent } = entry;
    while (at < count && seen[at] === 0) {
      seen[at] = 1;
      const element = elements[at] as number;
      const name = tokens[Math.abs(element)] ?? '';
      // Variants stand in braces right after their prim.
      const path =
        parent === undefined
          ? '/'
          : element < 0
            ? `${parent}.${name}`
            : `${parent === '/' ? '' : parent}${name.startsWith('{') ? '' : '/'}${name}`;
      paths[indices[at] as number] = path;
      const jump = jumps[at] as number;
      if (jump > 0) stack.push({ at: at + jump, parent });
      if (jump > 0 || jump === -1) parent = path;
      else if (jump !== 0) break;
      at++;
    }
  }
  return paths;
}

interface Section {
  readonly start: number;
  readonly size: number;
}

/** The name of a section or a file's mark, which ends at its first zero. */
const label = (bytes: Uint8Array) => String.fromCharCode(...bytes).replace(/\0.*$/s, '');

/**
 * Reads a crate file (`.usdc`), the binary form of USD, of versions 0.4 to 0.13: the format of OpenUSD's `crateFile.h`.
 *
 * @throws {RangeError} if it is cut off or of a version that is not known.
 */
export function readCrate(bytes: Uint8Array): UsdLayer {
  const reader = new CrateReader(bytes);
  if (label(reader.bytes(8)) !== CRATE_MAGIC) throw new RangeError('it is not a crate file');
  const [major = 0, version = 0] = reader.bytes(8);
  if (major !== 0 || version < 4 || version > NEWEST)
    throw new RangeError(`it is of the version ${major}.${version}; 0.4 to 0.${NEWEST} are read`);
  reader.at = reader.i64();
  const sections = new Map<string, Section>();
  for (let i = reader.count(32); i > 0; i--)
    sections.set(label(reader.bytes(16)), { start: reader.i64(), size: reader.i64() });
  const open = (name: string): CrateReader => {
    const section = sections.get(name);
    if (!section) throw new RangeError(`its section ${name} is missing`);
    reader.at = section.start;
    return reader;
  };

  open('TOKENS');
  const names = reader.packedCount();
  const unpackedSize = reader.i64();
  if (!(unpackedSize >= 0 && unpackedSize <= LZ4_RATIO * reader.length)) throw new RangeError('its tokens do not fit');
  const tokens = new TextDecoder().decode(reader.packed(unpackedSize)).split('\0').slice(0, names);
  open('STRINGS');
  const strings = Array.from({ length: reader.count(4) }, () => reader.u32());
  open('FIELDS');
  const fields = reader.packedCount();
  const fieldTokens = reader.integers(fields);
  const fieldValues = reader.packed(8 * fields);
  open('FIELDSETS');
  const fieldSets = reader.integers(reader.packedCount());
  open('PATHS');
  const paths = readPaths(reader, tokens);
  open('SPECS');
  const specs = reader.packedCount();
  const specPaths = reader.integers(specs);
  const specSets = reader.integers(specs);
  const specTypes = reader.integers(specs);

  const tables: CrateTables = { tokens, strings, paths, version };
  const values = new DataView(fieldValues.buffer, fieldValues.byteOffset, fieldValues.byteLength);
  // Equal values lie in a file once, and so do equal sets of fields: neither is read twice.
  const known = new Map<bigint, UsdValue | undefined>();
  const read = (bits: bigint) => {
    if (!known.has(bits)) known.set(bits, valueOf(reader, bits, tables));
    return known.get(bits);
  };
  const knownSets = new Map<number, Map<string, UsdValue | undefined>>();
  let left = fieldSets.length;
  const fieldsOf = (set: number) => {
    const before = knownSets.get(set);
    if (before) return before;
    const found = new Map<string, UsdValue | undefined>();
    knownSets.set(set, found);
    for (let i = set; i < fieldSets.length && fieldSets[i] !== TERMINATOR; i++) {
      const field = fieldSets[i] as number;
      if (left-- <= 0) throw new RangeError('its sets of fields overlap');
      const name = tokens[fieldTokens[field] ?? -1];
      if (name !== undefined) found.set(name, read(values.getBigUint64(8 * field, true)));
    }
    return found;
  };
  return assemble(
    Array.from({ length: specs }, (_, i) => ({
      path: paths[specPaths[i] as number] ?? '',
      type: specTypes[i] as number,
      set: specSets[i] as number,
    })),
    fieldsOf,
  );
}

const isText = (value: unknown): value is string => typeof value === 'string';
const textsOf = (value: UsdValue | undefined): string[] => (Array.isArray(value) ? value.filter(isText) : []);

/** Prims with their properties, out of the specs of all paths; those within variants are left out. */
function assemble(
  specs: readonly { readonly path: string; readonly type: number; readonly set: number }[],
  fieldsOf: (set: number) => ReadonlyMap<string, UsdValue | undefined>,
): UsdLayer {
  const prims = new Map<string, { prim: UsdPrim; order: readonly string[] }>();
  let stage: ReadonlyMap<string, UsdValue | undefined> = new Map();
  for (const { path, type, set } of specs) {
    if ((type !== PRIM && type !== PSEUDO_ROOT) || path.includes('{')) continue;
    const fields = fieldsOf(set);
    if (type === PSEUDO_ROOT) stage = fields;
    const prim = emptyPrim(path, path.slice(path.lastIndexOf('/') + 1));
    const typeName = fields.get('typeName');
    if (isText(typeName)) prim.type = typeName;
    prim.defined = type === PSEUDO_ROOT || fields.get('specifier') === 0;
    prim.active = fields.get('active') !== false;
    for (const arc of ARCS) if (fields.has(arc)) prim.arcs.add(arc);
    prims.set(path, { prim, order: textsOf(fields.get('primChildren')) });
  }
  for (const { path, type, set } of specs) {
    const dot = path.lastIndexOf('.');
    const owner = dot < 0 ? undefined : prims.get(path.slice(0, dot))?.prim;
    if (!owner || (type !== ATTRIBUTE && type !== RELATIONSHIP)) continue;
    const fields = fieldsOf(set);
    const name = path.slice(dot + 1);
    if (type === RELATIONSHIP) owner.relationships.set(name, textsOf(fields.get('targetPaths')));
    else {
      const [typeName, interpolation] = [fields.get('typeName'), fields.get('interpolation')];
      owner.attributes.set(name, {
        type: isText(typeName) ? typeName : '',
        value: fields.get('default') ?? fields.get('timeSamples'),
        connections: textsOf(fields.get('connectionPaths')),
        interpolation: isText(interpolation) ? interpolation : undefined,
      });
    }
  }
  // A tree: no prim is a child twice, nor of itself.
  const placed = new Set(['/']);
  for (const [path, { prim, order }] of prims)
    for (const name of order) {
      const below = path === '/' ? `/${name}` : `${path}/${name}`;
      const child = prims.get(below)?.prim;
      if (!child || placed.has(below)) continue;
      placed.add(below);
      prim.children.push(child);
    }
  const [up, metres, start] = ['upAxis', 'metersPerUnit', 'defaultPrim'].map((name) => stage.get(name));
  return {
    root: prims.get('/')?.prim ?? emptyPrim('/', ''),
    upAxis: isText(up) ? up : undefined,
    metersPerUnit: typeof metres === 'number' ? metres : undefined,
    defaultPrim: isText(start) ? start : undefined,
    subLayers: stage.has('subLayers'),
  };
}
