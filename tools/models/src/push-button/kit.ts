import type { Scene } from '@glanz/scene';
import { extrude, type InsetOutline } from '../shapes/extrude';
import { circleOutline, closedOutline, openOutline, rectangle, type Corner } from '../shapes/outline';
import { revolve } from '../shapes/revolve';
import { circleSegments, type Tessellation } from '../shapes/tessellation';
import type { MeshBuilder } from '../shapes/mesh-builder';
import { CONTACT_BLOCKS } from './contact-block';
import { FRONT, openRing } from './front';
import { assemble, PUSH_BUTTON_LEVELS, type PushButtonLevel } from './index';
import type { MATERIALS } from './materials';
import { MOUNT } from './mount';
import type { Part } from './part';

type Shape = Part['shape'];

const lens =
  (corners: readonly Corner[]): Shape =>
  (b, t) =>
    revolve(b, openOutline(corners, t), circleSegments(Math.max(...corners.map(({ x }) => x)), t), false);
const ring =
  (corners: readonly Corner[]): Shape =>
  (b, t) =>
    revolve(b, closedOutline(corners, t), circleSegments(14.7, t), true);
const SIGN = { bottom: 0, top: 0.25, topRadius: 0.12 } as const;
const sign = (
  b: MeshBuilder,
  outline: ReturnType<typeof closedOutline> | InsetOutline,
  t: Tessellation,
  holes: ReturnType<typeof circleOutline>[] = [],
) => extrude(b, outline, holes, { ...SIGN, tessellation: t });
const polygon =
  (corners: readonly Corner[]): Shape =>
  (b, t) =>
    sign(b, closedOutline(corners, t), t);

/** Lenses by name, and the height of the face that carries the legend, millimetres in front of the panel. */
const LENSES: Readonly<Record<string, { readonly face: number; readonly shape: Shape }>> = {
  flush: {
    face: 8.4,
    shape: lens([
      { x: 0, y: 1 },
      { x: 10.2, y: 1 },
      { x: 10.2, y: 8.8, r: 0.9 },
      { x: 8.9, y: 9.15, r: 0.6 },
      { x: 7.4, y: 8.4, r: 1.2 },
      { x: 0, y: 8.4 },
    ]),
  },
  raised: {
    face: 13.2,
    shape: lens([
      { x: 0, y: 1 },
      { x: 10.2, y: 1 },
      { x: 10.2, y: 13.2, r: 1.1 },
      { x: 0, y: 13.2 },
    ]),
  },
  domed: {
    face: 11.6,
    shape: lens([
      { x: 0, y: 1 },
      { x: 10.2, y: 1 },
      { x: 10.2, y: 8.4, r: 1.2 },
      { x: 8.2, y: 10.9, r: 2.4 },
      { x: 5.4, y: 11.6, r: 2 },
      { x: 0, y: 11.6 },
    ]),
  },
  mushroom: {
    face: 20.2,
    shape: lens([
      { x: 0, y: 1 },
      { x: 7.5, y: 1 },
      { x: 7.5, y: 10.5, r: 0.8 },
      { x: 17.5, y: 11.2, r: 0.8 },
      { x: 19.2, y: 13.6, r: 1.6 },
      { x: 16, y: 18.6, r: 5 },
      { x: 8, y: 20.2, r: 4 },
      { x: 0, y: 20.2 },
    ]),
  },
};

const ARM = 0.75;
const REACH = 3.4;

const LEGENDS: Readonly<Record<string, Shape>> = {
  power: (b, t) => {
    sign(b, openRing(3.1, 4.1, 0.5, t), t);
    sign(b, closedOutline(rectangle(0, 3.2, 1, 3.6, 0.2), t), t);
  },
  start: polygon(rectangle(0, 0, 1.3, 7, 0.2)),
  stop: (b, t) =>
    sign(b, circleOutline(0, 0, 3.9, circleSegments(3.9, t)), t, [
      circleOutline(0, 0, 2.8, circleSegments(2.8, t), true),
    ]),
  run: polygon([
    { x: -2.2, y: -3.4, r: 0.3 },
    { x: 3.7, y: 0, r: 0.3 },
    { x: -2.2, y: 3.4, r: 0.3 },
  ]),
  halt: polygon(rectangle(0, 0, 5.6, 5.6, 0.3)),
  arrow: polygon([
    { x: -0.8, y: -3.8 },
    { x: 0.8, y: -3.8 },
    { x: 0.8, y: 0.2 },
    { x: 2.9, y: 0.2, r: 0.15 },
    { x: 0, y: 4, r: 0.2 },
    { x: -2.9, y: 0.2, r: 0.15 },
    { x: -0.8, y: 0.2 },
  ]),
  plus: polygon([
    { x: -ARM, y: -REACH },
    { x: ARM, y: -REACH },
    { x: ARM, y: -ARM },
    { x: REACH, y: -ARM },
    { x: REACH, y: ARM },
    { x: ARM, y: ARM },
    { x: ARM, y: REACH },
    { x: -ARM, y: REACH },
    { x: -ARM, y: ARM },
    { x: -REACH, y: ARM },
    { x: -REACH, y: -ARM },
    { x: -ARM, y: -ARM },
  ]),
};

const BEZELS: Readonly<Record<string, Shape>> = {
  slim: ring([
    { x: 11.5, y: 0.9 },
    { x: 14.2, y: 0.9, r: 0.2 },
    { x: 14, y: 2.6, r: 0.8 },
    { x: 12.3, y: 4.5, r: 0.5 },
    { x: 11.5, y: 4.2, r: 0.2 },
  ]),
  square: (b, t) =>
    extrude(
      b,
      closedOutline(rectangle(0, 0, 30, 30, 4), t),
      [circleOutline(0, 0, 11.5, circleSegments(11.5, t), true)],
      { bottom: 0.9, top: 6.2, bottomRadius: 0.2, topRadius: 1.1, tessellation: t },
    ),
};

const panelHole = (t: Tessellation) => circleOutline(0, 0, 11.25, circleSegments(11.25, t), true);

const PANELS: Readonly<Record<string, Shape>> = {
  'Round panel': (b, t) =>
    extrude(b, circleOutline(0, 0, 29, circleSegments(29, t)), [panelHole(t)], {
      bottom: -2.5,
      top: 0,
      bottomRadius: 0.4,
      topRadius: 0.6,
      tessellation: t,
    }),
  'Enclosure lid': (b, t) => {
    extrude(b, closedOutline(rectangle(0, 0, 76, 76, 7), t), [panelHole(t)], {
      bottom: -2.5,
      top: 0,
      topRadius: 1.2,
      tessellation: t,
    });
    extrude(
      b,
      closedOutline(rectangle(0, 0, 76, 76, 7), t),
      [closedOutline([...rectangle(0, 0, 71, 71, 5)].reverse(), t)],
      { bottom: -16, top: -2.5, bottomRadius: 0.5, tessellation: t },
    );
  },
};

const named = (
  name: string,
  material: Part['material'],
  shape: Shape,
  at: readonly [number, number, number] = [0, 0, 0],
): Part => ({ name, material, shape, placement: { at } });
const front = (name: string): Part => FRONT.find((part) => part.name === name) as Part;

const PARTS: readonly Part[] = [
  front('Seal'),
  { ...front('Bezel ring'), name: 'Bezel round' },
  ...Object.entries(BEZELS).map(([name, shape]) => named(`Bezel ${name}`, 'bezel chrome', shape)),
  front('Light ring'),
  ...Object.entries(LENSES).map(([name, { shape }]) => named(`Lens ${name}`, 'lens green', shape)),
  ...Object.entries(LEGENDS).map(([name, shape]) => named(`Legend ${name}`, 'legend white', shape, [0, 0, 8.3])),
  front('Mounting plate'),
  ...Object.entries(PANELS).map(([name, shape]) => named(name, 'plate aluminium', shape)),
  ...MOUNT,
  ...CONTACT_BLOCKS,
];

/** Names of the parts among which a push-button is put together; see {@link createPushButtonKit}. */
export const PUSH_BUTTON_KIT = {
  /** Heights of the faces that carry the legend, metres in front of the panel, by lens: the part is `Lens <name>`. */
  lenses: Object.fromEntries(Object.entries(LENSES).map(([name, { face }]) => [name, face / 1000])) as Readonly<
    Record<string, number>
  >,
  /** The part is `Legend <name>`. */
  legends: Object.keys(LEGENDS),
  /** The part is `Bezel <name>`. */
  bezels: ['round', ...Object.keys(BEZELS)],
  /** Parts of each way of mounting. */
  mountings: {
    plate: ['Mounting plate', ...MOUNT.flatMap(({ name }) => (/^Plate (screw|nut)/.test(name) ? [name] : []))],
    round: ['Round panel'],
    lid: ['Enclosure lid'],
  } as Readonly<Record<string, readonly string[]>>,
  /** Parts of each block behind the flange. */
  blocks: Object.fromEntries(
    (['Contact block NC', 'Lamp block', 'Contact block NO'] as const).map((block) => [
      block,
      CONTACT_BLOCKS.flatMap(({ name }) => (name.startsWith(block) ? [name] : [])),
    ]),
  ) as unknown as Readonly<Record<'Contact block NC' | 'Lamp block' | 'Contact block NO', readonly string[]>>,
  /** Materials that choices change. */
  materials: {
    lens: 'lens green',
    legend: 'legend white',
    halo: 'halo light',
    bezel: 'bezel chrome',
    panel: 'plate aluminium',
  } as const satisfies Readonly<Record<string, keyof typeof MATERIALS>>,
} as const;

/**
 * All parts that an illuminated push-button can be put together from, lying in one another: lenses, legends, bezels,
 * ways of mounting, contact blocks. Show some and hide the rest, see {@link PUSH_BUTTON_KIT} for what belongs together.
 */
export function createPushButtonKit(options: { readonly level?: PushButtonLevel } = {}): Scene {
  return assemble('Push-button kit', PARTS, PUSH_BUTTON_LEVELS[options.level ?? 'medium']);
}
