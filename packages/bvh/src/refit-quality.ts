import { sahCost, type BvhNodes } from './statistics';

/** Default ratio above which {@link RefitQuality.shouldRebuild} returns true. */
export const REBUILD_ABOVE = 1.5;

/**
 * How much refitting has degraded a hierarchy: the ratio of its surface area cost now to that when it was built
 * (Wald, Boulos and Shirley 2007, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies",
 * use the same measure). The cost counts relative to the box of everything, so that growing, moving and turning a
 * mesh as a whole changes little.
 *
 * The ratio is about that of the work per ray, counted (within a quarter for triangles that move apart and for twists).
 * What a rebuild brings is another matter: all of it where parts have moved past each other, a third of it for a twist,
 * next to nothing for waves and roughness, which suit no tree. Make a new `RefitQuality` of the new tree, so that the
 * rebuild is not requested again. A mesh sheared as a whole to several times its length gains by a rebuild that the
 * ratio does not suggest.
 *
 * @example
 * let quality = new RefitQuality(blas);
 * refitBlas(blas, mesh); // each frame
 * if (quality.shouldRebuild(blas)) quality = new RefitQuality((blas = buildBlas(mesh)));
 */
export class RefitQuality {
  /** Surface area cost of the tree as it was built. */
  readonly builtCost: number;

  /** @param blas As it was built. */
  constructor(blas: BvhNodes) {
    this.builtCost = sahCost(blas);
  }

  /** Cost now over the cost when built: 1 right after the build. */
  ratio(blas: BvhNodes): number {
    return sahCost(blas) / this.builtCost;
  }

  /**
   * Whether to rebuild. At a ratio of 1.5 rays take about half as much again as they did, which for a mesh of 100,000
   * triangles is worth a build as soon as some hundred thousand rays are to be traced.
   *
   * @param above Default {@link REBUILD_ABOVE}. Lower for stills, higher where rays are few.
   */
  shouldRebuild(blas: BvhNodes, above: number = REBUILD_ABOVE): boolean {
    return this.ratio(blas) > above;
  }
}
