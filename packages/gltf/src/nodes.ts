import type { Instance, Material, Mesh, Scene } from '@glanz/scene';
import { fromRotationTranslationScale, multiply } from 'gl-matrix/esm/mat4.js';
import type { NodePose } from './animation';
import { maximum, readPrimitive } from './attributes';
import { readCamera } from './cameras';
import { deformed, type Deformation } from './deform';
import { GltfError } from './error';
import type { GltfJson, GltfMesh, GltfNode, GltfPrimitive } from './json';
import { readLight } from './lights';
import type { Budget } from './limits';
import type { UvSets } from './materials';
import { identity, isFinite4x4, type Matrix } from './matrix';
import { influencesOf, isSkinnable, jointMatrices } from './pose';
import { openPrimitive, type PrimitiveData, type PrimitiveReader } from './primitive';
import { tangentSet } from './tangents';

/** What {@link readNodes} needs. */
export interface NodeContext {
  readonly json: GltfJson;
  readonly reader: PrimitiveReader;
  /** Receives meshes, instances, cameras and lights; has the document's materials in their order. */
  readonly scene: Scene;
  /** Index of the scene's material for primitives without one. */
  readonly defaultMaterial: () => number;
  /** The UV sets that a material of the scene reads. */
  readonly uvSetsOf: (material: number) => UvSets;
  /** Index of the document's scene; undefined: all root nodes. */
  readonly shown: number | undefined;
  readonly poses: ReadonlyMap<number, NodePose>;
  /** Nodes whose weights some animation changes, in this pose or another. */
  readonly morphing: ReadonlySet<number>;
  readonly instances: Budget;
}

/** A node that is shown. */
export interface Placed {
  readonly world: Matrix;
  readonly visible: boolean;
}

function localMatrix(node: GltfNode, pose: NodePose | undefined): Matrix {
  if (node.matrix && !pose) return [...node.matrix];
  const rotation = pose?.rotation ?? node.rotation ?? [0, 0, 0, 1];
  return fromRotationTranslationScale(
    identity(),
    rotation,
    pose?.translation ?? node.translation ?? [0, 0, 0],
    pose?.scale ?? node.scale ?? [1, 1, 1],
  );
}

/** All nodes of a scene, parents before children, in the order of the document. */
export function placedNodes({
  json,
  shown,
  poses,
}: Pick<NodeContext, 'json' | 'shown' | 'poses'>): Map<number, Placed> {
  const nodes = json.nodes ?? [];
  let roots = shown === undefined ? undefined : (json.scenes?.[shown]?.nodes ?? []);
  if (!roots) {
    const below = new Set(nodes.flatMap(({ children = [] }) => children));
    roots = nodes.map((_, index) => index).filter((index) => !below.has(index));
  }
  const placed = new Map<number, Placed>();
  const stack: { node: number; parent: Placed }[] = [];
  const push = (list: readonly number[], parent: Placed) => {
    for (let i = list.length - 1; i >= 0; i--) stack.push({ node: list[i] as number, parent });
  };
  push(roots, { world: identity(), visible: true });
  for (let entry = stack.pop(); entry; entry = stack.pop()) {
    if (placed.has(entry.node)) continue;
    const node = nodes[entry.node] as GltfNode;
    const own = {
      world: multiply(identity(), entry.parent.world, localMatrix(node, poses.get(entry.node))),
      visible: entry.parent.visible && node.extensions?.KHR_node_visibility?.visible !== false,
    };
    placed.set(entry.node, own);
    push(node.children ?? [], own);
  }
  return placed;
}

/** Reads instances, meshes, cameras and lights into the scene, in the order of the node tree. */
export function readNodes(context: NodeContext): void {
  const { json, scene } = context;
  const placed = placedNodes(context);
  const world = new Map([...placed].map(([node, { world: at }]) => [node, at]));
  const meshes = new MeshReader(context, world);
  for (const [index, { world: transform, visible }] of placed) {
    const node = json.nodes?.[index] as GltfNode;
    const { name = '' } = node;
    if (!isFinite4x4(transform)) {
      scene.warnings.push({
        code: 'gltf/node',
        message: `Node "${name}" has a transform that is not finite; it is left out.`,
        path: `/nodes/${index}`,
      });
      continue;
    }
    const camera = node.camera === undefined ? undefined : json.cameras?.[node.camera];
    if (camera) readCamera(camera, name, transform, scene);
    const light = json.extensions?.KHR_lights_punctual?.lights[node.extensions?.KHR_lights_punctual?.light ?? -1];
    if (light && visible) readLight(light, name, transform, scene);
    const mesh = node.mesh === undefined ? undefined : json.meshes?.[node.mesh];
    if (!mesh) continue;
    const own =
      node.skin !== undefined && mesh.primitives.every(isSkinnable) ? [] : instancesOf(context, node, transform, index);
    mesh.primitives.forEach((primitive, at) => {
      // The joints place a skinned mesh; the transform of its node is ignored.
      const places = node.skin !== undefined && isSkinnable(primitive) ? [identity()] : own;
      const read = meshes.read(index, node, primitive, at);
      if (!read) return;
      context.instances.take(places.length, `/nodes/${index}`);
      for (const place of places) {
        const instance: Instance = {
          name: name || mesh.name || `node ${scene.instances.length}`,
          mesh: read.mesh,
          material: read.material,
          transform: place,
        };
        if (!visible) instance.visible = false;
        if (read.variants) instance.variants = read.variants;
        scene.instances.push(instance);
        scene.animatedParts?.push([index, at]);
      }
    });
  }
  checkUnshown(context, meshes.shown);
}

/** Warns of invalid indices in primitives that no shown node uses: these are not read otherwise. */
function checkUnshown({ json, reader, scene }: NodeContext, shown: ReadonlySet<GltfPrimitive>): void {
  json.meshes?.forEach(({ primitives }, mesh) => {
    primitives.forEach((primitive, at) => {
      const position = primitive.attributes['POSITION'];
      if (
        shown.has(primitive) ||
        primitive.indices === undefined ||
        position === undefined ||
        primitive.extensions?.KHR_draco_mesh_compression
      )
        return;
      const { bufferView } = reader.accessors.at(primitive.indices);
      if (bufferView === undefined || !reader.exists(bufferView)) return;
      const path = `/meshes/${mesh}/primitives/${at}`;
      const { count } = reader.accessors.at(position);
      const largest = maximum(reader.accessors.indices(primitive.indices));
      if (largest >= count || openPrimitive(primitive, path, reader).restart === largest) {
        scene.warnings.push({
          code: 'gltf/primitive',
          message: `${reader.file}: ${path} names vertices that do not exist; no shown node uses it.`,
          path,
        });
      }
    });
  });
}

/** A primitive as instances use it. */
interface ReadPrimitive {
  readonly mesh: number;
  readonly material: number;
  readonly variants: Record<number, number> | undefined;
}

/** Reads each mesh once, except where a skin or morph targets give a node its own shape. */
class MeshReader {
  readonly #context: NodeContext;
  readonly #world: ReadonlyMap<number, Matrix>;
  readonly #opened = new Map<GltfPrimitive, PrimitiveData>();
  /** Meshes by their content: primitives may be equal. */
  readonly #shared = new Map<string, number | undefined>();
  readonly #keys = new Map<GltfPrimitive, string>();
  readonly #variants = new Map<GltfPrimitive, Record<number, number> | undefined>();
  readonly #joints = new Map<number, readonly (Matrix | undefined)[]>();

  /** Primitives that have been read, even without a result. */
  readonly shown = new Set<GltfPrimitive>();

  constructor(context: NodeContext, world: ReadonlyMap<number, Matrix>) {
    this.#context = context;
    this.#world = world;
  }

  read(nodeIndex: number, node: GltfNode, primitive: GltfPrimitive, at: number): ReadPrimitive | undefined {
    const { json, scene, poses, defaultMaterial } = this.#context;
    this.shown.add(primitive);
    const mesh = json.meshes?.[node.mesh as number];
    const material = primitive.material ?? defaultMaterial();
    if (!this.#variants.has(primitive)) this.#variants.set(primitive, variantsOf(primitive));
    const variants = this.#variants.get(primitive);
    // Weights of the mesh itself give all of its instances the same shape.
    const own = poses.get(nodeIndex)?.weights ?? node.weights ?? this.#context.morphing.has(nodeIndex);
    const shared = (node.skin === undefined || !isSkinnable(primitive)) && !own;
    const key = shared ? this.#keyOf(primitive, material, mesh?.weights) : '';
    if (shared && this.#shared.has(key)) {
      const known = this.#shared.get(key);
      return known === undefined ? undefined : { mesh: known, material, variants };
    }
    const weights = weightsOf(node, mesh, poses.get(nodeIndex));
    const label =
      (mesh?.name || node.name || `mesh ${node.mesh}`) + ((mesh?.primitives.length ?? 1) > 1 ? ` ${at}` : '');
    const made = this.#make(node, primitive, label, `/meshes/${node.mesh}/primitives/${at}`, material, weights, [
      material,
      ...Object.values(variants ?? {}),
    ]);
    const index = made && scene.meshes.push(made) - 1;
    if (shared) this.#shared.set(key, index);
    return index === undefined ? undefined : { mesh: index, material, variants };
  }

  #keyOf(primitive: GltfPrimitive, material: number, weights: readonly number[] | undefined): string {
    let key = this.#keys.get(primitive);
    if (key === undefined) {
      const { scene, uvSetsOf } = this.#context;
      const { attributes, indices, mode, targets, extensions } = primitive;
      const looks = [material, ...Object.values(this.#variants.get(primitive) ?? {})].map((index) => [
        uvSetsOf(index),
        tangentSet(scene.materials[index]),
        scene.materials[index]?.parameters.geometry_opacity === undefined,
      ]);
      key = JSON.stringify([
        attributes,
        indices,
        mode,
        extensions?.KHR_draco_mesh_compression,
        weights?.some((w) => w !== 0) ? [targets, weights] : [],
        looks,
      ]);
      this.#keys.set(primitive, key);
    }
    return key;
  }

  /** Matrices of a skin's joints, in the pose. */
  #jointsOf(index: number): readonly (Matrix | undefined)[] {
    let matrices = this.#joints.get(index);
    if (!matrices) {
      const { json, reader, scene } = this.#context;
      const skin = json.skins?.[index];
      matrices = jointMatrices(
        `skin ${index}`,
        skin?.joints ?? [],
        skin?.inverseBindMatrices === undefined ? undefined : reader.accessors.floats(skin.inverseBindMatrices, 16),
        this.#world,
        scene.warnings,
      );
      this.#joints.set(index, matrices);
    }
    return matrices;
  }

  #make(
    node: GltfNode,
    primitive: GltfPrimitive,
    label: string,
    path: string,
    material: number,
    weights: readonly number[],
    materials: readonly number[],
  ): Mesh | undefined {
    const { scene, reader, uvSetsOf } = this.#context;
    const opened = this.#opened.get(primitive) ?? openPrimitive(primitive, path, reader);
    // Keep only primitives that may be read again.
    if (node.skin !== undefined || weights.length > 0) this.#opened.set(primitive, opened);
    const uvSets = uvSetsOf(material);
    for (const other of materials) {
      if (`${uvSetsOf(other)}` !== `${uvSets}`)
        scene.warnings.push({
          code: 'gltf/variant',
          message: `${label}: the material "${scene.materials[other]?.name}" of a variant uses other UV sets than the first material; its textures use the UV sets of the first.`,
          path,
        });
    }
    const base = readPrimitive(opened, label, isOpaque(scene.materials[material]), uvSets, path, scene.warnings);
    if (!base) return undefined;
    let skin: Deformation['skin'];
    if (node.skin !== undefined && isSkinnable(primitive)) {
      const matrices = this.#jointsOf(node.skin);
      const vertices = base.positions.length / 3;
      skin = { matrices, influences: influencesOf(label, opened, vertices, matrices.length, scene.warnings) };
    }
    const shown = materials.map((index) => scene.materials[index]);
    return deformed(base, opened, { weights, skin }, shown, path, scene.warnings);
  }
}

/** Whether the alpha of vertex colours is without effect on a material. */
export const isOpaque = (material: Material | undefined): boolean =>
  material?.parameters.geometry_opacity === undefined;

/** The weights of a node's morph targets: its own in this pose, or those of its mesh. */
export const weightsOf = (node: GltfNode, mesh: GltfMesh | undefined, pose: NodePose | undefined): readonly number[] =>
  (pose?.weights ?? node.weights ?? mesh?.weights ?? []).map((w) => (Number.isFinite(w) ? w : 0));

/** The materials of KHR_materials_variants, by the indices of the variants. */
export function variantsOf({ extensions }: GltfPrimitive): Record<number, number> | undefined {
  const mappings = extensions?.KHR_materials_variants?.mappings;
  if (!mappings) return undefined;
  return Object.fromEntries(
    mappings.flatMap(({ material, variants }) => variants.map((variant) => [variant, material])),
  );
}

/** The transforms of a node's mesh: its own, or those of EXT_mesh_gpu_instancing. */
export function instancesOf(
  { reader, scene, instances }: Pick<NodeContext, 'reader' | 'scene' | 'instances'>,
  node: GltfNode,
  transform: Matrix,
  index: number,
): Matrix[] {
  const instancing = node.extensions?.EXT_mesh_gpu_instancing;
  if (!instancing) return [transform];
  const { attributes, count } = instancing;
  const { warnings } = scene;
  const path = `/nodes/${index}/extensions/EXT_mesh_gpu_instancing`;
  const warn = (number: number, what: string) =>
    void warnings.push({
      code: 'gltf/node',
      message: `${number} of ${count} instances at node "${node.name ?? ''}" have ${what}.`,
      path,
    });
  instances.check(count, path);
  const read = (semantic: string, size: number, initial: readonly number[]) => {
    const accessor = attributes[semantic];
    const values = accessor === undefined ? undefined : reader.accessors.floats(accessor, size);
    return (i: number): ArrayLike<number> => values?.subarray(size * i, size * i + size) ?? initial;
  };
  const translation = read('TRANSLATION', 3, [0, 0, 0]),
    rotation = read('ROTATION', 4, [0, 0, 0, 1]),
    scale = read('SCALE', 3, [1, 1, 1]);
  const places: Matrix[] = [];
  let withoutRotation = 0;
  for (let i = 0; i < count; i++) {
    let turn = Array.from(rotation(i));
    const length = Math.hypot(...turn);
    if (length > 1e-6) turn = turn.map((x) => x / length);
    else {
      turn = [0, 0, 0, 1];
      withoutRotation++;
    }
    const place = identity();
    multiply(place, transform, fromRotationTranslationScale(place, turn, translation(i), scale(i)));
    if (isFinite4x4(place)) places.push(place);
  }
  if (withoutRotation > 0) warn(withoutRotation, 'a rotation of length 0; they are not rotated');
  if (places.length < count) warn(count - places.length, 'a transform that is not finite; they are left out');
  return places;
}

/**
 * Index of the scene to show: the requested one, else the default one, else the first.
 * @throws {GltfError} `gltf/no-such-part` if the requested one does not exist.
 */
export function sceneToShow(
  { scenes, scene }: GltfJson,
  requested: number | string | undefined,
  file: string,
): number | undefined {
  if (requested === undefined) return scene ?? (scenes?.length ? 0 : undefined);
  return indexOf(scenes ?? [], requested, 'scene', file);
}

/** The index of a part by its index or name. @throws {GltfError} `gltf/no-such-part` */
export function indexOf(
  list: readonly { readonly name?: string }[],
  requested: number | string,
  kind: string,
  file: string,
): number {
  const index = typeof requested === 'number' ? requested : list.findIndex(({ name }) => name === requested);
  if (list[index]) return index;
  const names = list.slice(0, 8).map(({ name }, at) => (name === undefined ? `${at}` : `"${name}"`));
  throw new GltfError(
    'gltf/no-such-part',
    `${file} has no ${kind} ${typeof requested === 'number' ? requested : `"${requested}"`}; it has ${names.length === 0 ? 'none' : names.join(', ')}.`,
    { location: { file } },
  );
}
