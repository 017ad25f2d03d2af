import type { Aabb } from '../layout';

/** Triangles in GPU buffers. */
export interface GpuMesh {
  /** xyz per vertex, stride 3, f32; usage `STORAGE`. */
  readonly positions: GPUBuffer;
  readonly vertexCount: number;
  /** Three per triangle, into the vertices; usage `STORAGE`. Absent: the vertices are taken in threes. */
  readonly indices?: GPUBuffer | undefined;
  /** Default `uint32`. Of `uint16`, two lie in a word, the first in its lower half. */
  readonly indexFormat?: 'uint16' | 'uint32' | undefined;
  readonly triangleCount: number;
}

/** Boxes in a GPU buffer. */
export interface GpuBoxes {
  /** Six numbers each: min xyz, max xyz; usage `STORAGE`. Boxes that are empty or not finite are left out. */
  readonly boxes: GPUBuffer;
  readonly count: number;
}

/** Options for builds of `GpuBuilder`. */
export interface GpuBuildOptions {
  /** Ends the call with the signal's reason; what was submitted to the GPU still runs. */
  readonly signal?: AbortSignal | undefined;
  /** Measures the phases by timestamps; needs the feature `timestamp-query`. Default false. */
  readonly timestamps?: boolean | undefined;
}

/** Options for `GpuBuilder.buildBlas`. */
export interface GpuBlasOptions extends GpuBuildOptions {
  /** Maximum number of triangles in a leaf, 1 to 16. Default 4. */
  readonly maxLeafTriangles?: number | undefined;
  /** Whether to make `GpuBlas.triangles` too. Default false. */
  readonly packTriangles?: boolean | undefined;
}

/** Milliseconds of GPU time, as far as timestamps tell. */
export interface GpuBuildTimes {
  /** Boxes, pairs, and the lower half of each Morton code. */
  readonly primitives: number;
  /** Sorts by the lower halves, computes the upper ones, and sorts by those. */
  readonly sort: number;
  readonly cluster: number;
  /** Nodes and leaves in their order. */
  readonly layout: number;
  /** From the begin of the first to the end of the last. */
  readonly total: number;
}

/** A hierarchy in GPU buffers, in the layout of the builders on the CPU. */
export interface GpuTree {
  /** `bvhNodeStruct` of `@glanz/bvh/wgsl`, 64 bytes a node; parents before their children. Node 0 is the root. */
  readonly nodes: GPUBuffer;
  readonly nodeCount: number;
  /** Bounding box of all instances; min > max if there are none. */
  readonly bounds: Aabb;
  /** As `bvhStatistics` of `@glanz/bvh/statistics` defines it, in single precision. */
  readonly sahCost: number;
  /** Inner nodes on the longest path to a leaf. */
  readonly depth: number;
  /** Present where `timestamps` was set. */
  readonly times?: GpuBuildTimes;
  /** Frees the buffers. */
  destroy(): void;
}

/** A bottom-level hierarchy on the GPU: the triangles of one mesh. */
export interface GpuBlas extends GpuTree {
  /** Leaf order → triangle of the mesh, u32. Triangles with a coordinate that is not finite are left out. */
  readonly triangleIndices: GPUBuffer;
  /** Triangles in the hierarchy; `triangleIndices` has as many entries, and one if there are none. */
  readonly triangleCount: number;
  /** With `packTriangles`: triangles in leaf order, 48 bytes each, as `packTriangles` writes them. */
  readonly triangles?: GPUBuffer;
}

/** A hierarchy over boxes on the GPU, one box a leaf. */
export interface GpuBoxTree extends GpuTree {
  /** Leaf order → box given, u32. */
  readonly order: GPUBuffer;
  /** Boxes in the hierarchy. */
  readonly count: number;
}
