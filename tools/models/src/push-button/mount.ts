import { extrude } from '../shapes/extrude';
import type { MeshBuilder } from '../shapes/mesh-builder';
import { circleOutline, closedOutline, rectangle, type Corner, type Outline } from '../shapes/outline';
import { slottedScrew } from '../shapes/screw';
import { circleSegments, isNegligible, type Tessellation } from '../shapes/tessellation';
import { threadedRod } from '../shapes/thread';
import { tube } from '../shapes/tube';
import type { Part } from './part';

/**
 * A gear-like outline: `count` teeth between two radii, rounded; a circle where teeth would be finer than the
 * tessellation.
 */
function toothed(inner: number, outer: number, count: number, share: number, r: number, t: Tessellation): Outline {
  if (isNegligible((outer - inner) / 2, t)) return circleOutline(0, 0, outer, circleSegments(outer, t));
  const corners: Corner[] = [];
  const step = (2 * Math.PI) / count;
  for (let i = 0; i < count; i++) {
    const [a, b] = [(i - share / 2) * step, (i + share / 2) * step];
    const slope = (step * (1 - share)) / 5;
    for (const [angle, radius] of [
      [a - slope, inner],
      [a, outer],
      [b, outer],
      [b + slope, inner],
    ] as const)
      corners.push({ x: radius * Math.cos(angle), y: radius * Math.sin(angle), r });
  }
  return closedOutline(corners, t);
}

function hexNut(b: MeshBuilder, t: Tessellation, width: number, height: number, hole: number): void {
  const corners = Array.from({ length: 6 }, (_, i) => ({
    x: (width / Math.sqrt(3)) * Math.cos((i * Math.PI) / 3),
    y: (width / Math.sqrt(3)) * Math.sin((i * Math.PI) / 3),
    r: 0.35,
  }));
  extrude(b, closedOutline(corners, t), [circleOutline(0, 0, hole, circleSegments(hole, t), true)], {
    bottom: 0,
    top: height,
    bottomRadius: 0.25,
    topRadius: 0.25,
    tessellation: t,
  });
}

const plateCorners = [
  [-20, -20],
  [20, -20],
  [20, 20],
  [-20, 20],
] as const;

/** What holds the button in the panel: threaded barrel, washer, collar nut, flange with its latch, plate screws. */
export const MOUNT: readonly Part[] = [
  {
    name: 'Housing barrel',
    material: 'polyamide black',
    shape: (b, t) =>
      threadedRod(b, { radius: 11.05, depth: 0.75, pitch: 1.5, bottom: -15.5, top: 0.95, tessellation: t }),
  },
  {
    name: 'Lock washer',
    material: 'zinc-plated steel',
    placement: { at: [0, 0, -3.4] },
    shape: (b, t) =>
      extrude(b, toothed(15.2, 16.4, 20, 0.5, 0.25, t), [circleOutline(0, 0, 11.2, circleSegments(11.2, t), true)], {
        bottom: 0,
        top: 0.85,
        bottomRadius: 0.12,
        topRadius: 0.12,
        tessellation: t,
      }),
  },
  {
    name: 'Collar nut',
    material: 'zinc die-cast',
    placement: { at: [0, 0, -9] },
    shape: (b, t) =>
      extrude(b, toothed(14.5, 15.5, 28, 0.45, 0.28, t), [circleOutline(0, 0, 11, circleSegments(11, t), true)], {
        bottom: 0,
        top: 5.4,
        bottomRadius: 0.25,
        topRadius: 0.25,
        tessellation: t,
      }),
  },
  {
    name: 'Flange',
    material: 'polyamide grey',
    placement: { at: [0, 0, -20] },
    shape: (b, t) => {
      const outline: Corner[] = [
        { x: -17, y: -15, r: 2.5 },
        { x: -6, y: -15, r: 0.8 },
        { x: -5, y: -16.5, r: 0.8 },
        { x: 5, y: -16.5, r: 0.8 },
        { x: 6, y: -15, r: 0.8 },
        { x: 17, y: -15, r: 2.5 },
        { x: 17, y: 15, r: 2.5 },
        { x: 6, y: 15, r: 0.8 },
        { x: 5, y: 16.5, r: 0.8 },
        { x: -5, y: 16.5, r: 0.8 },
        { x: -6, y: 15, r: 0.8 },
        { x: -17, y: 15, r: 2.5 },
      ];
      extrude(b, closedOutline(outline, t), [], {
        bottom: 0,
        top: 6,
        bottomRadius: 0.6,
        topRadius: 0.6,
        tessellation: t,
      });
    },
  },
  {
    name: 'Latch lever',
    material: 'polyamide orange',
    placement: { at: [17.1, -1.5, -17], x: [0, 1, 0], z: [1, 0, 0] },
    shape: (b, t) => {
      const outline: Corner[] = [
        { x: -5, y: -1.6, r: 1.5 },
        { x: 6.2, y: -1.6, r: 0.6 },
        { x: 9.4, y: 0.5, r: 0.8 },
        { x: 8.4, y: 2.3, r: 0.8 },
        { x: 5.2, y: 1.6, r: 0.9 },
        { x: -5, y: 1.6, r: 1.5 },
      ];
      extrude(b, closedOutline(outline, t), [], {
        bottom: 0,
        top: 2.2,
        bottomRadius: 0.35,
        topRadius: 0.35,
        tessellation: t,
      });
    },
  },
  ...([-10.6, 10.6] as const).map((y, i): Part => ({
    name: `Flange screw ${i + 1}`,
    material: 'zinc-plated steel',
    placement: { at: [17, y, -17], x: [0, 1, 0], z: [1, 0, 0] },
    shape: (b, t) =>
      slottedScrew(b, {
        headRadius: 2,
        headHeight: 1.3,
        slotWidth: 0.6,
        slotDepth: 0.8,
        shankRadius: 1,
        shankLength: 3,
        pitch: 0.6,
        slotAngle: 0.4 + i * 1.1,
        tessellation: t,
      }),
  })),
  ...([-12.8, 12.8] as const).map((x, i): Part => ({
    name: `Latch spring ${i + 1}`,
    material: 'zinc-plated steel',
    shape: (b, t) => {
      const coils = 4.5;
      const [radius, wire] = [1.5, 0.28];
      const steps = Math.ceil((coils * circleSegments(radius, t)) / 1.3);
      tube(
        b,
        (s) => [
          x + radius * Math.cos(s * coils * 2 * Math.PI),
          -8.5 + radius * Math.sin(s * coils * 2 * Math.PI),
          -14.2 + s * 5.3,
        ],
        wire,
        steps,
        Math.max(5, Math.round(circleSegments(wire, t) * 0.75)),
      );
    },
  })),
  ...plateCorners.map(([x, y], i): Part => ({
    name: `Plate screw ${i + 1}`,
    material: 'zinc-plated steel',
    placement: { at: [x, y, 0] },
    shape: (b, t) =>
      slottedScrew(b, {
        headRadius: 2.75,
        headHeight: 1.9,
        slotWidth: 0.8,
        slotDepth: 1.1,
        shankRadius: 1.5,
        shankLength: 10,
        pitch: 0.7,
        slotAngle: 0.5 + i * 1.9,
        tessellation: t,
      }),
  })),
  ...plateCorners.map(([x, y], i): Part => ({
    name: `Plate nut ${i + 1}`,
    material: 'zinc-plated steel',
    placement: { at: [x, y, -4.9] },
    shape: (b, t) => hexNut(b, t, 5.5, 2.4, 1.52),
  })),
  {
    name: 'Identification label',
    material: 'polycarbonate white',
    placement: { at: [-17.05, 0, -17], x: [0, 1, 0], z: [-1, 0, 0] },
    shape: (b, t) =>
      extrude(b, closedOutline(rectangle(0, 0, 14, 3.4, 0.6), t), [], {
        bottom: 0,
        top: 0.4,
        topRadius: 0.15,
        tessellation: t,
      }),
  },
];
