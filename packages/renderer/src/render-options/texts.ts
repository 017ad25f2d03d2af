import type { RenderOptionName } from './table';

/**
 * The documentation of an option. The texts are in a module of their own: bundlers put whole modules into a chunk, and a
 * page loads the texts with its settings panel, not before its first image.
 */
export interface RenderOptionText {
  /** One or two sentences. */
  readonly doc: string;
  /** Unit of the number. */
  readonly unit?: string;
  /** Whether it makes the result biased: it removes or blurs some light, for less noise or time. */
  readonly biased?: boolean;
  /** The part of the range that a slider offers; default: the whole range. */
  readonly softRange?: readonly [number, number];
}

/** The texts of all options of {@link RENDER_OPTIONS}. Literals only: bundlers keep unused expressions. */
export const RENDER_OPTION_TEXTS: Readonly<Record<RenderOptionName, RenderOptionText>> = {
  samples: {
    doc: 'Samples per pixel. With a noise target it is the maximum, by default 65536.',
    softRange: [1, 4096],
  },
  noise: {
    doc: 'Relative standard error at which a part of the image is finished: 0.05 is enough for a preview, noise of 0.01 is hardly visible. 0: no target.',
    softRange: [0, 0.1],
  },
  maxSubmitMs: {
    doc: 'Maximum GPU time of one submission; in scenes with long paths up to three times as much.',
    unit: 'ms',
    softRange: [1, 100],
  },
  maxDepth: {
    doc: 'Maximum number of edges of a path from the camera to a light: 1 shows only emitters, 2 adds direct light.',
    softRange: [1, 16],
  },
  maxVolumeDepth: {
    doc: 'Maximum number of scattering events of a path in media such as subsurface or milky glass.',
    softRange: [0, 1024],
  },
  seed: {
    doc: 'The same seed gives the same image on the same device.',
    softRange: [0, 100],
  },
  background: { doc: 'What is visible behind the scene: the environment, or nothing (alpha is the coverage).' },
  filter: {
    doc: 'Pixel filter: how samples around a pixel are weighted. Its radius is half its width.',
    unit: 'pixels',
  },
  lightGroups: {
    doc: 'Stores the light of groups separately, as layers of the film: the groups that the scene names, each light, or none.',
  },
  aovs: { doc: 'First-hit layers that stay on the GPU, such as the guides of a denoiser: means over 64 samples.' },
  backFaceCulling: {
    doc: 'Culls single-sided faces that are seen from behind: for camera rays only, or for all rays.',
  },
  maxBounces: {
    doc: 'Maximum number of bounces of each kind. What is not listed is not limited.',
    biased: true,
  },
  regularization: {
    doc: 'Widens sharp lobes after bounces off rough surfaces: 0 is off, 0.25 removes most fireflies of caustics.',
    biased: true,
  },
  shadowSoftness: {
    doc: 'Softens shadows on catchers: 0 leaves them unchanged, 1 spreads shadow rays by up to 30 degrees.',
    biased: true,
  },
  clampIndirect: {
    doc: 'Maximum radiance of light after two or more bounces. Removes fireflies, and energy with them.',
    biased: true,
    softRange: [0, 100],
  },
  caustics: {
    doc: 'Light that reaches a matte surface by a sharp reflection or refraction.',
    biased: true,
  },
  lightPaths: {
    doc: 'Number of paths per pixel and sample that start at lights and go by way of smooth glass and metals; 0 is off.',
    softRange: [0, 1],
  },
  guiding: {
    doc: 'Number of training paths of the path guide, in millions, traced before the first sample; 0 is off.',
    softRange: [0, 64],
  },
  multipleScattering: {
    doc: 'Compensates for the energy that single-scattering microfacet models lose. Turn it off only for comparisons.',
  },
  sampler: { doc: 'Source of the random numbers. All are unbiased; `independent` converges slower.' },
  lightSampling: {
    doc: 'Lights are chosen by their contribution at the shaded point (a light tree), or by power alone.',
  },
  lightCandidates: {
    doc: 'Light samples at the first surface of a path, of which one gets a shadow ray: 4 suits scenes with many lights.',
    softRange: [1, 16],
  },
  shadowTerminator: {
    doc: 'Where smooth normals and triangles disagree: light follows the smooth surface, or the triangles.',
  },
  textureLodBias: { doc: 'Added to the level of detail of textures; lower is sharper.', softRange: [-4, 4] },
  bvhBuilder: {
    doc: 'Where hierarchies are built: those of large meshes and of many instances on the GPU, which is faster, all on the CPU, or all on the GPU.',
  },
  pathsInFlight: {
    doc: 'Maximum number of paths on the GPU at once, about 150 bytes each. Default: 4194304, or 1048576 without buffers of 2 GiB.',
    softRange: [4096, 4_194_304],
  },
  memory: {
    doc: 'GPU memory in MiB: what textures may take, which lose their largest levels beyond it, those that are seen least first; and from where on shapes are stored in about half of it.',
    unit: 'MiB',
    biased: true,
  },
};
