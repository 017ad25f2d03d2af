import type { Blas } from '@glanz/bvh';
import type { Mesh } from '@glanz/scene';
import { isSoftware } from '../device/software';
import type { GpuMemory, PagedArray } from '../storage/buffers';
import type { ShapeArray } from '../storage/shape-arrays';

/** A part of the GPU's buffers that belongs to one mesh, in nodes, triangles, vertices and words. */
export interface MeshRegion {
  readonly firstNode: number;
  readonly nodes: number;
  readonly firstTriangle: number;
  readonly triangles: number;
  /** Of compact shapes: its place in the array of triangles, after all of those. */
  readonly firstVertex: number;
  readonly vertices: number;
  readonly firstWord: number;
  readonly words: number;
}

/** A mesh's hierarchy. Its nodes are on the CPU, or on the GPU alone, where it was built. */
export interface Hierarchy extends Omit<Blas, 'nodes'> {
  readonly nodes?: Blas['nodes'] | undefined;
  /** Present where there are no nodes on the CPU. */
  readonly gpu?: HierarchyOnGpu;
}

/** What only the GPU has of a mesh's hierarchy. */
export interface HierarchyOnGpu {
  /**
   * Copies nodes, triangles and indices to the mesh's region, and frees the buffers that they were built in. Of compact
   * shapes it writes records of triangles in place of triangles and indices.
   * @param arrayOf Finds the scene's arrays.
   */
  place(arrayOf: (name: ShapeArray) => GPUBuffer | PagedArray, region: MeshRegion): void;
  /** Copies the nodes to the CPU. Where they have no place yet, the buffers that they were built in are freed. */
  read(): Promise<Blas>;
  /** A hierarchy of lower quality over the same triangles, for queries on this thread; made at the first call. */
  forQueries(): Blas;
  /** Frees the buffers that it was built in, where it has no place. */
  free(): void;
}

/** Hierarchies that were built at one place, see `RenderStatistics.builds`. */
export interface HierarchyBuild {
  readonly where: 'cpu' | 'gpu';
  readonly meshes: number;
  readonly triangles: number;
  /** Time from the request until the last one is built. CPU and GPU build at the same time. */
  readonly ms: number;
  /**
   * Maximum temporary GPU memory of a build besides its mesh and its result; freed when all are built. Copies of the
   * results are made in the scene's arrays after that, mesh by mesh, and are not counted.
   */
  readonly temporaryBytes: number;
}

type BuilderChoice = 'auto' | 'cpu' | 'gpu';

/** What is built on the GPU, and with what. */
export interface GpuBuilds {
  readonly device: GPUDevice;
  readonly memory: GpuMemory;
  /** Triangles from which on a mesh is built there. */
  readonly minTriangles: number;
  /** Instances from which on the first tree over them is built there. */
  readonly minInstances: number;
}

/** With fewer triangles, building on the CPU takes no longer than compiling and starting the builder of the GPU. */
const MIN_TRIANGLES = 1 << 16;
const MIN_INSTANCES = 1 << 17;

/** Whether the option `bvhBuilder` builds anything on the GPU of a device. */
export function buildsOnGpu(device: GPUDevice, choice: BuilderChoice = 'auto'): boolean {
  const { adapterInfo } = device as { readonly adapterInfo?: GPUAdapterInfo };
  return choice === 'gpu' || (choice === 'auto' && adapterInfo !== undefined && !isSoftware(adapterInfo));
}

/** What that option means for a device; undefined: all is built on the CPU. */
export function gpuBuilds(device: GPUDevice, memory: GpuMemory, choice?: BuilderChoice): GpuBuilds | undefined {
  return buildsOnGpu(device, choice)
    ? {
        device,
        memory,
        minTriangles: choice === 'gpu' ? 1 : MIN_TRIANGLES,
        minInstances: choice === 'gpu' ? 1 : MIN_INSTANCES,
      }
    : undefined;
}

/** Whether a mesh is built on the GPU: the widest binding of a build has 64 bytes a triangle. */
export function suitsGpu({ device: { limits }, minTriangles }: GpuBuilds, { indices }: Mesh): boolean {
  const triangles = indices.length / 3;
  return (
    triangles >= minTriangles && 64 * triangles <= Math.min(limits.maxStorageBufferBindingSize, limits.maxBufferSize)
  );
}
