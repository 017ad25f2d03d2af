/**
 * Directional albedo of a GGX interface by deterministic quadrature, double precision: what scripts/tables.mjs
 * tabulates. Half vectors follow the distribution of visible normals (spherical caps, Dupuy and Benyoub 2023), with
 * Gauss-Legendre nodes along the cap's axis and the midpoint rule around it; masking and shadowing are
 * height-correlated Smith for reflection, separable for refraction (Heitz 2014: a facet that is seen well from above is
 * high up, and hard to see from below; the separable form lies nearer to that than the correlated one). Single
 * scattering; radiance is not scaled by the index of refraction.
 */

/**
 * Exact unpolarised reflectance of a dielectric interface; `eta` = n_t / n_i, `c` = cosine of the angle of incidence.
 */
export function fresnelDielectric(eta, c) {
  const g2 = eta * eta - 1 + c * c;
  if (g2 <= 0) return 1;
  const g = Math.sqrt(g2);
  if (g + c === 0) return 1;
  const a = (g - c) / (g + c);
  const b = (c * (g + c) - 1) / (c * (g - c) + 1);
  return 0.5 * a * a * (1 + b * b);
}

/** Gauss-Legendre nodes and weights on [0, 1]. */
export function gaussLegendre(count) {
  const nodes = new Float64Array(count);
  const weights = new Float64Array(count);
  for (let i = 0; i < count; i++) {
    let x = Math.cos((Math.PI * (i + 0.75)) / (count + 0.5));
    let derivative = 0;
    for (let step = 0; step < 50; step++) {
      let p0 = 1;
      let p1 = x;
      for (let j = 2; j <= count; j++) [p0, p1] = [p1, ((2 * j - 1) * x * p1 - (j - 1) * p0) / j];
      derivative = (count * (x * p1 - p0)) / (x * x - 1);
      const delta = p1 / derivative;
      x -= delta;
      if (Math.abs(delta) < 1e-15) break;
    }
    nodes[i] = (1 - x) / 2;
    weights[i] = 1 / ((1 - x * x) * derivative * derivative);
  }
  return { nodes, weights };
}

/**
 * A quadrature of `rings` × `spokes` half vectors.
 * @returns {(alpha: [number, number], eta: number, mu: number, phi?: number) => { reflect: number, transmit: number,
 *   mirror: number }} energy reflected and refracted by a dielectric of relative index `eta`, and reflected by a
 *   perfect conductor, seen from the direction with cosine `mu` and azimuth `phi`.
 */
export function interfaceAlbedo(rings, spokes) {
  const { nodes, weights } = gaussLegendre(rings);
  const cos = Float64Array.from({ length: spokes }, (_, i) => Math.cos((2 * Math.PI * (i + 0.5)) / spokes));
  const sin = Float64Array.from({ length: spokes }, (_, i) => Math.sin((2 * Math.PI * (i + 0.5)) / spokes));
  return ([ax, ay], eta, mu, phi = 0) => {
    // With one slope for all azimuths and the view in the xz plane both half circles are alike.
    const symmetric = ax === ay && phi === 0;
    const used = symmetric ? spokes / 2 : spokes;
    const sinO = Math.sqrt(Math.max(0, 1 - mu * mu));
    const ox = sinO * Math.cos(phi);
    const oy = sinO * Math.sin(phi);
    const stretched = Math.hypot(ax * ox, ay * oy, mu);
    const vx = (ax * ox) / stretched;
    const vy = (ay * oy) / stretched;
    const vz = mu / stretched;
    const lambda = (x, y, z) => 0.5 * (Math.sqrt(1 + (ax * ax * x * x + ay * ay * y * y) / (z * z)) - 1);
    const lambdaO = lambda(ox, oy, mu);
    let reflect = 0;
    let transmit = 0;
    let mirror = 0;
    for (let k = 0; k < rings; k++) {
      const z = (1 - nodes[k]) * (1 + vz) - vz;
      const radius = Math.sqrt(Math.max(0, 1 - z * z));
      const weight = weights[k] / used;
      for (let i = 0; i < used; i++) {
        let hx = ax * (radius * cos[i] + vx);
        let hy = ay * (radius * sin[i] + vy);
        let hz = z + vz;
        const length = Math.sqrt(hx * hx + hy * hy + hz * hz);
        hx /= length;
        hy /= length;
        hz /= length;
        const oh = ox * hx + oy * hy + mu * hz;
        if (!(oh > 0)) continue;
        const fresnel = fresnelDielectric(eta, oh);
        const iz = 2 * oh * hz - mu;
        if (iz > 0) {
          const shadowing = (weight * (1 + lambdaO)) / (1 + lambdaO + lambda(2 * oh * hx - ox, 2 * oh * hy - oy, iz));
          mirror += shadowing;
          reflect += fresnel * shadowing;
        }
        const cosT2 = 1 - (1 - oh * oh) / (eta * eta);
        if (cosT2 <= 0) continue;
        const along = oh / eta - Math.sqrt(cosT2);
        const tz = along * hz - mu / eta;
        if (tz < 0)
          transmit += ((1 - fresnel) * weight) / (1 + lambda(along * hx - ox / eta, along * hy - oy / eta, tz));
      }
    }
    return { reflect, transmit, mirror };
  };
}
