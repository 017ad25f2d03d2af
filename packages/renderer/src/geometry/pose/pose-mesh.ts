import type { Blas } from '@glanz/bvh';
import { blasInOrder } from '@glanz/bvh/gpu';
import { refitBlas } from '@glanz/bvh/refit';
import type { Instance, Mesh, MeshRig } from '@glanz/scene';
import type { Hierarchy, MeshRegion } from '../hierarchy';
import { packPose } from './rig-data';
import { RigPoser, suitsPoser } from './rig-poser';
import type { ShapeArray } from '../../storage/shape-arrays';
import type { PosedGeometry, PoseHost, PosingChange } from './pose-host';

/** What poses the rig that a mesh of a scene shows; without a poser: the GPU has no room for it. */
interface Posing {
  readonly rig: MeshRig;
  readonly poser: RigPoser | undefined;
}

type Posable = Pick<PoseHost, 'scene' | 'builders' | 'trees'>;

/** By the mesh that they are for. */
const posings = new WeakMap<Posable, Map<number, Promise<Posing>>>();

/** Errors of a GPU without room for a rig, whose vertices the CPU can compute. */
const NO_ROOM = /^(bvh\/(limit|memory)|renderer\/(limit|out-of-memory))$/;

/**
 * Puts a mesh that shows one pose of a rig into another one, on the GPU.
 *
 * @returns Undefined where the mesh is to be replaced as others are: it shows something else, its hierarchy needs a
 * rebuild, or the GPU has no room for the rig.
 */
export async function poseOnGpu<G extends PosedGeometry>(
  editor: PoseHost<G>,
  index: number,
  mesh: Mesh,
): Promise<PosingChange | undefined> {
  const { scene, gpu, builders, trees } = editor;
  const { pose } = mesh;
  if (!builders.gpu || !pose) return undefined;
  const packed = packPose(pose);
  const poser = await poserFor(editor, index, pose.rig);
  const present = scene.meshes[index] as Mesh;
  // Another edit may have come meanwhile.
  if (!poser || !packed || present.pose?.rig !== pose.rig) return undefined;
  if ((editor.geometry.regions[index] as MeshRegion).nodes < poser.base.nodeCount) return undefined;
  const before = present.pose;
  const { geometry } = editor;
  const { placement } = geometry;
  const { base } = poser;
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
    poser.run(packed, arrayOf, next.regions[index] as MeshRegion);
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
      const last = packPose(before);
      if (last) poser.run(last, arrayOf, geometry.regions[index] as MeshRegion);
    },
  };
}

/** What poses the rig that a mesh of the scene shows; made from the hierarchy that it has. */
async function poserFor(editor: Posable, index: number, rig: MeshRig): Promise<RigPoser | undefined> {
  const own = posings.get(editor) ?? new Map<number, Promise<Posing>>();
  posings.set(editor, own);
  const known = own.get(index);
  const found = await known;
  // Another call has made one meanwhile.
  if (own.get(index) !== known) return poserFor(editor, index, rig);
  const shown = editor.scene.meshes[index] as Mesh;
  const isShown = shown.pose?.rig === rig;
  if (found?.rig === rig && isShown && !found.poser?.needsRebuild) return found.poser;
  found?.poser?.destroy();
  own.delete(index);
  // A hierarchy that needs it is built again, for this pose; the next one has a poser again.
  if (!isShown || found?.poser?.needsRebuild) return undefined;
  const made = makePoser(editor, shown, rig).then((poser) => ({ rig, poser }));
  own.set(index, made);
  made.catch(() => own.delete(index));
  return (await made).poser;
}

async function makePoser({ builders, trees }: Posable, shown: Mesh, rig: MeshRig): Promise<RigPoser | undefined> {
  const tree = trees.get(shown);
  if (!builders.gpu || !tree || tree.triangleIndices.length === 0) return undefined;
  const base = tree.nodes ? (tree as Blas) : await tree.gpu?.read();
  if (!base || !suitsPoser(builders.gpu, rig, base)) return undefined;
  return RigPoser.create(builders.gpu, rig, base).catch((error: unknown) => {
    if (NO_ROOM.test(String((error as { readonly code?: unknown }).code))) return undefined;
    throw error;
  });
}

/** The hierarchy of a pose, for edits and queries on the CPU, which ask for it seldom. */
function onDemand(base: Blas, mesh: Mesh): NonNullable<Hierarchy['gpu']> {
  let queries: Blas | undefined;
  return {
    place: () => undefined,
    read: async () => {
      const { min, max } = base.bounds;
      const fitted = { ...base, nodes: base.nodes.slice(), bounds: { min: min.slice(), max: max.slice() } };
      refitBlas(fitted, mesh);
      return fitted;
    },
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
