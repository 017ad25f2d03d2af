import type { MeshBuilder } from './mesh-builder';
import type { Outline } from './outline';

/**
 * Turns a profile around the z axis. In the profile x is the radius and y the height; the material lies to the left of
 * the direction of travel.
 *
 * @param closed Whether the profile is a loop off the axis (a ring), or begins and ends on the axis (a solid).
 */
export function revolve(builder: MeshBuilder, profile: Outline, segments: number, closed: boolean): void {
  const first = builder.vertexCount;
  const cos: number[] = [];
  const sin: number[] = [];
  for (let j = 0; j < segments; j++) {
    cos.push(Math.cos((j / segments) * 2 * Math.PI));
    sin.push(Math.sin((j / segments) * 2 * Math.PI));
  }
  for (const p of profile) {
    const radius = Math.abs(p.x) < 1e-9 ? 0 : p.x;
    for (let j = 0; j < segments; j++)
      builder.vertex(radius * cos[j]!, radius * sin[j]!, p.y, p.nx * cos[j]!, p.nx * sin[j]!, p.ny);
  }
  const n = profile.length;
  for (let i = 0; i < (closed ? n : n - 1); i++) {
    const next = (i + 1) % n;
    const [p, q] = [profile[i]!, profile[next]!];
    if (p.x === q.x && p.y === q.y) continue;
    for (let j = 0; j < segments; j++) {
      const k = (j + 1) % segments;
      const [a, b, c, d] = [
        first + i * segments + j,
        first + i * segments + k,
        first + next * segments + k,
        first + next * segments + j,
      ];
      // Going along the profile the outside is on the right: a → b → c is counter-clockwise seen from there.
      if (Math.abs(p.x) < 1e-9) builder.triangle(a, c, d);
      else if (Math.abs(q.x) < 1e-9) builder.triangle(a, b, c);
      else builder.quad(a, b, c, d);
    }
  }
}
