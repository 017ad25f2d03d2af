import { createScene, defaultMaterial, type Material, type Scene } from '@glanz/scene';
import { multiply } from 'gl-matrix/esm/mat4.js';
import { FormatError } from '../error';
import { orientation } from '../orientation';
import { pathWithin, type ImageDecoder, type ResourceReader } from '../resources';
import { readCrate, CRATE_MAGIC } from './crate';
import { numbersOf, textOf, type UsdLayer, type UsdPrim } from './layer';
import { displayColor, meshData, meshPart, uvNames, type MeshData } from './mesh';
import { previewSurface, type UsdMaterial } from './preview-surface';
import { readText, TEXT_MAGIC } from './text';
import { localTransform } from './transform';
import { isZip, readStoredZip } from './zip';

/** Options for {@link readUsd}. */
export interface UsdOptions {
  /** What messages call the file. Default "USD". */
  readonly name?: string;
  /**
   * Reads the images beside a `.usda` or `.usdc` file; a USDZ archive contains its images. Default: no files are found.
   */
  readonly read?: ResourceReader;
  /** Decodes images. Default: they are left out, with a warning. */
  readonly decodeImage?: ImageDecoder;
  readonly signal?: AbortSignal;
}

/** USD's metres per unit where a file does not say. */
const CENTIMETRE = 0.01;
/** Prims that place, group or describe others, and those that are read elsewhere. */
const SILENT = new Set([
  '',
  'Xform',
  'Scope',
  'Mesh',
  'Material',
  'Shader',
  'NodeGraph',
  'GeomSubset',
  'SkelRoot',
  'Skeleton',
  'SkelAnimation',
]);

/** Warnings of one kind are one, with the first place. */
class Report {
  readonly #found = new Map<string, { readonly code: string; readonly path: string; count: number }>();

  add(code: string, message: string, path: string): void {
    const known = this.#found.get(message);
    if (known) known.count++;
    else this.#found.set(message, { code, path, count: 1 });
  }

  warnings(file: string) {
    return [...this.#found].map(([message, { code, path, count }]) => ({
      code,
      message: `${file}: ${path} ${message}${count > 1 ? ` (and ${count - 1} more)` : ''}.`,
      path,
    }));
  }
}

interface Opened {
  readonly layer: UsdLayer;
  /** Folder of the layer, with a slash at its end, or empty. */
  readonly folder: string;
  readonly read: ResourceReader;
}

function openLayer(bytes: Uint8Array<ArrayBuffer>): UsdLayer {
  const start = String.fromCharCode(...bytes.subarray(0, 8));
  if (start === CRATE_MAGIC) return readCrate(bytes);
  if (start.startsWith(TEXT_MAGIC)) return readText(new TextDecoder().decode(bytes));
  throw new RangeError('it is neither a USDZ archive nor a layer of USD');
}

/** The layer of a file, or of an archive's first file; other files of an archive are read within it. */
function open(bytes: Uint8Array<ArrayBuffer>, name: string, read: ResourceReader | undefined): Opened {
  try {
    if (!isZip(bytes)) return { layer: openLayer(bytes), folder: '', read: read ?? (() => Promise.resolve(undefined)) };
    const files = readStoredZip(bytes);
    const [first] = [...files].filter(([path]) => /\.usd[ac]?$/i.test(path));
    if (!first) throw new RangeError('the archive holds no layer of USD');
    const [path, content] = first;
    return {
      layer: openLayer(content),
      folder: path.slice(0, path.lastIndexOf('/') + 1),
      read: (inside) => Promise.resolve(files.get(inside)),
    };
  } catch (cause) {
    if (!(cause instanceof RangeError)) throw cause;
    throw new FormatError('formats/malformed', `${name} cannot be read: ${cause.message}.`, {
      cause,
      location: { file: name },
    });
  }
}

/** All prims of a layer by their paths. */
function primsOf(layer: UsdLayer): Map<string, UsdPrim> {
  const prims = new Map<string, UsdPrim>();
  for (const stack = [layer.root]; stack.length > 0;) {
    const prim = stack.pop() as UsdPrim;
    prims.set(prim.path, prim);
    stack.push(...prim.children);
  }
  return prims;
}

/**
 * The paths of the files that a `.usda` or `.usdc` file refers to, as written in it; they are relative to its folder. A
 * USDZ archive contains its files and refers to none.
 *
 * @param name What messages call the file.
 * @throws {FormatError} `formats/malformed`
 * @example
 * usdFiles(await readFile('chair.usdc')); // ['textures/wood.png']
 */
export function usdFiles(bytes: Uint8Array<ArrayBuffer>, name = 'USD'): string[] {
  if (isZip(bytes)) return [];
  const files = new Set<string>();
  for (const { attributes } of primsOf(open(bytes, name, undefined).layer).values())
    for (const { type, value } of attributes.values()) {
      if (!/^asset(\[\])?$/.test(type)) continue;
      const named: ArrayLike<unknown> = typeof value === 'string' ? [value] : typeof value === 'object' ? value : [];
      for (const file of Array.from(named)) if (typeof file === 'string' && file !== '') files.add(file);
    }
  return [...files];
}

/** Materials of the scene by prim and side, made when a mesh first needs them. */
class Materials {
  readonly #made = new Map<string, number>();
  readonly #read = new Map<string, UsdMaterial | undefined>();
  readonly used = new Map<number, UsdMaterial>();

  constructor(
    readonly scene: Scene,
    readonly find: (path: string) => UsdPrim | undefined,
    readonly report: Report,
  ) {}

  /** The material of a path; undefined where there is none that is read. */
  at(path: string | undefined): UsdMaterial | undefined {
    if (path === undefined) return undefined;
    if (!this.#read.has(path)) {
      const prim = this.find(path);
      if (!prim) this.report.add('formats/missing-material', 'is bound, but missing; the default one is used', path);
      this.#read.set(
        path,
        prim && previewSurface(prim, this.find, (message) => this.report.add('formats/unsupported', message, path)),
      );
    }
    return this.#read.get(path);
  }

  /** Its index in the scene. */
  index(path: string | undefined, sided: boolean, color: Material['parameters']['base_color']): number {
    const found = this.at(path);
    const key = found ? `${path} ${sided}` : `${sided} ${color}`;
    const known = this.#made.get(key);
    if (known !== undefined) return known;
    const material: Material = found
      ? { ...found.material, parameters: { ...found.material.parameters } }
      : {
          ...defaultMaterial(),
          ...(color ? { parameters: { ...defaultMaterial().parameters, base_color: color } } : {}),
        };
    if (sided) material.double_sided = true;
    const index = this.scene.materials.push(material) - 1;
    if (found) this.used.set(index, found);
    this.#made.set(key, index);
    return index;
  }
}

const bindingOf = (prim: UsdPrim): string | undefined =>
  ['material:binding', 'material:binding:preview', 'material:binding:full']
    .map((name) => prim.relationships.get(name)?.[0])
    .find((path) => path !== undefined);

interface Place {
  readonly prim: UsdPrim;
  readonly world: readonly number[];
  readonly visible: boolean;
  readonly binding: string | undefined;
}

function addMesh(scene: Scene, { prim, world, visible, binding }: Place, materials: Materials, report: Report): void {
  const data: MeshData | undefined = meshData(prim);
  if (!data) return;
  const left = new Set(Array.from({ length: data.counts.length }, (_, face) => face));
  const parts: { name: string; faces: Iterable<number>; binding: string | undefined }[] = [];
  for (const subset of prim.children) {
    const own = bindingOf(subset);
    if (subset.type !== 'GeomSubset' || own === undefined) continue;
    const faces = Array.from(numbersOf(subset, 'indices') ?? []).filter((face) => left.delete(face));
    parts.push({ name: `${prim.name} ${subset.name}`, faces, binding: own });
  }
  parts.unshift({ name: prim.name, faces: left, binding });
  const sided = textOf(prim, 'doubleSided') === '1' || prim.attributes.get('doubleSided')?.value === true;
  const oneSided = !(sided || numbersOf(prim, 'doubleSided')?.[0] === 1);
  for (const part of parts) {
    const found = materials.at(part.binding);
    const color = found ? undefined : displayColor(data);
    const names = uvNames(data);
    // Files name the same coordinates otherwise in the mesh and in the material.
    const uvs = (found?.uvs ?? []).map((uv) => (names.includes(uv) ? uv : (names[0] ?? uv)));
    const { mesh, dropped } = meshPart(data, part.faces, part.name, uvs, color === 'varying');
    if (dropped > 0)
      report.add(
        'formats/face',
        `has ${dropped} faces whose points are missing or not finite; they are left out`,
        prim.path,
      );
    if (!mesh) continue;
    scene.instances.push({
      name: part.name,
      mesh: scene.meshes.push(mesh) - 1,
      material: materials.index(part.binding, !oneSided, color === 'varying' ? [1, 1, 1] : color),
      transform: [...world],
      ...(visible ? {} : { visible: false }),
    });
  }
}

async function addImages(scene: Scene, materials: Materials, opened: Opened, options: UsdOptions): Promise<void> {
  const { name = 'USD', decodeImage, signal } = options;
  const images = new Map<string, number | undefined>();
  const textures = new Map<string, number>();
  for (const [index, { maps, uvs }] of materials.used) {
    const material = scene.materials[index] as Material;
    for (const { parameter, texture, colorSpace, range } of maps) {
      signal?.throwIfAborted();
      const path = pathWithin(opened.folder, texture.file);
      if (!images.has(texture.file)) {
        const bytes = path === undefined ? undefined : await opened.read(path, signal);
        const decoded = bytes && (await decodeImage?.(bytes).catch(() => undefined));
        if (!decoded)
          scene.warnings.push({
            code: 'formats/image',
            message: `${name}: the image "${texture.file}" ${bytes ? 'cannot be decoded' : 'is missing'} and is left out.`,
          });
        images.set(texture.file, decoded && scene.images.push({ name: path as string, ...decoded }) - 1);
      }
      const image = images.get(texture.file);
      if (image === undefined) continue;
      const [wrapU, wrapV] = texture.wrap;
      const key = `${image} ${colorSpace} ${wrapU} ${wrapV}`;
      const known =
        textures.get(key) ?? scene.textures.push({ image, color_space: colorSpace, wrap_u: wrapU, wrap_v: wrapV }) - 1;
      textures.set(key, known);
      const uv = uvs.indexOf(texture.uv);
      (material.textures ??= {})[parameter] = {
        texture: known,
        channels: texture.channels,
        ...(uv > 0 ? { uv } : {}),
        ...(texture.transform ? { transform: texture.transform } : {}),
        ...(range ? { range } : {}),
      };
    }
  }
}

/**
 * Reads a USD file as a scene: a USDZ archive (`.usdz`), or one layer in binary (`.usdc`) or text (`.usda`). Meshes
 * with their transforms, texture coordinates, normals, colours and subsets, and materials of `UsdPreviewSurface`, which
 * become OpenPBR. Files are in metres and +Y up afterwards. Of values that change with time the first counts.
 *
 * What composes several files or variants (references, payloads, variant sets), lights, cameras, skeletons, curves and
 * points are left out, with warnings.
 *
 * @throws {FormatError} `formats/malformed`, `formats/no-triangles`.
 * @example
 * const scene = await readUsd(bytes, { name: 'chair.usdz', decodeImage });
 */
export async function readUsd(bytes: Uint8Array<ArrayBuffer>, options: UsdOptions = {}): Promise<Scene> {
  const { name = 'USD' } = options;
  const opened = open(bytes, name, options.read);
  const { layer } = opened;
  const prims = primsOf(layer);
  const report = new Report();
  if (layer.subLayers) report.add('formats/unsupported', 'has sublayers, which are not read', '/');
  const scene = createScene(layer.defaultPrim ?? name);
  const materials = new Materials(scene, (path) => prims.get(path), report);
  const world = orientation(layer.upAxis === 'Z' ? 'z' : 'y', layer.metersPerUnit ?? CENTIMETRE);
  const stack: Place[] = [...layer.root.children]
    .reverse()
    .map((prim) => ({ prim, world, visible: true, binding: undefined }));
  for (let place = stack.pop(); place; place = stack.pop()) {
    const { prim } = place;
    const purpose = textOf(prim, 'purpose');
    if (!prim.defined || !prim.active || purpose === 'guide' || purpose === 'proxy') continue;
    if (prim.arcs.size > 0)
      report.add('formats/unsupported', `has ${[...prim.arcs].join(', ')}, which are not read`, prim.path);
    if (!SILENT.has(prim.type)) report.add('formats/ignored', `is a ${prim.type}, which is not read`, prim.path);
    const { matrix, resets } = localTransform(prim);
    const own: Place = {
      prim,
      world: multiply([...world], resets ? world : place.world, matrix),
      visible: place.visible && textOf(prim, 'visibility') !== 'invisible',
      binding: bindingOf(prim) ?? place.binding,
    };
    if (prim.type === 'Mesh') addMesh(scene, own, materials, report);
    for (const child of [...prim.children].reverse()) stack.push({ ...own, prim: child });
  }
  if (scene.instances.length === 0)
    throw new FormatError('formats/no-triangles', `${name} has no triangles: there is nothing to show.`, {
      location: { file: name },
    });
  await addImages(scene, materials, opened, options);
  scene.warnings.push(...report.warnings(name));
  return scene;
}
