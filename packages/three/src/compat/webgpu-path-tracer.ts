import { WebGLPathTracer } from './webgl-path-tracer';
import type { CompatRenderer } from './quad';

/** What {@link WebGPUPathTracer.getSampleCountsAsync} counts. */
export interface SampleCounts {
  /** Samples of the pixels that have fewest, that have most, and the mean: all pixels have equally many. */
  readonly min: number;
  readonly max: number;
  readonly avg: number;
  /** Mean since the last reset. */
  readonly samplesPerSecond: number;
}

/**
 * A drop-in replacement for the class of that name in `three-gpu-pathtracer/webgpu`: as {@link WebGLPathTracer}, with
 * the names and defaults of that class.
 *
 * @example
 * import { WebGPUPathTracer } from '@glanz/three/compat';
 *
 * const pathTracer = new WebGPUPathTracer(renderer);
 * pathTracer.setScene(scene, camera);
 * renderer.setAnimationLoop(() => pathTracer.renderSample());
 */
export class WebGPUPathTracer extends WebGLPathTracer {
  /** Samples after which no more are added; 0 (default) for no end. */
  maxSamples = 0;
  /** No effect: a submission ends by the time it takes. Default 250,000. */
  frameBudget = 250_000;
  /** No effect: crossings of cut-out surfaces are not counted. Default 5. */
  maxTransparentBounces = 5;

  /** @param renderer A `WebGPURenderer` or `WebGLRenderer`. */
  constructor(renderer: CompatRenderer) {
    super(renderer);
    this.bounces = 15;
    this.transmissiveBounces = 0;
  }

  /** {@link bounces} by another name. Default 15. */
  get maxBounces(): number {
    return this.bounces;
  }

  set maxBounces(value: number) {
    this.bounces = value;
  }

  /** {@link pausePathTracing} by another name. Default `false`. */
  get pause(): boolean {
    return this.pausePathTracing;
  }

  set pause(value: boolean) {
    this.pausePathTracing = value;
  }

  /** How far the path-traced image has faded in, 0..1. */
  get fadeState(): number {
    return this.opacity;
  }

  /** To be called when objects have moved. */
  updateTransforms(): void {
    this.updateMaterials();
  }

  /** Size of the film in pixels, where {@link synchronizeRenderSize} is `false`. */
  setSize(x: number, y: number): void {
    this.size = [x, y];
  }

  override renderSample(): void {
    const { pausePathTracing } = this;
    // Of the film itself: what is shown comes later.
    const tracer = this.threePathTracer?.tracer;
    const done = tracer && tracer.renderScale === 1 && tracer.samples >= this.maxSamples;
    if (this.maxSamples > 0 && done) this.pausePathTracing = true;
    super.renderSample();
    this.pausePathTracing = pausePathTracing;
  }

  /** @returns The samples of the pixels. */
  getSampleCountsAsync(): Promise<SampleCounts> {
    const { samples } = this;
    const seconds = this.getRenderTime() / 1000;
    return Promise.resolve({
      min: samples,
      max: samples,
      avg: samples,
      samplesPerSecond: seconds > 0 ? samples / seconds : 0,
    });
  }

  /** Sets {@link multipleImportanceSampling}. */
  setMultipleImportanceSampling(value: boolean): void {
    this.multipleImportanceSampling = value;
  }
}
