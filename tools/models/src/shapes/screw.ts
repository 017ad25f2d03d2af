import { extrude, type InsetOutline } from './extrude';
import type { MeshBuilder } from './mesh-builder';
import { openOutline } from './outline';
import { revolve } from './revolve';
import { arcSegments, circleSegments, type Tessellation } from './tessellation';
import { threadedRod } from './thread';

/** Options for {@link slottedScrew}. Millimetres. */
export interface ScrewOptions {
  readonly headRadius: number;
  readonly headHeight: number;
  readonly slotWidth: number;
  readonly slotDepth: number;
  readonly shankRadius: number;
  readonly shankLength: number;
  readonly pitch: number;
  /** Turns the slot, radians. */
  readonly slotAngle?: number;
  readonly tessellation: Tessellation;
}

/** One half of a slotted head, what is left of a disc beyond a line, at any inset. */
function halfMoon(radius: number, line: number, angle: number, tessellation: Tessellation): InsetOutline {
  const steps = Math.max(3, arcSegments(radius, 2 * Math.acos(line / radius), tessellation));
  const turn = (x: number, y: number): [number, number] => [
    x * Math.cos(angle) - y * Math.sin(angle),
    x * Math.sin(angle) + y * Math.cos(angle),
  ];
  const [cx, cy] = turn(-1, 0);
  return (inset) => {
    const r = radius - inset;
    const end = Math.acos((line + inset) / r);
    const arc = Array.from({ length: steps + 1 }, (_, i) => {
      const [nx, ny] = turn(Math.cos(-end + (2 * end * i) / steps), Math.sin(-end + (2 * end * i) / steps));
      return { x: r * nx, y: r * ny, nx, ny, mx: nx, my: ny };
    });
    const chord = { nx: cx, ny: cy, mx: cx, my: cy };
    return [{ ...arc[0]!, ...chord }, ...arc, { ...arc[steps]!, ...chord }];
  };
}

/**
 * A cheese-head screw with a slot, along z: its head sits on z = 0 and points to +z, the threaded shank to −z. Closed
 * shells that overlap: the shank, the lower part of the head, and two half moons that leave the slot between them.
 */
export function slottedScrew(builder: MeshBuilder, options: ScrewOptions): void {
  const {
    headRadius: radius,
    headHeight: height,
    slotWidth,
    slotDepth,
    shankRadius,
    shankLength,
    pitch,
    tessellation,
  } = options;
  threadedRod(builder, {
    radius: shankRadius,
    depth: shankRadius * 0.18,
    pitch,
    bottom: -shankLength,
    top: 0.05,
    tessellation,
  });
  const floor = height - slotDepth;
  const edge = Math.min(0.15, floor / 3);
  revolve(
    builder,
    openOutline(
      [
        { x: 0, y: 0 },
        { x: radius, y: 0, r: edge },
        { x: radius, y: floor },
        { x: 0, y: floor },
      ],
      tessellation,
    ),
    circleSegments(radius, tessellation),
    false,
  );
  const round = Math.min(0.28, slotDepth * 0.45);
  for (const half of [0, Math.PI]) {
    const outline = halfMoon(radius, slotWidth / 2, (options.slotAngle ?? 0) + half, tessellation);
    extrude(builder, outline, [], { bottom: floor - 0.02, top: height, topRadius: round, tessellation });
  }
}
