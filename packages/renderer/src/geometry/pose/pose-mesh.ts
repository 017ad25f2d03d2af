import type { Blas } from '@glanz/bvh';
import { blasInOrder } from '@glanz/bvh/gpu';
import { refitBlas } from '@glanz/bvh/refit';
import type { Instance, Mesh, MeshRig } from '@glanz/scene';
import type { Hierarchy, MeshRegion } from '../hierarchy';
import { packPose } from './rig-data';
import { RigPoser, suitsPoser } from './rig-poser';
import type { ShapeArray } from '../../storage/shape-arrays';
import type { PosedGeometry, PoseHost, PosingChange, WriteMesh } from './pose-host';

/** What poses the rig that a mesh of a scene shows. */
interface Posing {
  readonly rig: MeshRig;
  /** Undefined: the GPU has no memory for it. */
  readonly poser: Promise<RigPoser | undefined>;
  isRefused?: boolean;
  /** Meshes that have been built again, since the hierarchy of the poser has become too bad for them. */
  readonly rebuilt: WeakSet<Mesh>;
}

type Posable = Pick<PoseHost, 'scene' | 'builders' | 'trees'>;

/** By the mesh that they are for. */
const posings = new WeakMap<Posable, Map<number, Posing>>();

/** Errors of a GPU without memory for a rig, whose vertices the CPU can compute. */
const NO_MEMORY = /^(bvh\/(limit|memory)|renderer\/(limit|out-of-memory))$/;

/**
 * Puts a mesh that shows one pose of a rig into another one, on the GPU.
 *
 * @returns Undefined where the mesh is to be replaced as others are: it shows something else, its hierarchy needs a
 * rebuild, or the GPU has no memory for the rig.
 */
export async function poseOnGpu<G extends PosedGeometry>(
  editor: PoseHost<G>,
  index: number,
  mesh: Mesh,
  write: WriteMesh,
): Promise<PosingChange | undefined> {
  const { scene, gpu, builders, trees } = editor;
  const { pose } = mesh;
  if (!builders.gpu || !pose || editor.geometry.compact) return undefined;
  const packed = packPose(pose);
  const posing = await posingFor(editor, index, pose.rig);
  const poser = await posing?.poser;
  const present = scene.meshes[index] as Mesh;
  // Another edit may have come meanwhile, and discarded it.
  if (posing && posings.get(editor)?.get(index) !== posing) return poseOnGpu(editor, index, mesh, write);
  if (!posing || !poser || !packed || present.pose?.rig !== pose.rig) return undefined;
  if (poser.needsRebuild && !scene.meshes.includes(mesh)) {
    // A mesh that was shown before has a hierarchy: it is built again all the same, once.
    if (!posing.rebuilt.has(mesh)) trees.delete(mesh);
    posing.rebuilt.add(mesh);
    return undefined;
  }
  const { geometry } = editor;
  const region = geometry.regions[index] as MeshRegion;
  const { base } = poser;
  if (region.nodes < base.nodeCount || region.triangles < base.triangleIndices.length) return undefined;
  const before = present.pose;
  const { placement } = geometry;
  const tree: Hierarchy = {
    nodeCount: base.nodeCount,
    triangleIndices: base.triangleIndices,
    bounds: poser.boundsOf(pose),
    gpu: onDemand(base, mesh),
  };
  trees.set(mesh, tree);
  const blas = geometry.blas.with(index, tree);
  const next: G = { ...geometry, blas };
  const which = instancesOf(scene.instances, index);
  const arrayOf = (name: ShapeArray) => gpu.shapes(name);
  const change = editor.commit({ ...scene, meshes: scene.meshes.with(index, mesh) }, next, () => {
    placement.update(scene, blas, which, true);
    poser.run(packed, arrayOf, region);
    const changes = which.map((i) => {
      const instance = scene.instances[i] as Instance;
      return { index: i, before: instance, after: instance };
    });
    return gpu.updateInstances(next, changes);
  });
  return {
    ...change,
    undo: () => {
      change.undo();
      placement.update(scene, geometry.blas, which, true);
    },
    rewrite: () => {
      // A later edit, taken back before this one, has destroyed the poser.
      const last = poser.isDestroyed ? undefined : packPose(before);
      if (last) poser.run(last, arrayOf, region);
      else write(present, fitted(base, present), region);
    },
  };
}

/**
 * What poses the rig that a mesh of the scene shows; made from the hierarchy that it has. Undefined where it shows
 * something else.
 */
async function posingFor(editor: Posable, index: number, rig: MeshRig): Promise<Posing | undefined> {
  const own = posings.get(editor) ?? new Map<number, Posing>();
  posings.set(editor, own);
  const shown = editor.scene.meshes[index] as Mesh;
  if (shown.pose?.rig !== rig) return undefined;
  let posing = own.get(index);
  // Edits that were taken back leave the poser of another rig.
  if (posing && posing.rig !== rig) discard(own, index, posing);
  posing = own.get(index);
  if (!posing) {
    posing = { rig, poser: makePoser(editor, shown, rig), rebuilt: new WeakSet() };
    own.set(index, posing);
  }
  try {
    posing.isRefused = !(await posing.poser);
  } catch (error) {
    if (own.get(index) === posing) own.delete(index);
    throw error;
  }
  return posing;
}

function discard(own: Map<number, Posing>, index: number, { poser }: Posing): void {
  own.delete(index);
  poser.then(
    (made) => made?.destroy(),
    () => undefined,
  );
}

/**
 * Frees what poses a mesh whose vertices and hierarchy a change has replaced. If the GPU has no memory to pose the rig,
 * that is remembered as long as the mesh shows it.
 */
export function discardPoser(editor: Posable, index: number): void {
  const own = posings.get(editor);
  const posing = own?.get(index);
  if (!own || !posing) return;
  const shown = editor.scene.meshes[index] as Mesh;
  if (!posing.isRefused || shown.pose?.rig !== posing.rig) discard(own, index, posing);
}

async function makePoser({ builders, trees }: Posable, shown: Mesh, rig: MeshRig): Promise<RigPoser | undefined> {
  const tree = trees.get(shown);
  if (!builders.gpu || !tree || tree.triangleIndices.length === 0) return undefined;
  const base = tree.nodes ? (tree as Blas) : await tree.gpu?.read();
  // Its place on the GPU is overwritten by the poses.
  if (base && trees.get(shown) === tree) trees.set(shown, base);
  if (!base || !suitsPoser(builders.gpu, rig, base)) return undefined;
  return RigPoser.create(builders.gpu, rig, base).catch((error: unknown) => {
    if (NO_MEMORY.test(String((error as { readonly code?: unknown }).code))) return undefined;
    throw error;
  });
}

/** A hierarchy with its boxes fitted to a pose, on the CPU. */
function fitted(base: Blas, mesh: Mesh): Blas {
  const { min, max } = base.bounds;
  const result = { ...base, nodes: base.nodes.slice(), bounds: { min: min.slice(), max: max.slice() } };
  refitBlas(result, mesh);
  return result;
}

/** The hierarchy of a pose, for edits and queries on the CPU, which rarely need it. */
function onDemand(base: Blas, mesh: Mesh): NonNullable<Hierarchy['gpu']> {
  let queries: Blas | undefined;
  return {
    place: () => undefined,
    read: async () => fitted(base, mesh),
    forQueries: () => (queries ??= blasInOrder(mesh, base.triangleIndices as Uint32Array<ArrayBuffer>)),
    free: () => undefined,
  };
}

/** Instances of a mesh, which no edit changes, by the list that they are in. */
const instanceLists = new WeakMap<readonly Instance[], Map<number, readonly number[]>>();

function instancesOf(instances: readonly Instance[], mesh: number): readonly number[] {
  const known = instanceLists.get(instances) ?? new Map<number, readonly number[]>();
  instanceLists.set(instances, known);
  const found = known.get(mesh) ?? instances.flatMap((instance, i) => (instance.mesh === mesh ? [i] : []));
  known.set(mesh, found);
  return found;
}
