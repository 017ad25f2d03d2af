import type { MaterialEdit } from '@glanz/viewer';

/**
 * One choice of an option: parts that it shows, and changes of materials.
 * Names are those of the nodes and materials in the glTF file.
 */
export interface Choice {
  readonly name: string;
  readonly shows?: readonly string[];
  readonly materials?: Readonly<Record<string, MaterialEdit>>;
}

export interface Option {
  readonly name: string;
  readonly choices: readonly Choice[];
}

const lens = (name: string, color: string): Choice => ({
  name,
  materials: { 'lens green': { base_color: color, emission_color: color } },
});

const bezel = (name: string, color: string, roughness: number): Choice => ({
  name,
  materials: {
    'bezel chrome': { base_color: color, specular_roughness: roughness },
  },
});

/** What can be chosen; the first choice of each option is the default. */
export const CATALOGUE: readonly Option[] = [
  {
    name: 'Lens',
    choices: [
      lens('Green', '#1fa34a'),
      lens('Red', '#c81e1e'),
      lens('Blue', '#1d4ed8'),
      lens('Amber', '#e08a00'),
    ],
  },
  {
    name: 'Bezel',
    choices: [
      bezel('Chrome', '#e4e5e7', 0.14),
      bezel('Brushed', '#d2d3d4', 0.42),
      bezel('Brass', '#e3bd6b', 0.2),
      bezel('Black', '#33343a', 0.35),
    ],
  },
  {
    name: 'Symbol',
    choices: [
      { name: 'On and off', shows: ['Legend arc', 'Legend bar'] },
      { name: 'On', shows: ['Legend bar'] },
      { name: 'None' },
    ],
  },
];

/** How many assemblies there are. */
export const assemblies = CATALOGUE.reduce(
  (product, { choices }) => product * choices.length,
  1,
);
