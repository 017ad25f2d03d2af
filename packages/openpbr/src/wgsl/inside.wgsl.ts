import { wgslModule } from '@glanz/wgsl';
import { openpbrEnergy } from './energy.wgsl';
import openpbrFresnelDielectric from './fresnel_dielectric.wesl';
import openpbrGgx from './ggx.wesl';
import openpbrSeen from './seen.wesl';

/**
 * `openpbr_inside(eta, alpha, wo)`: the parts of the light that a dielectric reflects and lets through by single
 * scattering, seen from its denser side, `eta` below 1. The reflectance has an edge at the critical angle, right
 * through the facets, which sums over all facets miss and tables blur.
 *
 * So what is summed is only the light that facets let through: downwards, 48 of them, and what of it they would have
 * mirrored upwards, another 48, which a perfect mirror's reflection is more by. That is tabulated, or where the
 * highlight is stretched a sum of 64. The slopes of facets that let light through lie within a conic, and so do those
 * that mirror upwards: with the angle ψ to the normal in the plane of the view, and χ out of it, its bounds are roots
 * of quadratics, the middles of both conics' χ are the same, and within both nothing jumps. Steps of the golden ratio,
 * closer at the bounds.
 *
 * Tried, largest error (and in the mean square): stretched, 300 interfaces of indices 1.1 to 2.5, roughness 0.05 to 1,
 * anisotropy 0.2 to 0.9: 64 facets of the cap 0.027 (0.007), with means over their surroundings 0.019 (0.005), 1024
 * facets 0.003; facets within the conic of those that pass, 8 × 8 by Gauss and Legendre 0.016, 96 as here 0.0024
 * (0.0004). Within both conics 0.0020 (0.0003), 400 interfaces of indices from 1.001 on. Round, 2500 interfaces of
 * indices 1.001 to 3.3: not within both conics 48 facets 0.019 (0.0029), 96 0.0074 (0.0017); as here, 24 0.0042, 32
 * 0.0029, 48 0.0012 (0.0003), 64 0.0010 (0.0002). Tables at coordinates that follow the critical angle and the
 * roughness 0.019 to index 1.02, 0.03 beyond.
 */
export const openpbrInside = wgslModule(
  'openpbr/inside',
  /* wgsl */ `//#if OPENPBR_INNER
// Facets are cos χ (sin ψ p + cos ψ z) + sin χ q; "across" is what of p is not along q, and q, both squared; "length" that of
// the view's slope along p, and its cosine. A conic holds the facets a with a² ≤ (a·wo)(a·axis), axis along p and z.

// Of those, sin (ψ - ψ of the view), which is even among the facets that are seen, at either end.
fn openpbr_inside_range(axis: vec2f, length: vec2f, view: vec2f, across: vec2f) -> vec2f {
  let a = length.x * axis.x - across.x;
  let b = 0.5 * (length.x * axis.y + length.y * axis.x);
  let c = length.y * axis.y - 1.0;
  let discriminant = b * b - a * c;
  if (discriminant <= 0.0) { return vec2f(1.0, -1.0); }
  let root = b + select(-1.0, 1.0, b >= 0.0) * sqrt(discriminant);
  // At the critical angle a is 0, and the conic open at one end.
  let slopes = clamp(vec2f(-root / select(a, max(a, 1e-30), a >= 0.0), -c / root), vec2f(-1e15), vec2f(1e15));
  let most = max(slopes.x, slopes.y);
  let ends = vec2f(select(min(slopes.x, slopes.y), most, a >= 0.0), most);
  let places = (ends * view.y - view.x) * inverseSqrt(ends * ends + 1.0);
  return vec2f(places.x, select(places.y, view.y, a >= 0.0));
}

// tan² χ at the conic's bounds, from its middle.
fn openpbr_inside_reach(axis: vec2f, length: vec2f, across: vec2f, psi: vec2f) -> f32 {
  return (dot(psi, length) * dot(psi, axis) - across.x * psi.x * psi.x - psi.y * psi.y) / across.y;
}

fn openpbr_inside(eta: f32, alpha: vec2f, given: vec3f) -> vec2f {
  let wo = vec3f(given.xy, max(given.z, 1e-5));
  // Directions are bent by a least step of the index (see openpbr_transmission_prepare).
  let bend = select(eta, 1.0010005, eta > 0.9990005);
  let towards = openpbr_ggx_azimuth(alpha, wo);
  let slope = vec2f(length(alpha * wo.xy), wo.z);
  // Where facets are stretched to a round highlight the view has this sine and cosine.
  let view = slope / length(slope);
  let p = alpha * towards;
  let q = alpha * vec2f(-towards.y, towards.x);
  let square = dot(q, q);
  let skew = dot(p, q) / square;
  let across = vec2f(alpha.x * alpha.y * (alpha.x * alpha.y / square), square);
  let upwards = vec2f(0.0, 2.0 / wo.z);
  let passing = slope / ((1.0 - eta) * (1.0 + eta));
  let range_up = openpbr_inside_range(upwards, slope, view, across);
  let range_passing = openpbr_inside_range(passing, slope, view, across);
  let range_both = vec2f(max(range_up.x, range_passing.x), min(range_up.y, range_passing.y));
  var kept = vec2f(0.0);
  var first = 64u;
  //#if OPENPBR_ANISOTROPY
  first = select(64u, 0u, alpha.x > alpha.y);
  //#endif
  if (first > 0u) { kept.x = 1.0 - openpbr_energy_lost(sqrt(alpha.x), wo.z); }
  // What mirrors reflect; what is let through; what of that mirrors would have reflected.
  for (var i = first; i < 160u; i++) {
    let mirrors = i < 64u;
    let down = i >= 64u && i < 112u;
    let count = select(48.0, 64.0, mirrors);
    let k = f32(select(select(i - 112u, i - 64u, down), i, mirrors)) + 0.5;
    let range = select(select(range_both, range_passing, down), range_up, mirrors);
    if (range.x >= range.y) { continue; }
    let u = k / count;
    let v = fract((k - 0.5) * 0.618034 + 0.5);
    let s = range.x + (range.y - range.x) * u * u * (3.0 - 2.0 * u);
    let rest = sqrt(max(1.0 - s * s, 0.0));
    let psi = vec2f(s * view.y + rest * view.x, max(rest * view.y - s * view.x, 0.0));
    let reach = vec2f(openpbr_inside_reach(passing, slope, across, psi), openpbr_inside_reach(upwards, slope, across, psi));
    let width = sqrt(max(select(select(min(reach.x, reach.y), reach.x, down), reach.y, mirrors), 0.0));
    let tangents = vec2f(-width, width) - skew * psi.x;
    let bounds = tangents * inverseSqrt(tangents * tangents + 1.0);
    let out = bounds.x + (bounds.y - bounds.x) * v * v * (3.0 - 2.0 * v);
    let along = sqrt(max(1.0 - out * out, 0.0));
    let h = normalize(vec3f(along * psi.x * p + out * q, along * psi.y));
    let weight = 22.918312 * (range.y - range.x) / (1.0 + view.y) * (bounds.y - bounds.x) * along * u * (1.0 - u) * v * (1.0 - v) / count;
    let seen = openpbr_facet_seen(bend, alpha, wo, h);
    let passes = weight * (1.0 - openpbr_fresnel_dielectric(eta, clamp(dot(wo, h), 0.0, 1.0)));
    kept += select(select(vec2f(-passes * seen.x, 0.0), vec2f(0.0, passes * seen.y), down), vec2f(weight * seen.x, 0.0), mirrors);
  }
  return max(kept, vec2f(0.0));
}
//#endif`,
  [openpbrGgx, openpbrFresnelDielectric, openpbrEnergy, openpbrSeen],
);
