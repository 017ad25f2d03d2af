import { extrude } from '../shapes/extrude';
import { circleOutline, closedOutline, rectangle, type Corner } from '../shapes/outline';
import { slottedScrew } from '../shapes/screw';
import { circleSegments } from '../shapes/tessellation';
import { spline, tube } from '../shapes/tube';
import type { MaterialName } from './materials';
import type { Part } from './part';

interface BlockOptions {
  readonly name: string;
  /** Middle of the block across the row, mm. */
  readonly x: number;
  readonly body: MaterialName;
  readonly plunger: MaterialName;
  readonly wire: MaterialName;
  /** Sideways swing of the wires, mm. */
  readonly swing: number;
}

const WIDTH = 10.2;

/** Side view of the body: y runs along +x of the outline, depth behind the flange along +y. */
const BODY: readonly Corner[] = [
  { x: -13.5, y: 0, r: 0.6 },
  { x: 13.5, y: 0, r: 0.6 },
  { x: 13.5, y: 4.5, r: 0.5 },
  { x: 15.5, y: 6, r: 0.5 },
  { x: 15.5, y: 9.5, r: 0.5 },
  { x: 11.2, y: 9.5, r: 0.45 },
  { x: 11.2, y: 20.5, r: 0.6 },
  { x: 9.2, y: 23, r: 1.2 },
  { x: -9.2, y: 23, r: 1.2 },
  { x: -11.2, y: 20.5, r: 0.6 },
  { x: -11.2, y: 9.5, r: 0.45 },
  { x: -15.5, y: 9.5, r: 0.5 },
  { x: -15.5, y: 6, r: 0.5 },
  { x: -13.5, y: 4.5, r: 0.5 },
];

function terminal({ name, x, wire, swing }: BlockOptions, side: 1 | -1): Part[] {
  const label = `${name} terminal ${side > 0 ? 'top' : 'bottom'}`;
  const y = side * 11.2;
  const up = { x: [1, 0, 0] as const, z: [0, side, 0] as const };
  return [
    {
      name: `${label} plate`,
      material: 'brass',
      placement: { at: [x, y - side * 0.2, -35.4], ...up },
      shape: (b, t) =>
        extrude(
          b,
          closedOutline(rectangle(0, 0, 7.4, 8.6, 0.8), t),
          [circleOutline(0, 0, 1.55, circleSegments(1.55, t), true)],
          { bottom: 0, top: 1.2, bottomRadius: 0.15, topRadius: 0.2, tessellation: t },
        ),
    },
    {
      name: `${label} clamp`,
      material: 'zinc-plated steel',
      placement: { at: [x, y + side * 2.3, -35.4], ...up },
      shape: (b, t) =>
        extrude(
          b,
          closedOutline(rectangle(0, 0, 6.6, 6.6, 1.1), t),
          [circleOutline(0, 0, 1.55, circleSegments(1.55, t), true)],
          { bottom: 0, top: 0.8, bottomRadius: 0.2, topRadius: 0.2, tessellation: t },
        ),
    },
    {
      name: `${label} screw`,
      material: 'zinc-plated steel',
      placement: { at: [x, y + side * 3.1, -35.4], ...up },
      shape: (b, t) =>
        slottedScrew(b, {
          headRadius: 2.7,
          headHeight: 2,
          slotWidth: 0.75,
          slotDepth: 1.2,
          shankRadius: 1.5,
          shankLength: 3.6,
          pitch: 0.7,
          slotAngle: 0.9 + x * 0.31 + side,
          tessellation: t,
        }),
    },
    {
      name: `${label} conductor`,
      material: 'copper',
      shape: (b, t) => {
        const at = y + side * 1.65;
        const segments = Math.max(6, circleSegments(0.65, t));
        tube(b, (s) => [x + 2.05, at, -34.2 - s * 9.3], 0.65, 1, segments);
      },
    },
    {
      name: `${label} wire`,
      material: wire,
      shape: (b, t) => {
        const at = y + side * 1.65;
        const curve = spline([
          [x + 2.05, at, -40.6],
          [x + 2.05 + swing * 0.1, at + side * 0.6, -45],
          [x + 2.05 + swing * 0.5, at + side * 3.5, -50],
          [x + 2.05 + swing, at + side * 9.5, -54],
          [x + 2.05 + swing * 1.1, at + side * 17, -55.5],
        ]);
        tube(
          b,
          curve,
          1.25,
          Math.max(6, Math.round(circleSegments(14, t) * 0.6)),
          Math.max(6, circleSegments(1.25, t)),
        );
      },
    },
  ];
}

function block(options: BlockOptions): Part[] {
  const { name, x, body, plunger } = options;
  // The outline is drawn in the (y, depth) plane and pulled across x.
  const across = { x: [0, 1, 0] as const, z: [-1, 0, 0] as const };
  return [
    {
      name: `${name} body`,
      material: body,
      placement: { at: [x + WIDTH / 2, 0, -20.3], ...across },
      shape: (b, t) =>
        extrude(b, closedOutline(BODY, t), [], {
          bottom: 0.1,
          top: WIDTH - 0.1,
          bottomRadius: 0.35,
          topRadius: 0.35,
          tessellation: t,
        }),
    },
    {
      name: `${name} plunger`,
      material: plunger,
      placement: { at: [x, 0, -45.2] },
      shape: (b, t) =>
        extrude(b, closedOutline(rectangle(0, 0, 5.6, 9, 1.1), t), [], {
          bottom: 0,
          top: 4,
          bottomRadius: 0.6,
          tessellation: t,
        }),
    },
    ...([-1, 1] as const).map((side): Part => ({
      name: `${name} clip ${side > 0 ? 'top' : 'bottom'}`,
      material: plunger,
      placement: { at: [x, side * 13.45, -24.6], x: [1, 0, 0], z: [0, side, 0] },
      shape: (b, t) =>
        extrude(b, closedOutline(rectangle(0, 0, 4.6, 5.2, 0.7), t), [], {
          bottom: 0,
          top: 0.9,
          topRadius: 0.35,
          tessellation: t,
        }),
    })),
    ...terminal(options, 1),
    ...terminal(options, -1),
  ];
}

/** Side cover of an outer block: a raised panel with grip ribs, snapped in by two round pins. */
function cover(name: string, x: number, side: 1 | -1, material: MaterialName): Part {
  return {
    name: `${name} cover`,
    material,
    placement: { at: [x + (side * WIDTH) / 2 - side * 0.12, 0, -20.3], x: [0, side, 0], z: [side, 0, 0] },
    shape: (b, t) => {
      // Seen from outside: x across the block, the depth behind the flange along −y.
      extrude(b, closedOutline(rectangle(0, -13.2, 17.6, 15.4, 1.6), t), [], {
        bottom: 0,
        top: 0.55,
        topRadius: 0.3,
        tessellation: t,
      });
      for (let i = 0; i < 5; i++)
        extrude(b, closedOutline(rectangle(0, -15 - i * 1.15, 11, 0.6, 0.28), t), [], {
          bottom: 0.4,
          top: 1,
          topRadius: 0.24,
          tessellation: t,
        });
      for (const px of [-6.2, 6.2])
        extrude(b, circleOutline(px, -8.4, 1.25, circleSegments(1.25, t)), [], {
          bottom: 0.4,
          top: 0.85,
          topRadius: 0.25,
          tessellation: t,
        });
    },
  };
}

/** Behind the flange: two contact blocks and the lamp block between them, wired. */
export const CONTACT_BLOCKS: readonly Part[] = [
  ...block({
    name: 'Contact block NC',
    x: -10.8,
    body: 'polyamide black',
    plunger: 'polyamide red',
    wire: 'insulation black',
    swing: -4,
  }),
  cover('Contact block NC', -10.8, -1, 'polyamide black'),
  ...block({
    name: 'Lamp block',
    x: 0,
    body: 'polycarbonate white',
    plunger: 'polycarbonate white',
    wire: 'insulation red',
    swing: 1.5,
  }),
  ...block({
    name: 'Contact block NO',
    x: 10.8,
    body: 'polyamide black',
    plunger: 'polyamide green',
    wire: 'insulation blue',
    swing: 6,
  }),
  cover('Contact block NO', 10.8, 1, 'polyamide black'),
];
