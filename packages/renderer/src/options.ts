import type { Camera } from '@glanz/scene';
import type { RenderError } from './errors';
import type { HierarchyBuilder } from './geometry/hierarchies';
import type { HierarchyBuild } from './geometry/hierarchy';
import type { MemoryBudget, MemoryReport } from './memory';

export type { HierarchyBuild, HierarchyBuilder };

/**
 * Options for {@link PathTracer.create}. Ranges and defaults are in `RENDER_OPTIONS` of `@glanz/renderer/options`; a value
 * outside of its range throws.
 */
export interface PathTracerOptions {
  /** Film size in pixels, at least 1 × 1. */
  readonly width: number;
  readonly height: number;
  /**
   * Maximum number of edges of a path from the camera to a light, 1 to 65,535: 1 shows only emitters, 2 adds direct
   * light, … Default 8. These crossings do not count: of a surface that is partly transparent by opacity, of one without
   * a change of the index of refraction, and straight through a smooth thin wall.
   */
  readonly maxDepth?: number;
  /**
   * Maximum number of scattering events of a path inside of media (subsurface, milky glass), 0 to 65,535; default 256.
   * After the last one the path continues straight to the surface. In media without an optical surface, such as fog,
   * they count as edges too.
   */
  readonly maxVolumeDepth?: number;
  /**
   * Selects the random numbers, a whole number from 0 to 4,294,967,295: the same seed gives the same image on the same
   * device. Default 0.
   */
  readonly seed?: number;
  /** A camera, or index or name of one of the scene's. Default: the scene's first, or one that frames the scene. */
  readonly camera?: Camera | number | string;
  /** `transparent` leaves pixels without surface empty (alpha 0). Default `environment`. */
  readonly background?: 'environment' | 'transparent';
  /**
   * How samples around a pixel make it up. `box` (default): those inside it, alike. `gaussian`: a bell cut off at three
   * standard deviations, 1.5 pixels by default. `blackman-harris`: a narrower bell, 1.5 pixels by default. Softer
   * edges, no ringing; noise stays independent from pixel to pixel.
   */
  readonly filter?: PixelFilter;
  /**
   * Keeps the light of several groups apart, so that each can be dimmed and coloured without a new sample, see
   * `PathTracer.setLightGroup`. `off`: one sum. `named` (default): the groups that the scene names (`light_group` of
   * lights, emitting materials and the environment), and one called `rest` for all else. `each`: every light, emitting
   * material and the environment by its own name. A group costs 32 bytes a pixel and 16 bytes a path in flight; 16 at
   * most.
   */
  readonly lightGroups?: LightGroupMode;
  /**
   * Biased: clamps each contribution of light that took two bounces or more to this radiance, in each channel. Removes
   * fireflies, and energy with them. Above 0 and at most 1e30; default off. Try regularization first.
   */
  readonly clampIndirect?: number;
  /**
   * Biased: makes sharp lobes wider for paths that have bounced wide before, by this share of the widest bounce: 0
   * (default) off, 0.25 takes most fireflies of caustics away and costs little light, 1 is as wide as what came before.
   */
  readonly regularization?: number;
  /**
   * Biased: softens what falls on catchers, shadows and reflections. Rays that leave a catcher are turned at random by up
   * to an angle whose tangent is this times tan 30°: 0 (default) is as the lights cast it, 1 spreads them by 30°. An edge
   * at the height h above the catcher, lit from above, has a penumbra as wide as 1.15 h at 1. Other surfaces stay.
   */
  readonly shadowSoftness?: number;
  /**
   * Biased: `false` leaves out light that reaches a matte surface by way of a sharp reflection or refraction. Default
   * true.
   */
  readonly caustics?: boolean;
  /**
   * Unbiased: learns before the first sample from which directions light reaches the scene's surfaces, and samples
   * these more often (path guiding). The number of paths that it learns from, in millions: 0 (default) off, 16 for a
   * room. In our tests that leaves half of the noise of indirect light and of caustics of larger lights, and up to 6 %
   * more where light comes from everywhere; a sample takes up to a sixth longer. The guide is learned once, in
   * `PathTracer.create`: after edits the image stays right, and gains less. 0 to 1000.
   */
  readonly guiding?: number;
  /**
   * Unbiased: the number of paths per pixel and sample that start at lights, go through smooth glass and mirrors or are
   * reflected once by a metal with a roughness of at most 0.5, and end at the first surface that the camera sees:
   * caustics of small lights, which paths from the camera rarely find. Both are weighed against each other. 0 (default)
   * off, 0.25 to 1 for scenes with such caustics; 0 to 16. Without effect with orthographic and panorama cameras,
   * catchers, `backFaceCulling: 'all'`, `clampIndirect`, `regularization`, `maxBounces` and without `caustics`. Lights
   * without a size start some for rough metals alone.
   */
  readonly lightPaths?: number;
  /**
   * Unbiased: number of light samples that are drawn at the first surface of a path; one of them, chosen by what it would
   * contribute without shadows, gets the shadow ray (resampled importance sampling, Talbot et al. 2005). 1 to 64, default
   * 1. 4 lowers the noise where many lights or lights of very different directions matter and are mostly visible: by 40 %
   * in a room with 74 lights, for a fifth more time per sample. Where the brightest light is hidden, noise rises.
   */
  readonly lightCandidates?: number;
  /** Biased: maximum number of bounces of each kind, besides `maxDepth`. What is not given is not limited. */
  readonly maxBounces?: BounceLimits;
  /**
   * First-hit AOVs that the film records on the GPU from its first sample on, see `PathTracer.aov`. The paths write
   * them, and they average the film's first 64 samples: guides of denoisers and layers for compositing converge faster
   * than light. Default: none, without any cost; `PathTracer.setAovs` changes it later.
   */
  readonly aovs?: readonly AovName[];
  /**
   * Compensate the energy that single-scattering microfacet models lose. Default true; false is for tests against such
   * references.
   */
  readonly multipleScattering?: boolean;
  /**
   * Source of the random numbers. `blue-noise` (default): Owen-scrambled Sobol points that neighbouring pixels share,
   * so that the remaining noise has high frequencies; `sobol`: Owen-scrambled Sobol points, independent between pixels,
   * with the same amount of noise; `independent`: PCG, which converges slower. All are unbiased.
   */
  readonly sampler?: Sampler;
  /**
   * How light samples choose among emissive triangles and lights. `tree` (default): by what each may give to the place,
   * as a tree over them tells; `power`: by power alone, in constant time. Both are unbiased.
   */
  readonly lightSampling?: 'tree' | 'power';
  /**
   * The shadow terminator: light where a surface of few triangles has smooth normals and turns away from the light.
   * `smooth` (default): rays start on the smooth surface that the normals stand for, and light that reaches this is not
   * held back by the triangles. `faceted`: the triangles' horizons count; edges of the light follow them, and a little
   * light is lost. Triangles whose normals lean more than 53° away, as at hard edges, and those without normals do not
   * change. What lies closer to such a surface than it bulges between its corners casts no shadow on it there.
   */
  readonly shadowTerminator?: 'smooth' | 'faceted';
  /**
   * Culls faces that are seen from behind, where their material is not `double_sided`, as rasterisers do: a room whose
   * walls face inwards is visible from outside. `off` (default): all surfaces are there from both sides. `camera`: only
   * what the camera sees itself changes, straight or through smooth thin walls; light, shadows and reflections find all
   * faces where they are, so the walls still keep the sun out of the room, and a mirror outside shows them. `all`: the
   * model is cut open for light too, which falls into the room where the camera looks in; turning the view cuts it
   * elsewhere, and mirrors show the cut. What glows is not cut: it shines on, and only the camera looks through its
   * back. Materials that let light through are never culled: those with transmission, subsurface, or opacity without a
   * threshold. Front is where the winding is counter-clockwise, in mirroring instances clockwise.
   */
  readonly backFaceCulling?: BackFaceCulling;
  /**
   * Added to texture levels of detail, −32 to 32. Default −1: a texel is half a pixel wide or finer; the pixel filter does the
   * rest.
   */
  readonly textureLodBias?: number;
  /**
   * Most paths on the GPU at once, about 150 bytes each. Memory for more than one sample of the image is taken only
   * when the GPU has shown that it is fast enough for batches that large. Default 4,194,304; 1,048,576 where the device
   * has no buffers of 2 GiB.
   */
  readonly pathsInFlight?: number;
  /**
   * Budgets of GPU memory. Textures that need more lose their largest levels until they fit, which
   * `statistics.memory.reducedTextures` lists and {@link PathTracerOptions.onWarning} reports: the image is approximated
   * then. See {@link MemoryBudget}.
   */
  readonly memory?: MemoryBudget;
  /**
   * Builds the hierarchies of the meshes, e.g. `await BvhWorkers.create()` of `@glanz/bvh/workers`: on other threads,
   * several at a time; or a `BlasCache` of `@glanz/bvh/cache` around it, which reads what was built before. It stays
   * the caller's to destroy. Default: built on this thread, which yields to the event loop between meshes.
   */
  readonly hierarchies?: HierarchyBuilder;
  /**
   * Where hierarchies are built. `auto` (default): those of meshes with 65,536 triangles or more, and the tree over
   * 131,072 instances or more, on the GPU, unless that is a software adapter, and the others on the CPU at the same
   * time, by `hierarchies` or on this thread. `cpu`: all on the CPU. `gpu`: all on the GPU. Upper levels change on the
   * CPU from then on. What the GPU has no memory for, cannot bind or does not compile is built on the CPU. On the GPU a
   * build takes milliseconds and neither reads nor fills a cache; 0.97 to 1.12 times as many diffuse rays a second pass
   * through the result as through the trees of `buildBlas` (on an H200). Both find the same surfaces; a ray through an
   * edge, or one that grazes a triangle, may get the neighbour within rounding: some 30 in a million pixels of a first
   * sample differ.
   */
  readonly bvhBuilder?: 'auto' | 'cpu' | 'gpu';
  readonly signal?: AbortSignal;
  readonly onProgress?: (progress: PrepareProgress) => void;
  /**
   * Called once while the kernels compile, with a plain image of the scene: base colours under a light at the camera,
   * without textures. Its small kernel compiles long before the others; if those are ready first, it is not called.
   */
  readonly onFirstLight?: (image: FirstLight) => void;
  /**
   * Called once where textures have lost levels to fit into memory, and the image is approximated:
   * `renderer/textures-reduced`, with the numbers. Not thrown.
   */
  readonly onWarning?: ((warning: RenderError) => void) | undefined;
}

/** See {@link PathTracerOptions.onFirstLight}. */
export interface FirstLight {
  /** Laid out like `PathTracer.beautyBuffer`. It is destroyed when `PathTracer.create` ends. */
  readonly buffer: GPUBuffer;
  readonly width: number;
  readonly height: number;
}

/**
 * Most bounces of a kind in one path between surfaces; the last of them is still lit, so 0 leaves direct
 * light. Up to 127 count. A bounce is diffuse where its density is below one half per steradian, as wide as
 * Lambert's or a roughness of 0.65, and specular otherwise; one through a surface counts as transmission whatever its
 * width.
 */
export interface BounceLimits {
  readonly diffuse?: number;
  readonly specular?: number;
  readonly transmission?: number;
  readonly volume?: number;
}

/** See {@link PathTracerOptions.backFaceCulling}. */
export type BackFaceCulling = 'off' | 'camera' | 'all';

/**
 * A first-hit AOV. The first surface is what the camera sees first, with the image's pixel filter, lens, opacity and
 * culling; catchers are surfaces, lights without a mesh are not. A chain of smooth reflections and refractions goes on
 * from there to the first surface that scatters light widely: what is seen in a mirror or behind clear glass. A surface
 * belongs to a chain if at least three quarters of what it reflects and lets through go by microfacets of a roughness of
 * at most 0.1, and the path leaves it by one of them.
 *
 * Of the surface at the end of the chain, as means over samples:
 * - `albedo`: RGB: its directional albedo, 0..1, times what the chain lets through (reflectances, tints, absorption); 0
 *   where there is no surface. A chain that leaves the scene ends at its last surface, as one does that a medium
 *   scatters.
 * - `normal`: XYZ: its shading normal in the world, on the side of the path; 0 where there is no surface. Of a chain that
 *   leaves the scene, that of its first surface.
 * - `virtualDepth`: metres along the chain, over samples that met a surface; 0 for none. Equal to `depth` where there is
 *   no chain: how far away a reflection seems to be.
 *
 * Of the first surface, as means over samples:
 * - `coverage`: 1 number: share of the samples that have met a surface.
 * - `depth`: metres from the camera ray's origin, over samples that met a surface; 0 for none.
 * - `position`: XYZ: position in the world, over samples that met a surface; 0 for none.
 *
 * Of the sample nearest to the pixel's centre:
 * - `objectId`, `materialId`: u32: of the first surface, index in `Scene.instances` and in `Scene.materials`; 0xffffffff
 *   for none.
 * - `roughness`: 1 number, 0..1: how narrowly the surface at the end of the chain scatters: √α of its microfacets, where
 *   α is the harmonic mean over its lobes by how often each is sampled, and 1 for what scatters widely (diffuse,
 *   subsurface, fuzz, volumes). Lambert's surface has 1, also in a mirror; a mirror that shows nothing has 0, as have a
 *   surface that scatters nothing, such as a black one that emits, and a pixel without a surface.
 * - `motion`: XY: pixels, to the right and down, from where the first surface is in the image to where it was in the
 *   frame before, see {@link HistoryFrame}; 0 where there is no surface or no such frame. Through the middle of the lens.
 */
export type AovName =
  | 'albedo'
  | 'normal'
  | 'virtualDepth'
  | 'coverage'
  | 'depth'
  | 'position'
  | 'objectId'
  | 'materialId'
  | 'roughness'
  | 'motion';

/**
 * The frame that a film showed before it began again, where the same surfaces can be found in it: after another camera
 * of the same type, transforms of instances, another render scale, or `reset()`. Edits that change how surfaces look, or
 * which there are, leave none; so do `resize()` and `restoreFilm()`.
 */
export interface HistoryFrame {
  readonly camera: Camera;
  /** Pixels that it had. */
  readonly width: number;
  readonly height: number;
  /** Samples per pixel that it had, at least 1. */
  readonly samples: number;
}

/** What {@link PathTracer.denoised} needs of a denoiser: `FilmDenoiser` of `@glanz/denoise/film` has it. */
export interface TracerDenoiser<Tracer, Result> {
  /** Denoises what a tracer shows, with its AOVs `albedo` and `normal` as guides. */
  denoiseTracer(tracer: Tracer, options?: { readonly signal?: AbortSignal }): Promise<Result>;
  /** Copies a result to the CPU: linear RGBA, stride 4, top row first. */
  read(result: Result): Promise<Float32Array<ArrayBuffer>>;
}

/** Where an AOV lies on the GPU, see {@link PathTracer.aov}. */
export interface FilmAov {
  /**
   * The pixels, row-major, top row first. It has the usages `STORAGE` and `COPY_SRC`. With a render scale below 1 only
   * its beginning is in use. Replaced by `resize()`, and destroyed when the AOV is no longer requested.
   */
  readonly buffer: GPUBuffer;
  /** What the numbers are: f32, or u32 for ids. */
  readonly format: 'float32' | 'uint32';
  /** 32-bit numbers from one pixel to the next: 4 of an `array<vec4f>` or `array<vec4u>`; 2 of `motion`. */
  readonly stride: number;
  /** The first of the AOV's own numbers in a pixel, counted from 0. The others may belong to other AOVs. */
  readonly offset: number;
  /** How many numbers it has. */
  readonly channels: number;
  /** Number of samples in it: at most 64, and at most those of the film. */
  readonly samples: number;
}

/** See {@link PathTracerOptions.sampler}. */
export type Sampler = 'blue-noise' | 'sobol' | 'independent';

/** See {@link PathTracerOptions.lightGroups}. */
export type LightGroupMode = 'off' | 'named' | 'each';

/** A light group as it is set. */
export interface LightGroup {
  readonly name: string;
  /** Multiplies its light. */
  readonly intensity: number;
  /** Multiplies its light too; linear Rec.709. */
  readonly color: readonly [number, number, number];
}

/** A pixel filter by name, or with its radius in pixels (half its width), above 0 and at most 16. */
export type PixelFilter =
  | 'box'
  | 'gaussian'
  | 'blackman-harris'
  | { readonly type: 'box' | 'gaussian' | 'blackman-harris'; readonly radius?: number };

/** Progress of {@link PathTracer.create}. */
export interface PrepareProgress {
  readonly stage: 'bvh' | 'upload' | 'compile';
  /** Share of the stage, 0..1. */
  readonly done: number;
}

/** Options for {@link PathTracer.render}. */
export interface RenderOptions {
  /**
   * Samples per pixel to reach in all, counting those already there; at most 16,777,216. Default 256, with `noise`
   * 65,536.
   */
  readonly samples?: number;
  /**
   * Adaptive: samples only where there is noise, until it is everywhere at most this: the standard error of a tile of 8
   * × 8 pixels relative to its brightness (root mean square; a hundredth of the image's mean square is added for dark
   * tiles). 0.05 is a good preview, 0.01 is hardly visible. 0: no target. Noise is looked at after 64, 96, 128, 192, …
   * samples, so the result does not depend on the machine's speed. The choice of when to stop is made by looking at the
   * same samples, which biases pixels towards where they look calm, by less than the noise that is left; leave it out
   * for references.
   */
  readonly noise?: number;
  readonly signal?: AbortSignal;
  /**
   * Milliseconds of GPU time that one submission should take at most, 0.1 to 10,000. Default 16, one frame at 60 Hz: a
   * page stays responsive, and no watchdog fires. What a submission takes whatever its size, as at the ends of long
   * paths through thick glass, is shared by more samples: six times as long as that, up to three times this value; and
   * three times as long as that where it alone takes longer.
   */
  readonly maxSubmitMs?: number;
}

/** Given after each completed sample or group of samples. */
export interface RenderProgress {
  /** Completed samples per pixel. */
  readonly samples: number;
  readonly targetSamples: number;
  /** Milliseconds since this `render()` began. */
  readonly elapsedMs: number;
  /**
   * Milliseconds until `targetSamples`, or until the `noise` target, at the present rate; `Infinity` before the first
   * sample, or before noise was first measured. Assumes that noise falls with the square root of the number of samples.
   */
  readonly remainingMs: number;
  /** Samples per pixel of the whole image. */
  readonly samplesPerSecond: number;
  /** Share of the image that is being sampled, 0..1: below 1 only with a `noise` target. */
  readonly active: number;
  /**
   * Noise of the whole image when it was last measured, in the units of `RenderOptions.noise`; only with such a target.
   */
  readonly noise?: number;
}

/** Figures about a prepared scene. */
export interface RenderStatistics {
  /** Stored triangles of the meshes in use. */
  readonly triangles: number;
  readonly instances: number;
  /** Emissive triangles and lights of the scene. */
  readonly lights: number;
  /** Time to check the scene, and to frame it where it has no camera. */
  readonly checkMs: number;
  /** Time to write the kernels' text and hand it to the driver. */
  readonly textMs: number;
  /**
   * Time from the request of the hierarchies until the last one is built. Where other threads build them, shaders are
   * composed in this time.
   */
  readonly bvhMs: number;
  /** Which meshes were built where in that time: one entry for the CPU and one for the GPU, if they had any. */
  readonly builds: readonly HierarchyBuild[];
  /** Time to write it all to the GPU. */
  readonly uploadMs: number;
  /** Of that, what comes after the shapes: lights, environment and energy tables. */
  readonly lightMs: number;
  /**
   * Time until all pipelines were there; they compile side by side, while hierarchies are built and the scene is
   * uploaded.
   */
  readonly compileMs: number;
  /** Bytes of GPU memory held. */
  readonly gpuBytes: number;
  /** What they are for. */
  readonly memory: MemoryReport;
  /** Samples dropped because they were NaN, infinite or negative; 0 on healthy scenes. Known after a `read()`. */
  readonly badSamples: number;
}

/** What {@link PathTracer.read} can give. */
export type FilmLayer = 'beauty' | 'variance' | AovName;

/** The surface under a pixel, see {@link PathTracer.pick}. */
export interface PickResult {
  /** Index into `Scene.instances`. */
  readonly instance: number;
  /** Index into `Scene.materials`. */
  readonly material: number;
  /** World space, metres. */
  readonly position: readonly [number, number, number];
  /** Metres from the camera. */
  readonly distance: number;
  /** Metres along the camera's axis: the `focus_distance` that makes it sharp. */
  readonly depth: number;
}
