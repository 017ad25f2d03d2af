import type { EnvironmentChoice } from '../state/state';

interface Sample {
  readonly title: string;
  /** The environment that suits it. */
  readonly environment: EnvironmentChoice;
}

/** The models that the page makes itself. */
export const SAMPLES = {
  'push-button': { title: 'Push-button · 107 k triangles', environment: 'studio' },
  'push-button-low': { title: 'Push-button · 11 k triangles', environment: 'studio' },
  'push-button-high': { title: 'Push-button · 1.07 M triangles', environment: 'studio' },
  'cornell-box': { title: 'Cornell box · 36 triangles', environment: 'none' },
} as const satisfies Readonly<Record<string, Sample>>;

/** Name of a built-in model. */
export type SampleName = keyof typeof SAMPLES;
