import { createScene, defaultMaterial, type Material, type Mesh, type Scene } from '@glanz/scene';
import { FormatError, Tally } from './error';
import { FloatList } from './mesh-builder';
import { readMtl, type MtlMaterial } from './mtl';
import { orientation } from './orientation';
import { pathWithin, type ImageDecoder, type ResourceReader } from './resources';
import { smoothNormals } from './smooth';
import { triangulate } from './triangulate';

/** Options for {@link readObj}. */
export interface ObjOptions {
  /** What messages call the file. Default "OBJ". */
  readonly name?: string;
  /**
   * Reads the MTL files and the images beside the document. Default: no files are found, and the material is the
   * default one.
   */
  readonly read?: ResourceReader;
  /** Decodes images. Default: they are left out, with a warning. */
  readonly decodeImage?: ImageDecoder;
  /** Which axis of the file points up; default `y`. */
  readonly up?: 'y' | 'z';
  /** Metres a unit of the file; default 1. */
  readonly unit?: number;
  readonly signal?: AbortSignal;
}

/** Faces that become one mesh. */
class Part {
  readonly positions = new FloatList();
  readonly normals = new FloatList();
  readonly uvs = new FloatList();
  readonly colors = new FloatList();
  readonly indices: number[] = [];
  /** Smoothing group of each triangle; 0: flat. */
  readonly groups: number[] = [];
  readonly vertices = new Map<string, number>();
  hasNormals = true;
  hasUvs = false;

  constructor(
    readonly name: string,
    readonly material: string,
  ) {}
}

/**
 * Reads a Wavefront OBJ file with its MTL files as a scene: a mesh and an instance for each object or group and
 * material. Polygons are cut into triangles; texture coordinates are turned to have their origin in the upper left
 * corner. Without normals in the file, smoothing groups are smoothed and the rest is flat. Lines, points and free-form
 * curves are left out.
 *
 * @throws {FormatError} `formats/no-triangles`.
 * @example
 * const scene = await readObj(bytes, { read: async (path) => files.get(path), decodeImage });
 */
export async function readObj(bytes: Uint8Array, options: ObjOptions = {}): Promise<Scene> {
  const { name = 'OBJ', up = 'y', unit = 1, signal } = options;
  const tally = new Tally();
  const { parts, libraries } = readFaces(bytes, tally);
  const scene = createScene(name);
  const materials = new Map<string, MtlMaterial>();
  for (const library of libraries) {
    signal?.throwIfAborted();
    const path = pathWithin('', library);
    const text = path === undefined ? undefined : await options.read?.(path, signal);
    if (!text || path === undefined) {
      scene.warnings.push({
        code: 'formats/missing-resource',
        message: `${name} names the materials "${library}", which are missing.`,
      });
      continue;
    }
    const folder = path.slice(0, path.lastIndexOf('/') + 1);
    for (const [key, { material, maps }] of readMtl(new TextDecoder().decode(text)))
      if (!materials.has(key))
        materials.set(key, { material, maps: maps.map((map) => ({ ...map, path: folder + map.path })) });
  }
  const indices = new Map<string, number>();
  for (const part of parts) {
    const mesh = build(part);
    if (!mesh) continue;
    let material = indices.get(part.material);
    if (material === undefined) {
      const found = materials.get(part.material);
      if (!found && part.material !== '')
        scene.warnings.push({
          code: 'formats/missing-material',
          message: `${name} uses the material "${part.material}", which is missing; the default one is used.`,
        });
      material =
        scene.materials.push(
          found
            ? { ...found.material }
            : { ...defaultMaterial(), ...(part.material === '' ? {} : { name: part.material }) },
        ) - 1;
      indices.set(part.material, material);
    }
    scene.instances.push({
      name: mesh.name,
      mesh: scene.meshes.push(mesh) - 1,
      material,
      transform: orientation(up, unit),
    });
  }
  if (scene.instances.length === 0)
    throw new FormatError('formats/no-triangles', `${name} has no triangles: there is nothing to show.`, {
      location: { file: name },
    });
  await readImages(scene, materials, options);
  scene.warnings.push(...tally.warnings(name));
  return scene;
}

function readFaces(bytes: Uint8Array, tally: Tally): { parts: readonly Part[]; libraries: readonly string[] } {
  const positions = new FloatList(),
    colors = new FloatList(),
    normals = new FloatList(),
    uvs = new FloatList();
  const parts = new Map<string, Part>();
  const libraries = new Set<string>();
  let group = '',
    material = '',
    smoothing = 0,
    colored = false,
    number = 0;
  let part: Part | undefined;
  for (const line of new TextDecoder()
    .decode(bytes)
    .replace(/\\\r?\n/g, ' ')
    .split(/\r?\n/)) {
    number++;
    const words = line.trim().split(/\s+/);
    const key = words[0] as string;
    const values = (size: number, initial = 0) =>
      Array.from({ length: size }, (_, k) => {
        const x = Math.fround(Number(words[k + 1] ?? initial));
        return Number.isFinite(x) ? x : NaN;
      });
    if (key === 'v') {
      positions.push(...values(3, NaN));
      colored ||= words.length >= 7;
      colors.push(
        ...(words.length >= 7
          ? words.slice(4, 7).map((word) => Math.min(Math.max(Number(word) || 0, 0), 1))
          : [1, 1, 1]),
      );
    } else if (key === 'vt') uvs.push(...values(2).map((x) => (Number.isFinite(x) ? x : 0)));
    else if (key === 'vn') normals.push(...values(3).map((x) => (Number.isFinite(x) ? x : 0)));
    else if (key === 'f') {
      part ??= partOf(parts, group, material);
      if (!addFace(part, words, { positions, colors, normals, uvs, colored, smoothing }))
        tally.add('formats/face', 'a face names vertices that are missing or not finite, and is left out', number);
    } else if (key === 'o' || key === 'g') {
      group = words.slice(1).join(' ');
      part = undefined;
    } else if (key === 'usemtl') {
      material = words.slice(1).join(' ');
      part = undefined;
    } else if (key === 'mtllib') libraries.add(line.trim().slice(6).trim());
    else if (key === 's')
      smoothing = words[1] === undefined || words[1] === 'off' ? 0 : Math.abs(Number.parseInt(words[1], 10)) || 0;
    else if (key === 'l' || key === 'p') tally.add('formats/ignored', 'lines and points are left out', number);
    else if (key !== '' && !key.startsWith('#'))
      tally.add('formats/ignored', `"${key.slice(0, 40)}" is not read`, number);
  }
  return { parts: [...parts.values()], libraries: [...libraries] };
}

function partOf(parts: Map<string, Part>, group: string, material: string): Part {
  const key = `${group}\n${material}`;
  let part = parts.get(key);
  if (!part) parts.set(key, (part = new Part(group || material || `part ${parts.size}`, material)));
  return part;
}

interface Lists {
  readonly positions: FloatList;
  readonly colors: FloatList;
  readonly normals: FloatList;
  readonly uvs: FloatList;
  readonly colored: boolean;
  readonly smoothing: number;
}

/** Adds a polygon; false if it names what is missing. */
function addFace(
  part: Part,
  words: readonly string[],
  { positions, colors, normals, uvs, colored, smoothing }: Lists,
): boolean {
  const corners: (readonly [number, number, number])[] = [];
  const points: number[] = [];
  /** From 1 on, or backwards from the end. −1: not given. */
  const resolve = (word: string | undefined, count: number): number | undefined => {
    if (word === undefined || word === '') return -1;
    const index = Number(word);
    const at = index < 0 ? count + index : index - 1;
    return Number.isInteger(at) && at >= 0 && at < count ? at : undefined;
  };
  for (const word of words.slice(1)) {
    if (word.startsWith('#')) break;
    const [v, vt, vn] = word.split('/');
    const at = resolve(v, positions.length / 3),
      uv = resolve(vt, uvs.length / 2),
      normal = resolve(vn, normals.length / 3);
    if (at === undefined || at < 0 || uv === undefined || normal === undefined) return false;
    for (let k = 0; k < 3; k++) points.push(positions.at(3 * at + k));
    corners.push([at, uv, normal]);
  }
  if (corners.length < 3 || !points.every(Number.isFinite)) return false;
  const vertex = ([at, uv, normal]: readonly [number, number, number]): number => {
    const key = `${at}/${uv}/${normal}`;
    const known = part.vertices.get(key);
    if (known !== undefined) return known;
    const made = part.vertices.size;
    part.vertices.set(key, made);
    part.positions.push(positions.at(3 * at), positions.at(3 * at + 1), positions.at(3 * at + 2));
    if (colored) part.colors.push(colors.at(3 * at), colors.at(3 * at + 1), colors.at(3 * at + 2), 1);
    else part.colors.push(1, 1, 1, 1);
    part.uvs.push(uv < 0 ? 0 : uvs.at(2 * uv), uv < 0 ? 0 : 1 - uvs.at(2 * uv + 1));
    if (uv >= 0) part.hasUvs = true;
    const n = normal < 0 ? [0, 0, 0] : [normals.at(3 * normal), normals.at(3 * normal + 1), normals.at(3 * normal + 2)];
    const length = Math.hypot(n[0] as number, n[1] as number, n[2] as number);
    if (!(length > 1e-12)) part.hasNormals = false;
    part.normals.push(...n.map((x) => x / (length || 1)));
    return made;
  };
  for (const corner of triangulate(points))
    part.indices.push(vertex(corners[corner] as readonly [number, number, number]));
  for (let i = 2; i < corners.length; i++) part.groups.push(smoothing);
  return true;
}

function build(part: Part): Mesh | undefined {
  if (part.indices.length === 0) return undefined;
  const mesh: Mesh = { name: part.name, positions: part.positions.toArray(), indices: Uint32Array.from(part.indices) };
  if (part.hasUvs) mesh.uvs = [part.uvs.toArray()];
  const colors = part.colors.toArray();
  if (colors.some((c) => c !== 1)) mesh.colors = colors;
  if (part.hasNormals) return { ...mesh, normals: part.normals.toArray() };
  return part.groups.some((group) => group > 0) ? smoothNormals(mesh, part.groups) : mesh;
}

async function readImages(
  scene: Scene,
  materials: ReadonlyMap<string, MtlMaterial>,
  { name = 'OBJ', read, decodeImage, signal }: ObjOptions,
): Promise<void> {
  const images = new Map<string, number | undefined>();
  for (const material of scene.materials) {
    for (const map of materials.get(material.name)?.maps ?? []) {
      signal?.throwIfAborted();
      const path = pathWithin('', map.path);
      const key = path ?? map.path;
      if (!images.has(key)) {
        const bytes = path === undefined ? undefined : await read?.(path, signal);
        const decoded = bytes && (await decodeImage?.(bytes).catch(() => undefined));
        if (!decoded)
          scene.warnings.push({
            code: 'formats/image',
            message: `${name}: the image "${map.path}" ${bytes ? 'cannot be decoded' : 'is missing'} and is left out.`,
          });
        images.set(key, decoded && scene.images.push({ name: key, ...decoded }) - 1);
      }
      const image = images.get(key);
      if (image === undefined) continue;
      const wrap = map.clamp ? ('clamp' as const) : ('repeat' as const);
      const texture = scene.textures.push({ image, color_space: map.colorSpace, wrap_u: wrap, wrap_v: wrap }) - 1;
      const textures: NonNullable<Material['textures']> = (material.textures ??= {});
      textures[map.parameter] = {
        texture,
        channels: map.channels,
        ...(map.transform ? { transform: map.transform } : {}),
        ...(map.scale === undefined ? {} : { scale: map.scale }),
      };
    }
  }
}
