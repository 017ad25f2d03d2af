import { fromRotationTranslationScale, invert, multiply } from 'gl-matrix/esm/mat4.js';
import type { Scene } from '@glanz/scene';
import type { State } from '../state/state';
// Places moved parts.
import '../viewer/moves';
import { placedTransform } from '../viewer/placement';
import { asNodes, type Trs } from './trs';

type Json = Record<string, unknown>;

interface JsonNode {
  readonly name?: string;
  readonly mesh?: number;
  readonly skin?: number;
  readonly camera?: number;
  readonly weights?: readonly number[];
  readonly children?: readonly number[];
  readonly matrix?: readonly number[];
  readonly translation?: readonly number[];
  readonly rotation?: readonly number[];
  readonly scale?: readonly number[];
  readonly extensions?: Readonly<Record<string, unknown>>;
}

interface JsonMesh {
  readonly primitives: readonly unknown[];
}

interface JsonChannel {
  readonly target: {
    readonly node?: number;
    readonly path: string;
    readonly extensions?: { readonly KHR_animation_pointer?: { readonly pointer?: string } };
  };
}

interface JsonAnimation {
  readonly channels: readonly JsonChannel[];
}

interface Document extends Json {
  readonly nodes?: readonly JsonNode[];
  readonly meshes?: readonly JsonMesh[];
  readonly animations?: readonly JsonAnimation[];
  readonly skins?: readonly { readonly joints?: readonly number[]; readonly skeleton?: number }[];
}

/** A document with the moves of parts, and what it cannot say of them. */
export interface MovedDocument {
  readonly json: Json;
  /** Parts whose moves are not in it. */
  readonly unsaved: readonly number[];
  /** Parts that an animation moves or turns: their moves follow it, in the axes of their nodes. */
  readonly animated: readonly number[];
}

const INSTANCING = 'EXT_mesh_gpu_instancing';

const matrix = () => new Array<number>(16);
const isFinite4x4 = (m: ArrayLike<number>) => Array.from(m).every(Number.isFinite);

const localOf = (node: JsonNode): readonly number[] =>
  node.matrix ??
  fromRotationTranslationScale(
    matrix(),
    node.rotation ?? [0, 0, 0, 1],
    node.translation ?? [0, 0, 0],
    node.scale ?? [1, 1, 1],
  );

/** What an animation, a skin or an extension of the document says of its nodes. */
class Nodes {
  readonly #nodes: readonly JsonNode[];
  readonly #parents = new Map<number, number>();
  /** Nodes that animations place, and those that joints are. */
  readonly #placed = new Set<number>();
  readonly #joints = new Set<number>();
  /** Pointers that animations write to. */
  readonly #pointers: readonly string[];

  constructor({ nodes = [], animations = [], skins = [] }: Document) {
    this.#nodes = nodes;
    nodes.forEach(({ children = [] }, index) => {
      for (const child of children) if (!this.#parents.has(child)) this.#parents.set(child, index);
    });
    const targets = animations.flatMap(({ channels }) => channels.map(({ target }) => target));
    this.#pointers = targets.map(({ extensions }) => extensions?.KHR_animation_pointer?.pointer ?? '');
    for (const { node, path } of targets)
      if (node !== undefined && ['translation', 'rotation', 'scale'].includes(path)) this.#placed.add(node);
    for (const pointer of this.#pointers) {
      const [, node] = /^\/nodes\/(\d+)\/(translation|rotation|scale|matrix)/.exec(pointer) ?? [];
      if (node !== undefined) this.#placed.add(Number(node));
    }
    for (const { joints = [], skeleton } of skins)
      for (const joint of skeleton === undefined ? joints : [...joints, skeleton]) this.#joints.add(joint);
  }

  /** A node and those above it, the outermost last. */
  path(index: number): number[] {
    const found: number[] = [];
    for (let at: number | undefined = index; at !== undefined && !found.includes(at); at = this.#parents.get(at))
      found.push(at);
    return found;
  }

  world(index: number): number[] {
    return this.path(index).reduce(
      (below, at) => multiply(matrix(), localOf(this.#nodes[at] as JsonNode), below),
      [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    );
  }

  isAnimated(index: number): boolean {
    return this.path(index).some((at) => this.#placed.has(at));
  }

  /** Whether nothing but its mesh follows from where a node is. */
  isFree(index: number): boolean {
    const { camera, children = [], extensions = {} } = this.#nodes[index] as JsonNode;
    return (
      camera === undefined &&
      children.length === 0 &&
      Object.keys(extensions).every((name) => name === 'KHR_node_visibility') &&
      !this.#placed.has(index) &&
      !this.#joints.has(index)
    );
  }

  /** Whether an animation points at what moves from a node to others with its mesh. */
  isPointedAt(index: number): boolean {
    const { mesh } = this.#nodes[index] as JsonNode;
    return this.#pointers.some(
      (pointer) => pointer.startsWith(`/nodes/${index}/weights`) || pointer.startsWith(`/meshes/${mesh}/`),
    );
  }
}

/** Primitives of a node that have one place, relative to the node; without one they stay where they are. */
interface Placed {
  readonly local: readonly number[] | undefined;
  readonly primitives: number[];
}

/** Where a node's primitives come to lie; undefined where nodes cannot say it. */
function placesOf(
  index: number,
  document: Document,
  nodes: Nodes,
  parts: readonly { readonly instance: number; readonly primitive: number }[],
  scene: Scene,
  moves: State['moves'],
): Placed[] | undefined {
  const { mesh, skin, extensions } = document.nodes?.[index] ?? {};
  const count = document.meshes?.[mesh ?? -1]?.primitives.length;
  // The joints place what has a skin.
  if (count === undefined || skin !== undefined || nodes.isPointedAt(index)) return undefined;
  const several = extensions?.[INSTANCING] !== undefined;
  const read = new Set(parts.map(({ primitive }) => primitive));
  if (several && (nodes.isAnimated(index) || read.size < count)) return undefined;
  const inverse = several ? invert(matrix(), nodes.world(index)) : undefined;
  if (inverse === null) return undefined;
  const places = new Map<string, Placed>();
  const put = (local: readonly number[] | undefined, primitive: number) => {
    const key = String(local);
    const place = places.get(key) ?? { local, primitives: [] };
    places.set(key, place);
    place.primitives.push(primitive);
  };
  for (const { instance, primitive } of parts) {
    const now = placedTransform(scene, instance, moves);
    if (inverse) put(multiply(matrix(), inverse, now), primitive);
    else if (!moves[instance]) put(undefined, primitive);
    else {
      const back = invert(matrix(), scene.instances[instance]?.transform ?? []);
      const local = back && multiply(matrix(), back, now);
      if (!local || !isFinite4x4(local)) return undefined;
      put(local, primitive);
    }
  }
  // Lines and points, which are no parts, stay.
  for (let primitive = 0; primitive < count; primitive++) if (!read.has(primitive)) put(undefined, primitive);
  return [...places.values()];
}

/** Writes nodes with moved parts into a document. */
class Writer {
  readonly nodes: JsonNode[];
  readonly meshes: JsonMesh[];
  /** Nodes that have the mesh of a former one now, whose weights are animated. */
  readonly carriers = new Map<number, number[]>();
  readonly #subsets = new Map<string, number>();

  constructor({ nodes = [], meshes = [] }: Document) {
    this.nodes = [...nodes];
    this.meshes = [...meshes];
  }

  /** Moves a node itself. */
  place(index: number, trs: Trs): void {
    const { matrix: _, ...others } = this.nodes[index] as JsonNode;
    this.nodes[index] = { ...others, ...trs };
  }

  /** Gives a node a child for each place that its primitives have. */
  split(index: number, places: readonly Placed[]): void {
    const { mesh, weights, extensions, ...others } = this.nodes[index] as JsonNode & { readonly mesh: number };
    const { [INSTANCING]: _, ...otherExtensions } = extensions ?? {};
    const carriers: number[] = [];
    const children: number[] = [];
    const shape = (primitives: readonly number[]) => ({
      mesh: this.#subset(mesh, primitives),
      ...(weights ? { weights } : {}),
    });
    let own: Pick<JsonNode, 'mesh' | 'weights'> = {};
    for (const { local, primitives } of places) {
      if (!local) {
        own = shape(primitives);
        carriers.push(index);
        continue;
      }
      const name = others.name === undefined ? {} : { name: others.name };
      const [outer, inner] = asNodes(local);
      const leaf = this.nodes.push({ ...name, ...(inner ?? outer), ...shape(primitives) }) - 1;
      carriers.push(leaf);
      children.push(inner ? this.nodes.push({ ...name, ...outer, children: [leaf] }) - 1 : leaf);
    }
    this.nodes[index] = {
      ...others,
      ...own,
      ...(Object.keys(otherExtensions).length > 0 ? { extensions: otherExtensions } : {}),
      children: [...children, ...(others.children ?? [])],
    };
    this.carriers.set(index, carriers);
  }

  #subset(mesh: number, primitives: readonly number[]): number {
    const whole = this.meshes[mesh] as JsonMesh;
    const list = [...new Set(primitives)].sort((a, b) => a - b);
    if (list.length === whole.primitives.length) return mesh;
    const key = `${mesh}:${list}`;
    const known = this.#subsets.get(key);
    if (known !== undefined) return known;
    const made = this.meshes.push({ ...whole, primitives: list.map((at) => whole.primitives[at]) }) - 1;
    this.#subsets.set(key, made);
    return made;
  }

  /** Animations of weights, for all nodes that have the mesh now. */
  animations(before: readonly JsonAnimation[]): JsonAnimation[] {
    return before.map((animation) => ({
      ...animation,
      channels: animation.channels.flatMap((channel) => {
        const carriers = channel.target.path === 'weights' && this.carriers.get(channel.target.node ?? -1);
        return carriers ? carriers.map((node) => ({ ...channel, target: { ...channel.target, node } })) : [channel];
      }),
    }));
  }
}

/** Takes instancing out of the document's extensions where no node has it any more. */
function withoutUnused(json: Json): Json {
  if ((json['nodes'] as readonly JsonNode[]).some(({ extensions }) => extensions?.[INSTANCING])) return json;
  const result = { ...json };
  for (const key of ['extensionsUsed', 'extensionsRequired']) {
    const names = (json[key] as readonly string[] | undefined)?.filter((name) => name !== INSTANCING);
    // A list without entries is invalid.
    if (names?.length) result[key] = names;
    else delete result[key];
  }
  return result;
}

/**
 * A glTF document in which parts are where the user has moved them. A node whose only content moves is moved itself; of
 * others, moved primitives become children of their own, which share the data of the mesh. What else the node places,
 * such as its children, a camera or a light, stays.
 *
 * @param json The document.
 * @param scene As it was loaded from it with the option `partNodes`, in the pose that is shown.
 * @param moves By index of the part.
 */
export function patchMoves(json: Json, scene: Scene, moves: State['moves']): MovedDocument {
  const document = json as Document;
  const nodes = new Nodes(document);
  const writer = new Writer(document);
  const partsOf = new Map<number, { instance: number; primitive: number }[]>();
  scene.animatedParts?.forEach(([node, primitive], instance) => {
    const list = partsOf.get(node) ?? [];
    list.push({ instance, primitive });
    partsOf.set(node, list);
  });
  const unsaved: number[] = [];
  const animated: number[] = [];
  for (const [index, parts] of partsOf) {
    const moved = parts.map(({ instance }) => instance).filter((instance) => moves[instance]);
    if (moved.length === 0) continue;
    const places = placesOf(index, document, nodes, parts, scene, moves);
    if (!places) {
      unsaved.push(...moved);
      continue;
    }
    if (nodes.isAnimated(index)) animated.push(...moved);
    const [first, ...others] = places;
    const itself =
      first?.local && others.length === 0 && nodes.isFree(index)
        ? asNodes(multiply(matrix(), localOf(writer.nodes[index] as JsonNode), first.local))
        : [];
    if (itself.length === 1) writer.place(index, itself[0] as Trs);
    else writer.split(index, places);
  }
  const { animations } = document;
  const patched = {
    ...json,
    nodes: writer.nodes,
    ...(document.meshes ? { meshes: writer.meshes } : {}),
    ...(animations ? { animations: writer.animations(animations) } : {}),
  };
  return { json: withoutUnused(patched), unsaved, animated };
}
