/** A scene of the reference set that Glanz can render by now. */
export interface GroundTruthCase {
  readonly scene: string;
  readonly variant: string;
  /** Samples per pixel for tests on a software GPU. */
  readonly samples: number;
  /** Noise of the image's mean as a share of that of independent samples, see `compareImages`. */
  readonly noise: number;
}

const one = (scene: string, samples: number, noise: number, variant = 'full'): GroundTruthCase => ({
  scene,
  variant,
  samples,
  noise,
});

/**
 * What is compared, with how many samples in tests, which is a question of their time (`npm test -- --full` takes
 * {@link FULL_SAMPLES} times as many, `bench -- groundtruth` as many as the references are worth), and with what noise of
 * the mean: 0.6 where the Sobol points left at most 0.45 of each channel's in six seeds at these samples, else 1.
 */
export const GROUND_TRUTH_CASES: readonly GroundTruthCase[] = [
  one('cornell_diffuse', 8, 0.6),
  one('cornell_diffuse', 16, 0.6, 'direct'),
  one('cornell_diffuse', 8, 0.6, 'bounce2'),
  one('cornell_spheres', 8, 0.6),
  one('dof', 8, 0.6),
  one('env_soft', 8, 1),
  one('env_sun', 8, 1),
  // Rare bright paths: with fewer samples each pixel that meets one is an outlier.
  one('furnace_closed', 32, 1),
  one('furnace_diffuse', 32, 0.6),
  one('furnace_glass', 32, 1),
  one('furnace_metal', 32, 0.6),
  one('glass_caustic', 8, 1),
  one('medium_scatter', 4, 1),
  one('metals_f82', 8, 0.6),
  one('punctual', 8, 0.6),
  one('textured', 8, 0.6),
  one('veach_mis', 8, 1),
];

/** What `npm test -- --full` multiplies the samples with. */
export const FULL_SAMPLES = 4;
