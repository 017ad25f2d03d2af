import { arcSegments, isNegligible, type Tessellation } from './tessellation';

/** A corner of a polygon, with the radius that rounds it off (0 or absent: sharp). Millimetres. */
export interface Corner {
  readonly x: number;
  readonly y: number;
  readonly r?: number;
}

/** A point of a finished outline. */
export interface OutlinePoint {
  readonly x: number;
  readonly y: number;
  /** Unit normal, to the right of the direction of travel: outwards of a counter-clockwise loop. */
  readonly nx: number;
  readonly ny: number;
  /** Where the point goes per millimetre of outward offset: the normal, lengthened at sharp corners (a mitre). */
  readonly mx: number;
  readonly my: number;
}

/** A chain of points; consecutive points of equal place but unequal normals are a sharp edge. */
export type Outline = readonly OutlinePoint[];

const point = (x: number, y: number, nx: number, ny: number, mx = nx, my = ny): OutlinePoint => ({
  x,
  y,
  nx,
  ny,
  mx,
  my,
});

interface Direction {
  readonly x: number;
  readonly y: number;
  readonly length: number;
}

function direction(a: Corner, b: Corner): Direction {
  const x = b.x - a.x;
  const y = b.y - a.y;
  const length = Math.hypot(x, y);
  if (length === 0) throw new RangeError(`outline: two corners in one place, (${a.x}, ${a.y})`);
  return { x: x / length, y: y / length, length };
}

function corner(c: Corner, before: Direction, after: Direction, tessellation: Tessellation, out: OutlinePoint[]): void {
  const cross = before.x * after.y - before.y * after.x;
  const dot = before.x * after.x + before.y * after.y;
  const turn = Math.atan2(cross, dot);
  if (Math.abs(turn) < 1e-9) {
    out.push(point(c.x, c.y, before.y, -before.x));
    return;
  }
  const n0 = { x: before.y, y: -before.x };
  const n1 = { x: after.y, y: -after.x };
  const r = c.r ?? 0;
  if (isNegligible(r, tessellation)) {
    const scale = 1 / (1 + dot);
    const mx = (n0.x + n1.x) * scale;
    const my = (n0.y + n1.y) * scale;
    out.push(point(c.x, c.y, n0.x, n0.y, mx, my), point(c.x, c.y, n1.x, n1.y, mx, my));
    return;
  }
  const tangent = r * Math.tan(Math.abs(turn) / 2);
  const side = Math.sign(turn);
  // The centre lies to the left of a left turn, at the end of the normal's opposite.
  const start = { x: c.x - before.x * tangent, y: c.y - before.y * tangent };
  const centre = { x: start.x - side * n0.x * r, y: start.y - side * n0.y * r };
  const steps = arcSegments(r, turn, tessellation);
  for (let i = 0; i <= steps; i++) {
    const angle = (turn * i) / steps;
    const cos = Math.cos(angle);
    const sin = Math.sin(angle);
    const nx = n0.x * cos - n0.y * sin;
    const ny = n0.x * sin + n0.y * cos;
    out.push(point(centre.x + side * nx * r, centre.y + side * ny * r, nx, ny));
  }
}

/** How much of the two edges at a corner its rounding takes up. */
function tangentLength(before: Direction, after: Direction, r = 0): number {
  return (
    r *
    Math.tan(Math.abs(Math.atan2(before.x * after.y - before.y * after.x, before.x * after.x + before.y * after.y)) / 2)
  );
}

/** Refuses roundings that overlap: the outline would run backwards between them. */
function checkRadii(corners: readonly Corner[], closed: boolean): void {
  const n = corners.length;
  const taken = corners.map((c, i) => {
    if (!closed && (i === 0 || i === n - 1)) return 0;
    return tangentLength(direction(corners[(i + n - 1) % n]!, c), direction(c, corners[(i + 1) % n]!), c.r);
  });
  for (let i = 0; i < (closed ? n : n - 1); i++) {
    const [c, next] = [corners[i]!, corners[(i + 1) % n]!];
    const { length } = direction(c, next);
    if (taken[i]! + taken[(i + 1) % n]! > length + 1e-9)
      throw new RangeError(`outline: the radii at (${c.x}, ${c.y}) and (${next.x}, ${next.y}) do not fit between them`);
  }
}

function tidy(points: OutlinePoint[], closed: boolean): OutlinePoint[] {
  const same = (a: OutlinePoint, b: OutlinePoint) => Math.hypot(a.x - b.x, a.y - b.y) < 1e-7;
  const result: OutlinePoint[] = [];
  for (const p of points) {
    const last = result[result.length - 1];
    if (last && same(last, p)) {
      if (Math.hypot(last.nx - p.nx, last.ny - p.ny) < 1e-6) continue;
      // Two points of one sharp corner must agree to the last bit.
      result.push({ ...p, x: last.x, y: last.y });
    } else result.push(p);
  }
  const [first, last] = [result[0]!, result[result.length - 1]!];
  if (closed && result.length > 1 && same(first, last)) {
    if (Math.hypot(first.nx - last.nx, first.ny - last.ny) < 1e-6) result.pop();
    else result[result.length - 1] = { ...last, x: first.x, y: first.y };
  }
  return result;
}

/**
 * Rounds off a closed polygon.
 *
 * @param corners Counter-clockwise around material, clockwise around a hole in it.
 * @throws {RangeError} when a radius does not fit between its neighbours.
 */
export function closedOutline(corners: readonly Corner[], tessellation: Tessellation): Outline {
  checkRadii(corners, true);
  const n = corners.length;
  const out: OutlinePoint[] = [];
  for (let i = 0; i < n; i++) {
    const c = corners[i]!;
    corner(c, direction(corners[(i + n - 1) % n]!, c), direction(c, corners[(i + 1) % n]!), tessellation, out);
  }
  return tidy(out, true);
}

/**
 * Rounds off an open chain of corners, e.g. a profile to revolve that begins and ends on the axis. @throws {RangeError}
 * as {@link closedOutline}
 */
export function openOutline(corners: readonly Corner[], tessellation: Tessellation): Outline {
  checkRadii(corners, false);
  const out: OutlinePoint[] = [];
  for (const [i, c] of corners.entries()) {
    const before = i > 0 ? direction(corners[i - 1]!, c) : undefined;
    const after = i + 1 < corners.length ? direction(c, corners[i + 1]!) : undefined;
    if (before && after) corner(c, before, after, tessellation, out);
    else {
      const d = (before ?? after) as Direction;
      out.push(point(c.x, c.y, d.y, -d.x));
    }
  }
  return tidy(out, false);
}

/** A circle; `hole` turns it around. */
export function circleOutline(x: number, y: number, radius: number, segments: number, hole = false): Outline {
  const result: OutlinePoint[] = [];
  for (let i = 0; i < segments; i++) {
    const angle = ((hole ? -i : i) / segments) * 2 * Math.PI;
    const cos = Math.cos(angle);
    const sin = Math.sin(angle);
    const sign = hole ? -1 : 1;
    result.push(point(x + radius * cos, y + radius * sin, sign * cos, sign * sin));
  }
  return result;
}

/** Corners of a rectangle around (x, y), counter-clockwise, all rounded alike. */
export function rectangle(x: number, y: number, width: number, height: number, r = 0): Corner[] {
  const [w, h] = [width / 2, height / 2];
  return [
    { x: x - w, y: y - h, r },
    { x: x + w, y: y - h, r },
    { x: x + w, y: y + h, r },
    { x: x - w, y: y + h, r },
  ];
}
