/** The point that was found: xyz relative to the point asked about, and the weights of the second and third vertex. */
export type NearestPoint = Float64Array;

/** How many numbers make a {@link NearestPoint}. */
export const NEAREST_NUMBERS = 5;

/** Below this share of the product of the squared edges, the squared area of a triangle is mostly rounding. */
const THIN = 1e-9;

/**
 * The point of a triangle that is nearest to the origin, and its squared distance. Thin and degenerate triangles are
 * taken as the edges they are, too: whatever is found lies on the triangle.
 */
export function nearestOnTriangle(
  ax: number,
  ay: number,
  az: number,
  bx: number,
  by: number,
  bz: number,
  cx: number,
  cy: number,
  cz: number,
  out: NearestPoint,
): number {
  const ex = bx - ax,
    ey = by - ay,
    ez = bz - az,
    fx = cx - ax,
    fy = cy - ay,
    fz = cz - az;
  const ee = ex * ex + ey * ey + ez * ez,
    ff = fx * fx + fy * fy + fz * fz,
    ef = ex * fx + ey * fy + ez * fz;
  const ea = -(ex * ax + ey * ay + ez * az),
    fa = -(fx * ax + fy * ay + fz * az);
  const squaredArea = ee * ff - ef * ef;
  let best = Infinity;
  if (squaredArea > 0) {
    const u = (ff * ea - ef * fa) / squaredArea,
      v = (ee * fa - ef * ea) / squaredArea;
    if (u >= 0 && v >= 0 && u + v <= 1) {
      best = put(out, ax + u * ex + v * fx, ay + u * ey + v * fy, az + u * ez + v * fz, u, v);
      if (squaredArea > THIN * ee * ff) return best;
    }
  }
  // Onto the three edges: a + s e, a + s f, b + s (f − e).
  let s = share(ea, ee);
  let x = ax + s * ex,
    y = ay + s * ey,
    z = az + s * ez;
  if (x * x + y * y + z * z < best) best = put(out, x, y, z, s, 0);
  s = share(fa, ff);
  x = ax + s * fx;
  y = ay + s * fy;
  z = az + s * fz;
  if (x * x + y * y + z * z < best) best = put(out, x, y, z, 0, s);
  const gx = cx - bx,
    gy = cy - by,
    gz = cz - bz;
  s = share(-(gx * bx + gy * by + gz * bz), gx * gx + gy * gy + gz * gz);
  x = bx + s * gx;
  y = by + s * gy;
  z = bz + s * gz;
  if (x * x + y * y + z * z < best) best = put(out, x, y, z, 1 - s, s);
  return best;
}

/** How far along an edge, 0 to 1; 0 for an edge without length. */
const share = (along: number, squared: number): number => (squared > 0 ? Math.min(1, Math.max(0, along / squared)) : 0);

function put(out: NearestPoint, x: number, y: number, z: number, u: number, v: number): number {
  out[0] = x;
  out[1] = y;
  out[2] = z;
  out[3] = u;
  out[4] = v;
  return x * x + y * y + z * z;
}
