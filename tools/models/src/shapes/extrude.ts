import type { MeshBuilder } from './mesh-builder';
import type { Outline, OutlinePoint } from './outline';
import { arcSegments, isNegligible, type Tessellation } from './tessellation';
import { triangulate } from './triangulate';

/** Options for {@link extrude}. Millimetres. */
export interface ExtrudeOptions {
  /** Heights of the two ends; `bottom < top`. */
  readonly bottom: number;
  readonly top: number;
  /** Radii that round off the edges at the two ends; default 0, sharp. */
  readonly bottomRadius?: number;
  readonly topRadius?: number;
  readonly tessellation: Tessellation;
}

/**
 * A level of the wall: how far it stands back, at which height, and the share of the outline's normal and of z in the
 * normal.
 */
interface Level {
  readonly inset: number;
  readonly z: number;
  readonly across: number;
  readonly along: number;
}

function levels({ bottom, top, bottomRadius = 0, topRadius = 0, tessellation }: ExtrudeOptions): Level[] {
  const result: Level[] = [];
  const arc = (radius: number, from: number, z: number) => {
    const steps = arcSegments(radius, Math.PI / 2, tessellation);
    for (let i = 0; i <= steps; i++) {
      const angle = from + ((Math.PI / 2) * i) / steps;
      result.push({
        inset: radius * (1 - Math.cos(angle)),
        z: z + radius * Math.sin(angle),
        across: Math.cos(angle),
        along: Math.sin(angle),
      });
    }
  };
  if (!isNegligible(bottomRadius, tessellation)) arc(bottomRadius, -Math.PI / 2, bottom + bottomRadius);
  else result.push({ inset: 0, z: bottom, across: 1, along: 0 });
  if (!isNegligible(topRadius, tessellation)) arc(topRadius, 0, top - topRadius);
  else result.push({ inset: 0, z: top, across: 1, along: 0 });
  return result.filter(
    (level, i) => i === 0 || Math.hypot(level.z - result[i - 1]!.z, level.inset - result[i - 1]!.inset) > 1e-9,
  );
}

const place = (p: OutlinePoint, inset: number): [number, number] => [p.x - p.mx * inset, p.y - p.my * inset];

/**
 * An outline that knows its own insets: same points in the same order for every inset. Needed where a curve meets a
 * sharp corner, for there the points next to the corner would overtake it.
 */
export type InsetOutline = (inset: number) => Outline;

const insetOf = (loop: Outline | InsetOutline, inset: number): readonly (readonly [number, number])[] =>
  typeof loop === 'function' ? loop(inset).map((p) => [p.x, p.y] as const) : loop.map((p) => place(p, inset));

/**
 * Pulls an outline, with holes, along z into a closed solid with rounded edges. Radii of corners must be larger than
 * those of the edges they run along, or zero.
 */
export function extrude(
  builder: MeshBuilder,
  outer: Outline | InsetOutline,
  holes: readonly Outline[],
  options: ExtrudeOptions,
): void {
  const wall = levels(options);
  const sources = [outer, ...holes];
  for (const source of sources) {
    const loop = typeof source === 'function' ? source(0) : source;
    const n = loop.length;
    const first = builder.vertexCount;
    for (const { inset, z, across, along } of wall) {
      for (const [i, [x, y]] of insetOf(source, inset).entries())
        builder.vertex(x, y, z, loop[i]!.nx * across, loop[i]!.ny * across, along);
    }
    for (let l = 0; l + 1 < wall.length; l++) {
      for (let i = 0; i < n; i++) {
        const j = (i + 1) % n;
        if (loop[i]!.x === loop[j]!.x && loop[i]!.y === loop[j]!.y) continue;
        builder.quad(first + l * n + i, first + l * n + j, first + (l + 1) * n + j, first + (l + 1) * n + i);
      }
    }
  }
  for (const [level, up] of [
    [wall[0]!, -1],
    [wall[wall.length - 1]!, 1],
  ] as const) {
    const loops = sources.map((source) => {
      const flat = typeof source === 'function' ? source(0) : source;
      return insetOf(source, level.inset).filter((_, i) => {
        const next = flat[(i + 1) % flat.length]!;
        return flat[i]!.x !== next.x || flat[i]!.y !== next.y;
      });
    });
    const first = builder.vertexCount;
    for (const loop of loops) for (const [x, y] of loop) builder.vertex(x, y, level.z, 0, 0, up);
    const triangles = triangulate(loops[0]!, loops.slice(1));
    for (let i = 0; i < triangles.length; i += 3) {
      const [a, b, c] = [first + triangles[i]!, first + triangles[i + 1]!, first + triangles[i + 2]!];
      if (up > 0) builder.triangle(a, b, c);
      else builder.triangle(a, c, b);
    }
  }
}
