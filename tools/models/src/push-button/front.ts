import { extrude, type InsetOutline } from '../shapes/extrude';
import { circleOutline, closedOutline, openOutline, rectangle } from '../shapes/outline';
import { revolve } from '../shapes/revolve';
import { arcSegments, circleSegments, type Tessellation } from '../shapes/tessellation';
import type { Part } from './part';

/** An open ring seen from the front, the arc of a power sign, at any inset. */
export function openRing(inner: number, outer: number, gap: number, tessellation: Tessellation): InsetOutline {
  const steps = arcSegments(outer, 2 * Math.PI - 2 * gap, tessellation);
  return (inset) => {
    const arc = (radius: number, sign: 1 | -1) => {
      // The ends stand back by the inset too: along the arc that is an angle.
      const start = gap + Math.asin(inset / radius);
      const from = Math.PI / 2 + (sign > 0 ? start : 2 * Math.PI - start);
      const sweep = sign * (2 * Math.PI - 2 * start);
      return Array.from({ length: steps + 1 }, (_, i) => {
        const [c, s] = [Math.cos(from + (sweep * i) / steps), Math.sin(from + (sweep * i) / steps)];
        return { x: radius * c, y: radius * s, nx: sign * c, ny: sign * s, mx: sign * c, my: sign * s };
      });
    };
    const end = (angle: number, sign: 1 | -1) => {
      const [nx, ny] = [-Math.sin(angle) * sign, Math.cos(angle) * sign];
      return { nx, ny, mx: nx, my: ny };
    };
    const [outside, inside] = [arc(outer - inset, 1), arc(inner + inset, -1)];
    const [first, second] = [end(Math.PI / 2 + gap, -1), end(Math.PI / 2 - gap, 1)];
    return [
      { ...outside[0]!, ...first },
      ...outside,
      { ...outside[steps]!, ...second },
      { ...inside[0]!, ...second },
      ...inside,
      { ...inside[steps]!, ...first },
    ];
  };
}

/** What the user sees of the button: seal, bezel, light ring, lens and its sign. */
export const FRONT: readonly Part[] = [
  {
    name: 'Seal',
    material: 'rubber black',
    shape: (b, t) => {
      const profile = closedOutline(
        [
          { x: 11.2, y: 0 },
          { x: 15.1, y: 0 },
          { x: 15.1, y: 1.1, r: 0.5 },
          { x: 11.2, y: 1.1 },
        ],
        t,
      );
      revolve(b, profile, circleSegments(15, t), true);
    },
  },
  {
    name: 'Bezel ring',
    material: 'bezel chrome',
    shape: (b, t) => {
      const profile = closedOutline(
        [
          { x: 11.5, y: 0.9 },
          { x: 14.7, y: 0.9, r: 0.2 },
          { x: 14.7, y: 2.4, r: 0.12 },
          { x: 14.35, y: 2.4, r: 0.12 },
          { x: 14.35, y: 2.9, r: 0.12 },
          { x: 14.7, y: 2.9, r: 0.12 },
          { x: 14.5, y: 5.2, r: 1.5 },
          { x: 12.9, y: 7.2, r: 0.9 },
          { x: 11.75, y: 6.9, r: 0.4 },
          { x: 11.5, y: 5.2, r: 0.3 },
        ],
        t,
      );
      revolve(b, profile, circleSegments(14.7, t), true);
    },
  },
  {
    name: 'Light ring',
    material: 'halo light',
    shape: (b, t) => {
      const profile = closedOutline(
        [
          { x: 10.35, y: 1 },
          { x: 11.45, y: 1 },
          { x: 11.45, y: 6.1, r: 0.45 },
          { x: 10.35, y: 6.1, r: 0.45 },
        ],
        t,
      );
      revolve(b, profile, circleSegments(11.4, t), true);
    },
  },
  {
    name: 'Lens',
    material: 'lens green',
    shape: (b, t) => {
      const profile = openOutline(
        [
          { x: 0, y: 1 },
          { x: 10.2, y: 1 },
          { x: 10.2, y: 8.8, r: 0.9 },
          { x: 8.9, y: 9.15, r: 0.6 },
          { x: 7.4, y: 8.4, r: 1.2 },
          { x: 0, y: 8.4 },
        ],
        t,
      );
      revolve(b, profile, circleSegments(10.2, t), false);
    },
  },
  {
    name: 'Legend arc',
    material: 'legend white',
    placement: { at: [0, 0, 8.3] },
    shape: (b, t) =>
      extrude(b, openRing(3.1, 4.1, 0.5, t), [], { bottom: 0, top: 0.25, topRadius: 0.12, tessellation: t }),
  },
  {
    name: 'Legend bar',
    material: 'legend white',
    placement: { at: [0, 0, 8.3] },
    shape: (b, t) =>
      extrude(b, closedOutline(rectangle(0, 3.2, 1, 3.6, 0.2), t), [], {
        bottom: 0,
        top: 0.25,
        topRadius: 0.12,
        tessellation: t,
      }),
  },
  {
    name: 'Mounting plate',
    material: 'plate aluminium',
    placement: { at: [0, 0, -2.5] },
    shape: (b, t) => {
      const holes = [circleOutline(0, 0, 11.25, circleSegments(11.25, t), true)];
      for (const x of [-20, 20])
        for (const y of [-20, 20]) holes.push(circleOutline(x, y, 1.7, circleSegments(1.7, t), true));
      extrude(b, closedOutline(rectangle(0, 0, 50, 50, 5), t), holes, {
        bottom: 0,
        top: 2.5,
        bottomRadius: 0.4,
        topRadius: 0.4,
        tessellation: t,
      });
    },
  },
];
