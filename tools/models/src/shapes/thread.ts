import type { MeshBuilder } from './mesh-builder';
import { circleSegments, type Tessellation } from './tessellation';

/** Options for {@link threadedRod}. Millimetres. */
export interface ThreadOptions {
  /** Largest radius. */
  readonly radius: number;
  /** Depth of the thread. */
  readonly depth: number;
  /** Height of one turn. */
  readonly pitch: number;
  /** Ends of the rod on the z axis. */
  readonly bottom: number;
  readonly top: number;
  readonly tessellation: Tessellation;
}

/** Height of a 60° thread with truncated crest and root over one turn, 0..1. */
function threadProfile(turn: number): number {
  const phase = turn - Math.floor(turn);
  const slope = (1 - Math.abs(2 * phase - 1)) * 1.6 - 0.3;
  const s = Math.min(Math.max(slope, 0), 1);
  return s * s * (3 - 2 * s);
}

/**
 * A rod with a thread and flat ends: a cylinder whose radius varies along a helix, so that it is closed by
 * construction. The thread runs out at both ends. Too coarse a tessellation to show the thread leaves it away, as
 * exporters of simplified CAD models do.
 */
export function threadedRod(
  builder: MeshBuilder,
  { radius, depth, pitch, bottom, top, tessellation }: ThreadOptions,
): void {
  const segments = circleSegments(radius, tessellation);
  // Rows of a turn: the flanks bend within about a third of the pitch.
  const rows = Math.round(circleSegments(pitch / 3, tessellation) / 2);
  const plain = rows < 6;
  const turns = (top - bottom) / pitch;
  const steps = plain ? 1 : Math.ceil(turns * rows);
  const height = (angle: number, z: number) => {
    if (plain) return radius - depth / 2;
    const run = Math.min((z - bottom) / pitch, (top - z) / pitch, 1);
    return radius - depth + depth * threadProfile((z - bottom) / pitch - angle / (2 * Math.PI)) * Math.max(run, 0);
  };
  const first = builder.vertexCount;
  const h = pitch * 1e-3;
  for (let i = 0; i <= steps; i++) {
    const z = i === steps ? top : bottom + ((top - bottom) * i) / steps;
    for (let j = 0; j < segments; j++) {
      const angle = (j / segments) * 2 * Math.PI;
      const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
      const r = height(angle, z);
      const dz = (height(angle, z + h) - height(angle, z - h)) / (2 * h);
      const da = (height(angle + h, z) - height(angle - h, z)) / (2 * h);
      // Gradient of ρ − r(φ, z) in cylindrical coordinates.
      builder.vertex(r * cos, r * sin, z, cos + (sin * da) / r, sin - (cos * da) / r, -dz);
    }
  }
  for (let i = 0; i < steps; i++) {
    for (let j = 0; j < segments; j++) {
      const k = (j + 1) % segments;
      builder.quad(
        first + i * segments + j,
        first + i * segments + k,
        first + (i + 1) * segments + k,
        first + (i + 1) * segments + j,
      );
    }
  }
  for (const [z, up] of [
    [bottom, -1],
    [top, 1],
  ] as const) {
    const rim = builder.vertexCount;
    for (let j = 0; j < segments; j++) {
      const angle = (j / segments) * 2 * Math.PI;
      const r = height(angle, z);
      builder.vertex(r * Math.cos(angle), r * Math.sin(angle), z, 0, 0, up);
    }
    for (let j = 1; j + 1 < segments; j++) {
      if (up > 0) builder.triangle(rim, rim + j, rim + j + 1);
      else builder.triangle(rim, rim + j + 1, rim + j);
    }
  }
}
