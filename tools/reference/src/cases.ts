/** A scene of the catalogue that Glanz can render by now. */
export interface GroundTruthCase {
  readonly scene: string;
  readonly variant: string;
  /** Samples per pixel for tests on a software GPU. */
  readonly samples: number;
}

const one = (scene: string, samples: number, variant = 'full'): GroundTruthCase => ({ scene, variant, samples });

/**
 * What is compared, and with how many samples in tests, which is a question of their time: `bench -- groundtruth` takes
 * as many as the references are worth.
 */
export const GROUND_TRUTH_CASES: readonly GroundTruthCase[] = [
  one('cornell_diffuse', 32),
  one('cornell_diffuse', 64, 'direct'),
  one('cornell_diffuse', 32, 'bounce2'),
  one('cornell_spheres', 32),
  one('dof', 32),
  one('env_soft', 32),
  one('env_sun', 32),
  one('furnace_closed', 64),
  one('furnace_diffuse', 128),
  one('furnace_glass', 128),
  one('furnace_metal', 128),
  one('glass_caustic', 32),
  one('medium_scatter', 16),
  one('metals_f82', 32),
  one('punctual', 32),
  one('textured', 32),
  one('veach_mis', 32),
];
