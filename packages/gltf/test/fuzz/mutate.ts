import { glb } from '../build';
import type { Random } from './random';

/** A document apart: JSON, and the binary chunk of a GLB. */
export interface Parts {
  readonly json: unknown;
  readonly binary?: Uint8Array<ArrayBuffer>;
}

/** Takes a sound GLB or JSON document apart. */
export function takeApart(bytes: Uint8Array<ArrayBuffer>): Parts {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const text = (part: Uint8Array) => JSON.parse(new TextDecoder().decode(part)) as unknown;
  if (view.getUint32(0, true) !== 0x46546c67) return { json: text(bytes) };
  const length = view.getUint32(12, true);
  const json = text(bytes.subarray(20, 20 + length));
  return bytes.length > 28 + length ? { json, binary: bytes.slice(28 + length) } : { json };
}

/** Values of malicious and of unusual files. */
const VALUES: readonly unknown[] = [
  null,
  true,
  false,
  0,
  -1,
  1,
  2,
  3,
  0.5,
  -0.5,
  255,
  256,
  65535,
  65536,
  2 ** 31 - 1,
  2 ** 31,
  2 ** 32 - 1,
  2 ** 32,
  2 ** 53,
  1e308,
  -1e308,
  1e-320,
  5120,
  5121,
  5123,
  5125,
  5126,
  34962,
  34963,
  '',
  'x',
  '2.0',
  '__proto__',
  'constructor',
  'toString',
  'SCALAR',
  'VEC3',
  'MAT4',
  'CUBICSPLINE',
  'data:,',
  'data:;base64,AAAA',
  '../../etc/passwd',
  'file:///etc/passwd',
  'http://127.0.0.1:9/x',
  '%00',
  'a\nb\u2028c',
  '\ud800',
  [],
  [0],
  [[]],
  [null],
  [0, 0, 0],
  [1e308, 1e308, 1e308],
  Array.from({ length: 16 }, () => 1e30),
  {},
  { index: 0 },
  { __proto__: null, extensions: {} },
  { KHR_draco_mesh_compression: { bufferView: 0, attributes: { POSITION: 0 } } },
];

const EXTENSIONS = [
  'KHR_draco_mesh_compression',
  'EXT_meshopt_compression',
  'KHR_meshopt_compression',
  'KHR_mesh_quantization',
  'EXT_mesh_gpu_instancing',
  'KHR_lights_punctual',
  'KHR_materials_variants',
  'KHR_node_visibility',
  'KHR_texture_transform',
  'KHR_texture_basisu',
  'EXT_texture_webp',
  'KHR_xmp_json_ld',
  'KHR_materials_clearcoat',
  'KHR_materials_volume',
  'NONE_such',
];

type Holder = Record<string, unknown>;

/** All places in a document: the object or array, and the key in it. */
function places(value: unknown, out: [Holder, string][] = []): [Holder, string][] {
  if (typeof value !== 'object' || value === null) return out;
  for (const key of Object.keys(value)) {
    out.push([value as Holder, key]);
    places((value as Holder)[key], out);
  }
  return out;
}

const remove = (holder: Holder, key: string) => {
  if (Array.isArray(holder)) holder.splice(Number(key), 1);
  else delete holder[key];
};

function spoilJson(json: unknown, random: Random): void {
  const all = places(json);
  if (all.length === 0) return;
  const [holder, key] = random.pick(all);
  const [other, otherKey] = random.pick(all);
  const value = holder[key];
  switch (random.below(9)) {
    case 0:
    case 1:
      holder[key] = structuredClone(random.pick(VALUES));
      break;
    case 2:
      remove(holder, key);
      break;
    case 3:
      // Numbers next to the true one: off by one, scaled, turned round.
      if (typeof value === 'number')
        holder[key] = random.pick([
          value + 1,
          value - 1,
          -value,
          value * 2,
          value * 1e6,
          value / 3,
          1 / value,
          value + 4,
          value - 4,
        ]);
      else holder[key] = structuredClone(random.pick(VALUES));
      break;
    case 4:
      holder[key] = structuredClone(other[otherKey]);
      break;
    case 5:
      // Any index may be another: siblings, one beyond.
      if (typeof value === 'number') holder[key] = random.below(Math.ceil(Math.abs(value)) + 3);
      else if (Array.isArray(value) && value.length > 0) value.push(structuredClone(random.pick(value as unknown[])));
      break;
    case 6:
      (typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as Holder) : (json as Holder))[
        'extensions'
      ] = { [random.pick(EXTENSIONS)]: structuredClone(random.below(2) ? random.pick(VALUES) : other[otherKey]) };
      break;
    case 7:
      if (Array.isArray(value)) value.length = random.below(value.length + 1);
      else if (!Array.isArray(holder))
        holder[
          random.pick([
            'uri',
            'mode',
            'sparse',
            'children',
            'extras',
            'name',
            'byteStride',
            'normalized',
            'targets',
            'matrix',
            'weights',
            '__proto__',
            'constructor',
          ])
        ] = structuredClone(random.pick(VALUES));
      break;
    default: {
      const names = random.pick(['extensionsUsed', 'extensionsRequired']);
      const named = (json as Holder)[names];
      (json as Holder)[names] = [...(Array.isArray(named) ? (named as unknown[]) : []), random.pick(EXTENSIONS)];
    }
  }
}

function spoilBytes(bytes: Uint8Array<ArrayBuffer>, random: Random): Uint8Array<ArrayBuffer> {
  const at = random.below(bytes.length);
  switch (random.below(6)) {
    case 0:
      return bytes.slice(0, at);
    case 1: {
      const longer = new Uint8Array(bytes.length + 4);
      longer.set(bytes.subarray(0, at));
      longer.set(bytes.subarray(at), at + 4);
      return longer;
    }
    case 2:
      if (bytes.length < 4) return bytes;
      new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength).setUint32(
        Math.min(at, bytes.length - 4),
        random.pick([0, 0xffffffff, 0x7fc00000, 0x7f800000, 0x80000000, random.word()]),
        true,
      );
      return bytes;
    case 3:
      bytes.copyWithin(at, random.below(bytes.length), random.below(bytes.length));
      return bytes;
    default:
      for (let i = random.below(4); i >= 0; i--)
        bytes[random.below(bytes.length)] = random.below(3) ? random.below(256) : random.pick([0, 255, 127, 128]);
      return bytes;
  }
}

/** A document with one to four faults, in its JSON, its data or its container. */
export function mutate({ json, binary }: Parts, random: Random): Uint8Array<ArrayBuffer> {
  let spoiled: unknown = structuredClone(json);
  let data = binary?.slice();
  const container = random.below(10) === 0;
  for (let i = container ? 0 : random.below(4); i >= 0 && !container; i--) {
    if (data && random.below(4) === 0) data = spoilBytes(data, random);
    else if (typeof spoiled === 'object' && spoiled !== null) spoilJson(spoiled, random);
  }
  if (random.below(200) === 0) spoiled = random.pick(VALUES);
  let text = JSON.stringify(spoiled) ?? 'undefined';
  // A key that JSON.parse makes an own property and careless copies a prototype.
  if (random.below(20) === 0) text = text.replace('{', '{"__proto__":{"polluted":true},');
  const bytes = data && data.length > 0 ? glb(text, data) : new TextEncoder().encode(text);
  return container ? spoilBytes(bytes, random) : bytes;
}
