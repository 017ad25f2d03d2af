/** One thing that can be chosen. */
export interface Choice {
  /** One letter of the order code. */
  readonly code: string;
  readonly title: string;
  /** In the sentence about the button. */
  readonly phrase: string;
  /** sRGB colour of its sample. */
  readonly swatch?: string;
  /** Path on a grid of 24 × 24, drawn with a stroke. */
  readonly icon?: string;
}

/** A property of the button with its choices, the usual one first. */
export interface Feature {
  readonly title: string;
  readonly choices: readonly Choice[];
}

/** Everything that can be chosen, in the order of the code. */
export const CATALOGUE = {
  shape: {
    title: 'Actuator',
    choices: [
      { code: 'F', title: 'Flush', phrase: 'Flush push-button', icon: 'M3 17h18M5 17v-4h14v4M8 13v-2.5h8V13' },
      { code: 'R', title: 'Raised', phrase: 'Raised push-button', icon: 'M3 17h18M5 17v-3h14v3M8 14V7h8v7' },
      { code: 'D', title: 'Domed', phrase: 'Domed push-button', icon: 'M3 17h18M5 17v-3h14v3M8 14v-2a4 4 0 0 1 8 0v2' },
      {
        code: 'M',
        title: 'Mushroom',
        phrase: 'Mushroom push-button',
        icon: 'M3 18h18M9.5 18v-5M14.5 18v-5M4 13c0-5 3.5-7 8-7s8 2 8 7z',
      },
    ],
  },
  colour: {
    title: 'Lens',
    choices: [
      { code: 'G', title: 'Green', phrase: 'in green', swatch: '#1f9d53' },
      { code: 'R', title: 'Red', phrase: 'in red', swatch: '#c21f1f' },
      { code: 'Y', title: 'Yellow', phrase: 'in yellow', swatch: '#e8b10c' },
      { code: 'B', title: 'Blue', phrase: 'in blue', swatch: '#1d58c4' },
      { code: 'O', title: 'Orange', phrase: 'in orange', swatch: '#e2640f' },
      { code: 'W', title: 'White', phrase: 'in white', swatch: '#e9e7e2' },
      { code: 'S', title: 'Grey', phrase: 'in grey', swatch: '#8b8f93' },
      { code: 'K', title: 'Black', phrase: 'in black', swatch: '#1c1d1f' },
    ],
  },
  legend: {
    title: 'Legend',
    choices: [
      { code: 'P', title: 'Power', phrase: 'with the power sign', icon: 'M12 4v8M7.5 7a7 7 0 1 0 9 0' },
      { code: 'I', title: 'On', phrase: 'with the on sign', icon: 'M12 5v14' },
      { code: 'O', title: 'Off', phrase: 'with the off sign', icon: 'M12 5.5a6.5 6.5 0 1 0 0 13 6.5 6.5 0 1 0 0-13' },
      { code: 'S', title: 'Start', phrase: 'with the start sign', icon: 'M8 5.5l10 6.5-10 6.5z' },
      { code: 'H', title: 'Stop', phrase: 'with the stop sign', icon: 'M7 7h10v10H7z' },
      { code: 'A', title: 'Arrow', phrase: 'with an arrow', icon: 'M12 19V6M7 11l5-5.5 5 5.5' },
      { code: 'U', title: 'Plus', phrase: 'with a plus', icon: 'M12 5v14M5 12h14' },
      { code: 'N', title: 'None', phrase: 'without a legend', icon: 'M6 18L18 6' },
    ],
  },
  bezel: {
    title: 'Bezel',
    choices: [
      {
        code: 'R',
        title: 'Round',
        phrase: 'round bezel',
        icon: 'M12 4a8 8 0 1 0 0 16 8 8 0 1 0 0-16M12 7.5a4.5 4.5 0 1 0 0 9 4.5 4.5 0 1 0 0-9',
      },
      {
        code: 'S',
        title: 'Slim',
        phrase: 'slim bezel',
        icon: 'M12 5a7 7 0 1 0 0 14 7 7 0 1 0 0-14M12 6.8a5.2 5.2 0 1 0 0 10.4 5.2 5.2 0 1 0 0-10.4',
      },
      {
        code: 'Q',
        title: 'Square',
        phrase: 'square bezel',
        icon: 'M6 4h12a2 2 0 0 1 2 2v12a2 2 0 0 1-2 2H6a2 2 0 0 1-2-2V6a2 2 0 0 1 2-2M12 7.5a4.5 4.5 0 1 0 0 9 4.5 4.5 0 1 0 0-9',
      },
    ],
  },
  finish: {
    title: 'Bezel finish',
    choices: [
      { code: 'C', title: 'Chrome', phrase: 'chrome', swatch: 'linear-gradient(135deg,#f6f7f8,#9ba1a6 50%,#e6e8ea)' },
      { code: 'S', title: 'Satin steel', phrase: 'satin steel', swatch: 'linear-gradient(135deg,#c9cac9,#9a9b9a)' },
      {
        code: 'K',
        title: 'Black chrome',
        phrase: 'black chrome',
        swatch: 'linear-gradient(135deg,#5a5c60,#17181a 60%,#3a3c40)',
      },
      { code: 'M', title: 'Brass', phrase: 'brass', swatch: 'linear-gradient(135deg,#f4dc9a,#b98a2d 60%,#e8c877)' },
      { code: 'W', title: 'White', phrase: 'white', swatch: '#ecebe7' },
    ],
  },
  light: {
    title: 'Illumination',
    choices: [
      { code: 'G', title: 'Green', phrase: 'lit in green', swatch: '#3df08a' },
      { code: 'R', title: 'Red', phrase: 'lit in red', swatch: '#ff4a3d' },
      { code: 'Y', title: 'Amber', phrase: 'lit in amber', swatch: '#ffb52e' },
      { code: 'B', title: 'Blue', phrase: 'lit in blue', swatch: '#4a8cff' },
      { code: 'W', title: 'White', phrase: 'lit in white', swatch: '#fffdf4' },
      { code: 'N', title: 'Without', phrase: 'without illumination', icon: 'M6 18L18 6' },
    ],
  },
  mounting: {
    title: 'Mounting',
    choices: [
      {
        code: 'P',
        title: 'Plate 50 × 50',
        phrase: 'on a 50 × 50 mm plate',
        icon: 'M5 5h14v14H5zM12 8.5a3.5 3.5 0 1 0 0 7 3.5 3.5 0 1 0 0-7',
      },
      {
        code: 'D',
        title: 'Disc 58',
        phrase: 'on a 58 mm disc',
        icon: 'M12 4a8 8 0 1 0 0 16 8 8 0 1 0 0-16M12 9a3 3 0 1 0 0 6 3 3 0 1 0 0-6',
      },
      { code: 'E', title: 'Enclosure lid', phrase: 'in an enclosure lid', icon: 'M4 8l3-4h10l3 4v11H4zM4 8h16' },
      { code: 'N', title: 'Without', phrase: 'without a panel', icon: 'M6 18L18 6' },
    ],
  },
  panel: {
    title: 'Panel finish',
    choices: [
      { code: 'A', title: 'Aluminium', phrase: 'of aluminium', swatch: 'linear-gradient(135deg,#d9dadb,#a7aaad)' },
      {
        code: 'K',
        title: 'Black anodised',
        phrase: 'anodised in black',
        swatch: 'linear-gradient(135deg,#3a3b3e,#1b1c1e)',
      },
      {
        code: 'S',
        title: 'Stainless steel',
        phrase: 'of stainless steel',
        swatch: 'linear-gradient(135deg,#efeeec,#8e8d89 55%,#c9c8c4)',
      },
      { code: 'G', title: 'Light grey', phrase: 'in light grey', swatch: '#cbd0cc' },
      { code: 'Y', title: 'Safety yellow', phrase: 'in safety yellow', swatch: '#f2c200' },
    ],
  },
  contacts: {
    title: 'Contacts',
    choices: [
      {
        code: 'C',
        title: '1 NO + 1 NC',
        phrase: 'one normally open and one normally closed contact',
        icon: 'M4 8h6l5-3M15 8h5M4 16h6l5 0M15 13.5V16h5',
      },
      { code: 'O', title: '1 NO', phrase: 'one normally open contact', icon: 'M4 14h6l6-5M16 14h4' },
      { code: 'X', title: '1 NC', phrase: 'one normally closed contact', icon: 'M4 12h6l7 1.5M16 9v3h4' },
    ],
  },
} as const satisfies Readonly<Record<string, Feature>>;

export type FeatureName = keyof typeof CATALOGUE;
export const FEATURES = Object.keys(CATALOGUE) as FeatureName[];

/** What has been chosen: the letter of each feature. */
export type Configuration = Readonly<Record<FeatureName, string>>;

/** The choices of a feature. */
export const choicesOf = (feature: FeatureName): readonly Choice[] => CATALOGUE[feature].choices;

/** What is chosen of a feature. */
export const chosen = (configuration: Configuration, feature: FeatureName): Choice =>
  choicesOf(feature).find(({ code }) => code === configuration[feature]) ?? (choicesOf(feature)[0] as Choice);

/** The usual button. */
export const usual = (): Configuration =>
  Object.fromEntries(FEATURES.map((feature) => [feature, choicesOf(feature)[0]?.code ?? ''])) as Configuration;

/** Whether a feature has anything to say about a button: a missing panel has no finish. */
export const applies = (configuration: Configuration, feature: FeatureName): boolean =>
  feature !== 'panel' || configuration.mounting !== 'N';

/** How many different buttons there are. */
export function combinations(): number {
  const others = FEATURES.filter((feature) => feature !== 'mounting' && feature !== 'panel').reduce(
    (product, feature) => product * choicesOf(feature).length,
    1,
  );
  return others * ((choicesOf('mounting').length - 1) * choicesOf('panel').length + 1);
}

/** The button in one sentence. */
export function sentence(configuration: Configuration): string {
  const say = (feature: FeatureName) => chosen(configuration, feature).phrase;
  const panel = configuration.mounting === 'N' ? say('mounting') : `${say('mounting')} ${say('panel')}`;
  return `${say('shape')} ${say('colour')} ${say('legend')}, ${say('light')}, ${say('finish')} ${say('bezel')}, ${panel}, ${say('contacts')}.`;
}
