/** The models that the home page's viewer shows, by name. */
export type HomeModelName = 'armchair' | 'buttons' | 'whisky';

/** One of them. */
export interface HomeModel {
  readonly name: HomeModelName;
  readonly label: string;
  readonly alt: string;
  /** Id of the image of the gallery that shows it from the same camera. */
  readonly poster: string;
}

export const HOME_MODELS: readonly HomeModel[] = [
  {
    name: 'armchair',
    label: 'Armchair',
    alt: 'A tub chair in emerald velvet, stitched into upright channels, on brass legs',
    poster: 'armchair-emerald',
  },
  {
    name: 'buttons',
    label: 'Push-buttons',
    alt: 'Six illuminated push-buttons on a metal panel',
    poster: 'button-panel',
  },
  {
    name: 'whisky',
    label: 'Whisky on ice',
    alt: 'A heavy tumbler of whisky with ice cubes, on a cork coaster',
    poster: 'tumbler-whisky',
  },
];
