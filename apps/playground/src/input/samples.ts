import type { EnvironmentChoice } from '../state/state';

interface Sample {
  readonly title: string;
  /** The environment that suits it. */
  readonly environment: EnvironmentChoice;
  /** Whether it stands on a floor that catches shadows: it brings no ground of its own. */
  readonly floor: boolean;
}

const BASIC = {
  'push-button': { title: 'Push-button · 107 k triangles', environment: 'studio', floor: true },
  'push-button-low': { title: 'Push-button · 11 k triangles', environment: 'studio', floor: true },
  'push-button-high': { title: 'Push-button · 1.07 M triangles', environment: 'studio', floor: true },
  'cornell-box': { title: 'Cornell box · 36 triangles', environment: 'none', floor: false },
} as const satisfies Readonly<Record<string, Sample>>;

/** Models of the documentation's gallery, by their names there; each brings its lights. */
const GALLERY = [
  'armchair',
  'bubbles',
  'button-panel',
  'camera-lens',
  'chess',
  'knot',
  'lamps',
  'perfume',
  'ring',
  'speedform',
  'tea-set',
  'tumbler',
  'weave',
] as const;

/** Name of a built-in model. */
export type SampleName = keyof typeof BASIC | (typeof GALLERY)[number];

/** The models that the page makes itself. */
export const SAMPLES: Readonly<Record<SampleName, Sample>> = {
  ...BASIC,
  ...(Object.fromEntries(
    GALLERY.map((name) => [
      name,
      { title: name.charAt(0).toUpperCase() + name.slice(1).replace('-', ' '), environment: 'none', floor: false },
    ]),
  ) as Record<(typeof GALLERY)[number], Sample>),
};
