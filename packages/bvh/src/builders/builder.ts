import type { TriangleMesh } from '../layout';
import type { Steps, TriangleTree } from './steps';

/** Settings of a build. */
export interface BuildSettings {
  /** Maximum number of triangles in a leaf. */
  readonly maxLeaf: number;
  /** Bins per axis. */
  readonly bins: number;
}

/** A builder from its own entry, such as `best` of `@glanz/bvh/best`. */
export interface TreeBuilder {
  /** Identifies the builder to workers. */
  readonly name: 'fast' | 'best' | 'best-split';
  /**
   * Builds a tree over the `count` triangles of a mesh that has been checked, in steps of a few milliseconds; each
   * yields the completed fraction, 0..1, never decreasing. Do not call it: pass the builder to `buildBlas`.
   */
  readonly build: (mesh: TriangleMesh, count: number, settings: BuildSettings) => Steps<TriangleTree>;
}
