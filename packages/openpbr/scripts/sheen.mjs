/**
 * Fuzz from first principles, after Zeltner, Burley and Chiang 2022: a layer of fibres that stand on the surface, as a
 * volume of specular flakes with an SGGX distribution (Heitz et al. 2015) of the eigenvalues 1, 1 and α² squared, one
 * mean free path deep for light across the fibres, over black. Paths are followed through all their scatterings; what
 * comes out is described by its energy and by a linearly transformed cosine of two numbers, fitted by maximum
 * likelihood.
 */

/** PCG, O'Neill 2014. */
function uniform(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 747796405) + 2891336453) >>> 0;
    const word = Math.imul((state >>> ((state >>> 28) + 4)) ^ state, 277803737) >>> 0;
    return (((word >>> 22) ^ word) >>> 0) / 0x100000000;
  };
}

/** Directions that leave the layer, of `count` paths seen from the cosine `mu` in the xz plane; 3 numbers each. */
function leave(roughness, mu, count, next) {
  const sigma = roughness * roughness;
  const out = [];
  for (let i = 0; i < count; i++) {
    // The first cosine of depth is stratified.
    let first = (i + next()) / count;
    let [dx, dy, dz] = [-Math.sqrt(1 - mu * mu), 0, -mu];
    let z = 0;
    for (let bounce = 0; bounce < 500; bounce++) {
      const area = Math.sqrt(dx * dx + dy * dy + sigma * sigma * dz * dz);
      z += (dz * -Math.log(1 - first)) / area;
      first = next();
      if (z >= 0) {
        out.push(dx, dy, dz);
        break;
      }
      if (z <= -1) break;
      // A flake visible from the path: a point of the unit sphere seen along the stretched direction, stretched back.
      let [vx, vy, vz] = [-dx, -dy, -sigma * dz];
      const length = Math.hypot(vx, vy, vz);
      vx /= length;
      vy /= length;
      vz /= length;
      const r = Math.sqrt(next());
      const phi = 2 * Math.PI * next();
      const c = Math.sqrt(1 - r * r);
      const [px, py] = [r * Math.cos(phi), r * Math.sin(phi)];
      const side = vz >= 0 ? 1 : -1;
      const a = -1 / (side + vz);
      const b = vx * vy * a;
      let mx = px * (1 + side * vx * vx * a) + py * b + c * vx;
      let my = px * side * b + py * (side + vy * vy * a) + c * vy;
      let mz = sigma * (-px * side * vx - py * vy + c * vz);
      const scale = 1 / Math.hypot(mx, my, mz);
      mx *= scale;
      my *= scale;
      mz *= scale;
      const twice = 2 * (dx * mx + dy * my + dz * mz);
      dx -= twice * mx;
      dy -= twice * my;
      dz -= twice * mz;
    }
  }
  return out;
}

/** The linearly transformed cosine (x, y, z) → (a x + b z, a y, z) that makes the directions likeliest. */
function fit(directions, start) {
  // Paths come sorted by the depth of their first scattering: every so many-th, not the first ones.
  const count = Math.min(directions.length / 3, 6000);
  const total = directions.length / 3;
  const at = (i) => 3 * Math.floor((i * total) / count);
  if (count < 50) return start;
  const cost = (a, b) => {
    let sum = 0;
    for (let i = 0; i < count; i++) {
      const [x, y, z] = [directions[at(i)], directions[at(i) + 1], directions[at(i) + 2]];
      sum += Math.log((a * x + b * z) ** 2 + a * a * y * y + z * z);
    }
    return (2 * sum) / count - 2 * Math.log(a);
  };
  let [a, b] = start;
  let best = cost(a, b);
  // Pattern search: robust, and these are two numbers.
  for (let step = 0.1; step > 4e-4;) {
    let moved = false;
    for (const [da, db] of [
      [step, 0],
      [-step, 0],
      [0, step / 2],
      [0, -step / 2],
    ]) {
      const value = a + da > 0.01 ? cost(a + da, b + db) : Infinity;
      if (value < best) {
        [a, b, best, moved] = [a + da, b + db, value, true];
        break;
      }
    }
    if (!moved) step /= 2;
  }
  return [a, b];
}

/**
 * `columns` cosines from 0 to 1 by `rows` roughnesses from 0 to 1.
 * @returns {{ albedo: number[], stretch: number[], shear: number[] }} energy, a and -b, cosines fastest.
 */
export function sheen(columns, rows, paths) {
  const albedo = [],
    stretch = [],
    shear = [];
  for (let j = 0; j < rows; j++) {
    const roughness = Math.max(j / (rows - 1), 0.02);
    let numbers = [0.5, -0.05];
    for (let i = 0; i < columns; i++) {
      const mu = Math.min(Math.max(i / (columns - 1), 0.004), 0.9999);
      const directions = leave(roughness, mu, paths, uniform(1 + i + columns * j));
      numbers = fit(directions, numbers);
      albedo.push(directions.length / 3 / paths);
      stretch.push(numbers[0]);
      shear.push(Math.max(-numbers[1], 0));
    }
  }
  return { albedo, stretch, shear };
}
