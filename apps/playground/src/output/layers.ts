import type { FilmLayer } from '@glanz/renderer';

/** The images that can be shown, the beauty first. */
export const LAYERS = [
  'beauty',
  'albedo',
  'normal',
  'depth',
  'objectId',
  'materialId',
] as const satisfies readonly FilmLayer[];
export type Layer = (typeof LAYERS)[number];

/** What people call them. */
export const LAYER_TITLES: Readonly<Record<Layer, string>> = {
  beauty: 'Image',
  albedo: 'Albedo',
  normal: 'Normals',
  depth: 'Depth',
  objectId: 'Parts',
  materialId: 'Materials',
};
