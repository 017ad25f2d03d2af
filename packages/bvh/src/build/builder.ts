import type { TriangleMesh } from '../layout';
import type { Steps, TriangleTree } from './steps';

/** What a builder is told. */
export interface BuildSettings {
  /** Most triangles in a leaf. */
  readonly maxLeaf: number;
  /** Bins per axis. */
  readonly bins: number;
}

/** A way to build that comes from an entry of its own, such as `best` of `@glanz/bvh/best`. */
export interface TreeBuilder {
  /** By this name a worker knows it. */
  readonly name: 'fast' | 'best' | 'best-split';
  /**
   * Builds a tree over the `count` triangles of a mesh that has been checked, in steps of a few milliseconds; each
   * yields the share that is done, 0..1, never less than before. Not for calling: hand the builder to `buildBlas`.
   */
  readonly build: (mesh: TriangleMesh, count: number, settings: BuildSettings) => Steps<TriangleTree>;
}
