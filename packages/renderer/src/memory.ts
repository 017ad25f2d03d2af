/** GPU memory that a tracer may take, see `PathTracerOptions.memory`. */
export interface MemoryBudget {
  /**
   * MiB of GPU memory that textures may take, mip levels included; a whole number from 1 to 1,048,576. Default: as much
   * as the device has. Where the GPU refuses the memory for a scene, its textures are halved until it does not.
   *
   * Levels are dropped one at a time, first those that are seen least: where a texel is smaller than a pixel of the
   * image, from the camera of `PathTracer.create`, nothing visible is lost. The size of texels on screen is estimated
   * once, from texture coordinates and distances of a sample of triangles; reflections and later cameras are not
   * considered. Of equals, the largest goes first. Each level that is dropped halves width and height, and what is left
   * is the mip level that was there anyway: the mean of 2 × 2 texels, of sRGB textures in linear light. Compressed
   * images stay compressed and lose stored levels; one without cannot be reduced. Images of the caller's scene do not
   * change.
   *
   * Where the textures do not fit with all levels dropped, `PathTracer.create` throws `scene/texture-budget` before it
   * allocates anything.
   */
  readonly budgetMiB?: number;

  /**
   * MiB of shapes (hierarchies, triangles, vertex attributes) above which they are stored compactly, in about half of
   * that; a whole number from 1 to 1,048,576, default 256, which is about 2.7 million triangles. It is decided when a
   * tracer is created, by the meshes of its scene. Shapes of which this saves less than a fifth, such as triangles
   * without common vertices, are not stored compactly.
   *
   * Compact shapes have the same positions, and hits are the same, bit for bit. Normals and tangents of vertices are
   * unit vectors within 0.004° and 0.008° of the given ones, and a ray reads a triangle's vertices from several places
   * in memory. Poses of meshes are computed on the CPU: by default, a scene that has meshes with a `pose` when the
   * tracer is created is therefore not stored compactly; with a number given here, it is.
   */
  readonly compactAboveMiB?: number;
}

/** GPU memory by purpose, in bytes, and what one of each costs. */
export interface MemoryReport {
  /** Hierarchies, triangles, vertex attributes, instances. */
  readonly shapes: number;
  readonly lights: number;
  readonly materials: number;
  /** Images of the materials with their mip levels. */
  readonly textures: number;
  /** What they would take with all levels: as much, unless some were dropped. */
  readonly fullTextures: number;
  /** Images that have lost their largest levels, see `PathTracerOptions.memory`. */
  readonly reducedTextures: readonly ReducedTexture[];
  /** The image of the environment and its importance table. */
  readonly environment: number;
  /** Paths in flight, their queues and light samples. */
  readonly paths: number;
  readonly film: number;
  /** Uniforms and energy tables. */
  readonly other: number;
  /** Paths that are on the GPU at once, see `PathTracerOptions.pathsInFlight`. */
  readonly pathsInFlight: number;
  /** Bytes for each path in flight. */
  readonly perPath: number;
  /** Bytes for each stored triangle; instances share theirs. */
  readonly perTriangle: number;
  /** Bytes for each pixel of the film, with the AOVs that are requested. */
  readonly perPixel: number;
  /** Bytes for each texel of the images in use, mip levels included; 0 without textures. */
  readonly perTexel: number;
}

/** An image that a tracer has without its largest levels. */
export interface ReducedTexture {
  /** Index into `Scene.images` of the scene that the tracer was created with. */
  readonly image: number;
  readonly name: string;
  /** Size that it has there. */
  readonly width: number;
  readonly height: number;
  /** Levels that were dropped: each halves width and height. */
  readonly level: number;
}
