import type { Instance, Mesh, Scene } from '@glanz/scene';
import type { PagedArray } from '../../storage/buffers';
import type { ShapeArray } from '../../storage/shape-arrays';
import type { GpuBuilds, Hierarchy, MeshRegion } from '../hierarchy';
import type { Placement } from '../placement';

/** A change of the scene that is ready to be made; see `SceneChange`. */
export interface PosingChange {
  readonly isStale: () => boolean;
  readonly apply: () => boolean;
  readonly undo: () => void;
  readonly rewrite?: () => void;
}

/** Writes a mesh with a hierarchy that is on the CPU to its region. */
export type WriteMesh = (mesh: Mesh, tree: Hierarchy, region: MeshRegion) => void;

/** What poses use of a scene's shapes. */
export interface PosedGeometry {
  readonly placement: Placement;
  readonly blas: readonly (Hierarchy | undefined)[];
  readonly regions: readonly MeshRegion[];
  /** Where shapes are compact, the CPU computes poses. */
  readonly compact?: unknown;
}

/** What poses use of the editor of a scene. */
export interface PoseHost<G extends PosedGeometry = PosedGeometry> {
  readonly scene: Scene;
  readonly builders: { readonly gpu?: GpuBuilds | undefined };
  /** Hierarchies of meshes that are or were in the scene. */
  readonly trees: WeakMap<Mesh, Hierarchy>;
  readonly geometry: G;
  /** The scene on the GPU. */
  readonly gpu: {
    /** An array of shapes. */
    shapes(name: ShapeArray): GPUBuffer | PagedArray;
    /** Writes what depends on instances that have moved; returns whether bindings were replaced. */
    updateInstances(
      geometry: G,
      changes: readonly { readonly index: number; readonly before: Instance; readonly after: Instance }[],
    ): boolean;
  };
  /** The change to other instances, meshes and where they lie. */
  commit(scene: Scene, geometry: G, upload: () => boolean): PosingChange;
}
