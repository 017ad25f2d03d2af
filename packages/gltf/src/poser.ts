import {
  createScene,
  type Light,
  type Mesh,
  type MeshRig,
  type Scene,
  type SceneAnimation,
  type SceneWarning,
} from '@glanz/scene';
import { createRig, poseMesh } from '@glanz/scene/pose';
import { morphingNodes, posesAt, type NodePose } from './animation';
import { readPrimitive, withoutUnusedVertices } from './attributes';
import { checkDocument } from './check/index';
import { openContainer } from './container';
import { deformed, type Deformation } from './deform';
import { readDocument } from './document';
import { GltfError } from './error';
import { TextureTable } from './images';
import type { GltfJson, GltfMaterial, GltfNode, GltfPrimitive } from './json';
import type { Raw } from './json-value';
import { readLight } from './lights';
import { Budget, DEFAULT_LIMITS, type GltfLimits } from './limits';
import { atMoment, type LoadGltfOptions } from './load';
import { readMaterial, type UvSets } from './materials';
import { identity, isFinite4x4, type Matrix } from './matrix';
import { indexOf, instancesOf, isOpaque, placedNodes, sceneToShow, weightsOf, type Placed } from './nodes';
import { influencesOf, isSkinnable, jointMatrices, jointNumbers, skinOf, targetsOf, type Influences } from './pose';
import { openPrimitive, type PrimitiveData, type PrimitiveReader } from './primitive';
import { openSource, type GltfInput, type Source } from './source';
import { tangentSet } from './tangents';

/** What differs between two poses of a scene, by the indices of the scene's lists. */
export interface PoseChange {
  /** Object to world, 16 numbers, column-major; see `Instance.transform`. */
  readonly transforms: readonly { readonly instance: number; readonly transform: readonly number[] }[];
  /** Instances that appear or disappear (`KHR_node_visibility` under `KHR_animation_pointer`). */
  readonly visibility: readonly { readonly instance: number; readonly visible: boolean }[];
  /** Meshes that a skin or morph targets deform: same triangles, other vertices. */
  readonly meshes: readonly { readonly mesh: number; readonly deformed: Mesh }[];
  /** Lights with what they are now. */
  readonly lights: readonly { readonly index: number; readonly light: Light }[];
}

/** Options for {@link openAnimations}. */
export type OpenAnimationsOptions = Pick<
  LoadGltfOptions,
  'signal' | 'decoders' | 'limits' | 'baseUrl' | 'fetch' | 'credentials' | 'scene'
>;

/** What is read of a mesh once. */
interface Opened {
  readonly data: PrimitiveData;
  readonly base: Mesh;
  readonly influences: readonly Influences[] | undefined;
  /** What poses follow from, where all that a pose changes is where its vertices are. */
  readonly rig: MeshRig | undefined;
}

/** A mesh that a skin or morph targets deform. */
interface Deforming {
  readonly mesh: number;
  readonly node: number;
  readonly primitive: GltfPrimitive;
  readonly path: string;
  /** Index of a scene's instance that shows it. */
  readonly instance: number;
  opened?: Opened | undefined;
  /** The numbers that its shape follows from, as it was given last. */
  last?: readonly number[];
}

const same = (a: ArrayLike<number> | undefined, b: ArrayLike<number>): boolean => {
  if (a?.length !== b.length) return false;
  for (let i = 0; i < b.length; i++) if (a[i] !== b[i]) return false;
  return true;
};

/** Accessors that keep what they have read: every pose reads the same keys and moves. */
class KeptAccessors {
  readonly #reader: PrimitiveReader;
  readonly #floats = new Map<number, Float32Array<ArrayBuffer>>();

  constructor(reader: PrimitiveReader) {
    this.#reader = reader;
  }

  floats(index: number): Float32Array<ArrayBuffer> {
    const known = this.#floats.get(index) ?? this.#reader.accessors.floats(index);
    this.#floats.set(index, known);
    return known;
  }

  at(index: number) {
    return this.#reader.accessors.at(index);
  }
}

/**
 * Poses a scene by the animations of its document, and reports what changes from one pose to the next. Made by {@link
 * openAnimations}.
 */
export class ScenePoser {
  /** The document's animations, in its order, with the times of their last keys. */
  readonly animations: readonly SceneAnimation[];
  readonly #scene: Scene;
  readonly #reader: PrimitiveReader;
  readonly #source: Source;
  readonly #json: GltfJson;
  readonly #raw: Raw;
  readonly #shown: number | undefined;
  readonly #kept: KeptAccessors;
  readonly #deforming: readonly Deforming[];
  readonly #uvSets = new Map<number, UvSets>();
  readonly #binds = new Map<number, Float32Array | undefined>();
  #textures: TextureTable | undefined;
  #transforms: ArrayLike<number>[];
  #visible: boolean[];
  #lights: Light[];

  /** @internal Use {@link openAnimations}. */
  constructor(
    scene: Scene,
    source: Source,
    raw: Raw,
    json: GltfJson,
    reader: PrimitiveReader,
    shown: number | undefined,
  ) {
    this.#scene = scene;
    this.#source = source;
    this.#raw = raw;
    this.#json = json;
    this.#reader = reader;
    this.#shown = shown;
    this.#kept = new KeptAccessors(reader);
    this.#transforms = scene.instances.map(({ transform }) => transform);
    this.#visible = scene.instances.map(({ visible }) => visible !== false);
    this.#lights = [...scene.lights];
    this.animations = (json.animations ?? []).map(({ name, samplers }, index) => ({
      name: name ?? `animation ${index}`,
      duration: Math.max(
        0,
        ...samplers.map(({ input }) => this.#kept.floats(input).at(-1) ?? 0).filter(Number.isFinite),
      ),
    }));
    const morphing = morphingNodes(json);
    const deforming = new Map<number, Deforming>();
    scene.animatedParts?.forEach(([node, at], instance) => {
      const { mesh, skin } = json.nodes?.[node] ?? {};
      const primitive = mesh === undefined ? undefined : json.meshes?.[mesh]?.primitives[at];
      const shape = scene.instances[instance]?.mesh;
      if (!primitive || shape === undefined || deforming.has(shape)) return;
      if (!(skin !== undefined && isSkinnable(primitive)) && !morphing.has(node)) return;
      const path = `/meshes/${mesh}/primitives/${at}`;
      deforming.set(shape, { mesh: shape, node, primitive, path, instance });
    });
    this.#deforming = [...deforming.values()];
  }

  /**
   * The pose of an animation at a time, as what differs from the pose before; at first, from the scene as it was
   * loaded.
   *
   * @param animation Its index or name; undefined: the rest pose.
   * @param time Seconds from its start, clamped to its first and last key.
   * @throws {GltfError} `gltf/no-such-part` where there is no such animation, or the time is not finite.
   */
  pose(animation: number | string | undefined, time = 0): PoseChange {
    const { file } = this.#reader;
    const all = this.#json.animations ?? [];
    const chosen = animation === undefined ? undefined : all[indexOf(all, animation, 'animation', file)];
    if (!Number.isFinite(time))
      throw new GltfError(
        'gltf/no-such-part',
        `The time for ${file} is ${time}; it must be a finite number of seconds.`,
      );
    const json = atMoment(this.#json, this.#raw, chosen, time, { file, accessors: this.#kept }, []);
    const poses = chosen ? posesAt(chosen, time, this.#kept, () => undefined) : new Map<number, NodePose>();
    const placed = placedNodes({ json, shown: this.#shown, poses });
    return {
      ...this.#placements(json, placed),
      meshes: this.#shapes(json, placed, poses),
      lights: this.#lightChanges(json, placed),
    };
  }

  #placements(json: GltfJson, placed: ReadonlyMap<number, Placed>): Pick<PoseChange, 'transforms' | 'visibility'> {
    const transforms: { instance: number; transform: Matrix }[] = [];
    const visibility: { instance: number; visible: boolean }[] = [];
    /** Instances of a node with EXT_mesh_gpu_instancing. */
    const several = new Map<number, Matrix[]>();
    const taken = new Map<string, number>();
    this.#scene.animatedParts?.forEach(([index, at], instance) => {
      const place = placed.get(index);
      const node = json.nodes?.[index];
      const primitive = node?.mesh === undefined ? undefined : json.meshes?.[node.mesh]?.primitives[at];
      if (!place || !node || !primitive) return;
      let transform: Matrix | undefined = place.world;
      if (node.skin !== undefined && isSkinnable(primitive)) transform = identity();
      else if (node.extensions?.EXT_mesh_gpu_instancing) {
        const places = several.get(index) ?? this.#instancesOf(node, place.world, index);
        several.set(index, places);
        const number = taken.get(`${index} ${at}`) ?? 0;
        taken.set(`${index} ${at}`, number + 1);
        transform = places[number];
      }
      if (transform && isFinite4x4(transform) && !same(this.#transforms[instance], transform)) {
        this.#transforms[instance] = transform;
        transforms.push({ instance, transform });
      }
      if (this.#visible[instance] !== place.visible)
        visibility.push({ instance, visible: (this.#visible[instance] = place.visible) });
    });
    return { transforms, visibility };
  }

  #instancesOf(node: GltfNode, world: Matrix, index: number): Matrix[] {
    const { file } = this.#reader;
    const context = { reader: this.#reader, scene: createScene(), instances: new Budget(file, 'instances', undefined) };
    return instancesOf(context, node, world, index);
  }

  #shapes(
    json: GltfJson,
    placed: ReadonlyMap<number, Placed>,
    poses: ReadonlyMap<number, NodePose>,
  ): PoseChange['meshes'] {
    const warnings: SceneWarning[] = [];
    const world = new Map([...placed].map(([node, { world: at }]) => [node, at]));
    const joints = new Map<number, readonly (Matrix | undefined)[]>();
    const jointsOf = (index: number) => {
      const { joints: list = [], inverseBindMatrices: bind } = json.skins?.[index] ?? {};
      if (!this.#binds.has(index))
        this.#binds.set(index, bind === undefined ? undefined : this.#reader.accessors.floats(bind, 16));
      const known = joints.get(index) ?? jointMatrices('', list, this.#binds.get(index), world, warnings);
      joints.set(index, known);
      return known;
    };
    const meshes: { mesh: number; deformed: Mesh }[] = [];
    for (const part of this.#deforming) {
      const node = (json.nodes as readonly GltfNode[])[part.node] as GltfNode;
      const weights = weightsOf(node, json.meshes?.[node.mesh as number], poses.get(part.node));
      const matrices = node.skin !== undefined && isSkinnable(part.primitive) ? jointsOf(node.skin) : undefined;
      const numbers = [...weights, ...(matrices ?? []).flatMap((matrix) => matrix ?? [])];
      if (same(part.last, numbers)) continue;
      part.last = numbers;
      const opened = (part.opened ??= this.#open(part, matrices));
      if (!opened) continue;
      const { data, base, influences, rig } = opened;
      const pose = rig && { joints: matrices && jointNumbers(matrices), weights: weights.slice(0, rig.targets.length) };
      if (pose && (pose.joints ?? []).every(Number.isFinite)) {
        meshes.push({ mesh: part.mesh, deformed: poseMesh(rig, pose) });
        continue;
      }
      const skin: Deformation['skin'] = matrices && influences && { matrices, influences };
      const made = deformed(base, data, { weights, skin }, this.#materialsOf(part), part.path, warnings);
      meshes.push({ mesh: part.mesh, deformed: made });
    }
    return meshes;
  }

  /** Reads a mesh that is deformed for the first time. */
  #open(part: Deforming, matrices: readonly (Matrix | undefined)[] | undefined): Opened | undefined {
    const { mesh, primitive, path, instance } = part;
    const warnings: SceneWarning[] = [];
    const { name } = this.#scene.meshes[mesh] as Mesh;
    const { material } = this.#scene.instances[instance] as Scene['instances'][number];
    const opened = openPrimitive(primitive, path, this.#reader);
    const base = readPrimitive(
      opened,
      name,
      isOpaque(this.#scene.materials[material]),
      this.#uvSetsOf(primitive.material),
      path,
      warnings,
    );
    if (!base) return undefined;
    const targets = new Map<string, Float32Array<ArrayBuffer> | undefined>();
    const data: PrimitiveData = {
      ...opened,
      target: (index, semantic) => {
        const key = `${index} ${semantic}`;
        if (!targets.has(key)) targets.set(key, opened.target(index, semantic));
        return targets.get(key);
      },
    };
    const influences = matrices && influencesOf(name, opened, base.positions.length / 3, matrices.length, warnings);
    return { data, base, influences, rig: this.#rigOf(part, data, base, influences, matrices) };
  }

  /** Undefined where vertices are left out, or tangents are computed for each pose. */
  #rigOf(
    part: Deforming,
    data: PrimitiveData,
    base: Mesh,
    influences: readonly Influences[] | undefined,
    matrices: readonly (Matrix | undefined)[] | undefined,
  ): MeshRig | undefined {
    const hasTangents =
      base.tangents !== undefined || this.#materialsOf(part).every((material) => tangentSet(material) === undefined);
    if (!hasTangents || withoutUnusedVertices(base) !== base) return undefined;
    try {
      const skin = matrices && influences?.length ? skinOf(influences, matrices) : undefined;
      return createRig(base, { skin, targets: targetsOf(data) });
    } catch {
      // Targets of another length or with numbers that are not finite: only the loader's own way takes them.
      return undefined;
    }
  }

  #uvSetsOf(material: number | undefined): UvSets {
    const index = material ?? -1;
    let sets = this.#uvSets.get(index);
    if (!sets) {
      this.#textures ??= new TextureTable(this.#json, this.#source, []);
      ({ uvSets: sets } = readMaterial(
        this.#json.materials?.[index] ?? ({} as GltfMaterial),
        index,
        this.#textures,
        [],
      ));
      this.#uvSets.set(index, sets);
    }
    return sets;
  }

  #materialsOf({ instance }: Deforming) {
    const { material, variants = {} } = this.#scene.instances[instance] as Scene['instances'][number];
    return [material, ...Object.values(variants)].map((index) => this.#scene.materials[index]);
  }

  #lightChanges(json: GltfJson, placed: ReadonlyMap<number, Placed>): PoseChange['lights'] {
    if (this.#lights.length === 0) return [];
    const now = createScene();
    for (const [index, { world, visible }] of placed) {
      const { name = '', extensions } = (json.nodes as readonly GltfNode[])[index] as GltfNode;
      const light = json.extensions?.KHR_lights_punctual?.lights[extensions?.KHR_lights_punctual?.light ?? -1];
      if (light && visible && isFinite4x4(world)) readLight(light, name, world, now);
    }
    // A light that is hidden has no index.
    if (now.lights.length !== this.#lights.length) return [];
    const changes = now.lights.flatMap((light, index) =>
      JSON.stringify(light) === JSON.stringify(this.#lights[index]) ? [] : [{ index, light }],
    );
    this.#lights = now.lights;
    return changes;
  }
}

/**
 * Opens the animations of a document whose scene has been loaded, to pose that scene at any time. Reads the document
 * again, without its images; meshes that no animation deforms are not read.
 *
 * Nodes, skins, morph weights, lights and visibility are posed. Animated materials and cameras (`KHR_animation_pointer`)
 * stay as they were loaded.
 *
 * @param input What the scene was loaded from.
 * @param scene As `loadGltf` or a worker gave it.
 * @throws {GltfError} As `loadGltf`; `gltf/no-such-part` for a scene that no animated document was loaded into.
 * @example
 * const poser = await openAnimations('robot.glb', scene);
 * for (const { instance, transform } of poser.pose('walk', 0.5).transforms)
 *   await tracer.setInstanceTransform(instance, transform);
 */
export async function openAnimations(
  input: GltfInput,
  scene: Scene,
  options: OpenAnimationsOptions = {},
): Promise<ScenePoser> {
  const { signal, limits }: { readonly signal?: AbortSignal | undefined; readonly limits?: GltfLimits | undefined } =
    options;
  const source = await openSource(input, {
    fetch: options.fetch ?? globalThis.fetch,
    baseUrl: options.baseUrl,
    credentials: options.credentials,
    signal,
    maxBytes: limits?.fileBytes ?? DEFAULT_LIMITS.fileBytes,
    onBytes: () => undefined,
  });
  signal?.throwIfAborted();
  return animationsOf(source, scene, options);
}

/** Opens the animations of an opened source; shared by all loaders. */
export async function animationsOf(
  source: Source,
  scene: Scene,
  options: Pick<OpenAnimationsOptions, 'signal' | 'decoders' | 'limits' | 'scene'>,
): Promise<ScenePoser> {
  if (scene.animatedParts?.length !== scene.instances.length)
    throw new GltfError('gltf/no-such-part', `${source.name} has no animations that were loaded with its scene.`, {
      location: { file: source.name },
    });
  const warnings: SceneWarning[] = [];
  const container = openContainer(source.bytes, source.name, warnings);
  const checked = checkDocument(container.json, source.name, warnings);
  const reader = await readDocument(checked, container.binary, source, options, warnings);
  const shown = sceneToShow(checked.json, options.scene, source.name);
  return new ScenePoser(scene, source, container.json, checked.json, reader, shown);
}
