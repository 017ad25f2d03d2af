import type { checkScene, createScene, Mesh, Scene } from '@glanz/scene';
import type { notFound } from '../errors';
import type { attributeWords, Geometry, layOutGeometry, meshSlices } from '../geometry/geometry';
import type { loadGpuTrees } from '../geometry/hierarchies';
import type { Hierarchy, MeshRegion } from '../geometry/hierarchy';
import type { PoseHost } from '../geometry/pose/pose-host';
import type { GpuScene } from './gpu-scene';
import type { SceneChange } from './scene-change';

/** What this chunk uses of the code that is there already; imported, it would move to chunks that both share. */
type Tools = readonly [
  typeof attributeWords,
  typeof createScene,
  typeof layOutGeometry,
  typeof loadGpuTrees,
  typeof meshSlices,
  typeof notFound,
  typeof checkScene,
];

/** What it uses of the editor. */
interface MeshHost extends PoseHost<Geometry> {
  readonly gpu: GpuScene;
  blas(scene: Scene): (Hierarchy | undefined)[];
  build(scene: Scene, read: readonly Mesh[]): Promise<void>;
  reshape(changed: () => Scene): Promise<SceneChange>;
}

const NO_POSES: Partial<Awaited<ReturnType<typeof loadGpuTrees>>> = {};

/** The change of a tracer that was destroyed. */
const NOTHING: SceneChange = { isStale: () => false, apply: () => false, undo: () => undefined };

/** See `PathTracer.replaceMesh`. */
export async function replaceMesh(
  editor: MeshHost,
  tools: Tools,
  nameOrIndex: string | number,
  mesh: Mesh,
): Promise<SceneChange> {
  const [, createScene, , loadGpuTrees, meshSlices, notFound, checkScene] = tools;
  const { scene } = editor;
  const index =
    typeof nameOrIndex === 'number' ? nameOrIndex : scene.meshes.findIndex(({ name }) => name === nameOrIndex);
  if (!scene.meshes[index]) throw notFound('renderer/mesh', nameOrIndex, scene.meshes);
  const isPosed = () => mesh.pose ?? scene.meshes[index]?.pose;
  const { poseOnGpu, discardPoser } = editor.builders.gpu && isPosed() ? await loadGpuTrees() : NO_POSES;
  const posed = await poseOnGpu?.(editor, index, mesh, (before, tree, region) =>
    editor.gpu.writeShapes(meshSlices(index, before, tree, region, undefined)),
  ).catch((error: unknown) => {
    // The edit ends without an error, as all do that the tracer is destroyed under.
    if (editor.builders.gpu?.memory.destroyed) return NOTHING;
    throw error;
  });
  if (posed) return posed;
  checkScene({ ...createScene(), meshes: [mesh] });
  const change = await replaced(editor, tools, index, mesh);
  return {
    ...change,
    apply: () => {
      const isRebound = change.apply();
      discardPoser?.(editor, index);
      return isRebound;
    },
  };
}

/** The change to a mesh whose vertices are computed by the CPU. */
async function replaced(
  editor: MeshHost,
  [attributeWords, , layOutGeometry, , meshSlices]: Tools,
  index: number,
  mesh: Mesh,
): Promise<SceneChange> {
  const { scene, gpu, trees } = editor;
  const changed = () => ({ ...scene, meshes: scene.meshes.with(index, mesh) });
  let before: Mesh;
  // The place of the mesh is overwritten. Another edit may come meanwhile.
  do {
    before = scene.meshes[index] as Mesh;
    await editor.build(changed(), [before, mesh]);
  } while (scene.meshes[index] !== before);
  const region = editor.geometry.regions[index] as MeshRegion;
  const tree = trees.get(mesh);
  const next = changed();
  const blas = editor.blas(next);
  const { compact } = editor.geometry;
  const { placement, triangleCount, hasVertexColors } = layOutGeometry(next, blas, compact);
  const fits =
    placement.nodeCapacity <= editor.geometry.tlasNodes &&
    tree &&
    tree.nodeCount <= region.nodes &&
    tree.triangleIndices.length <= region.triangles &&
    (!compact || mesh.positions.length / 3 <= region.vertices) &&
    attributeWords(mesh, compact) <= region.words;
  if (!fits) return editor.reshape(changed);
  const geometry: Geometry = { ...editor.geometry, placement, blas, hasVertexColors, triangleCount };
  const old = trees.get(before);
  return {
    ...editor.commit(next, geometry, () => {
      gpu.writeShapes(meshSlices(index, mesh, tree, region, compact));
      return gpu.updatePlacement(geometry);
    }),
    ...(old ? { rewrite: () => gpu.writeShapes(meshSlices(index, before, old, region, compact)) } : {}),
  };
}
