import { gated, wgslModule } from '@glanz/wgsl';
import openpbrFresnelDielectric from './fresnel_dielectric.wesl';
import openpbrGgx from './ggx.wesl';
import { openpbrInside } from './inside.wgsl';
import openpbrSeen from './seen.wesl';
import { STRETCHED_AROUND, STRETCHED_HEIGHTS, STRETCHED_MIRRORS } from '../tables/layout';

const count = STRETCHED_MIRRORS + STRETCHED_AROUND * STRETCHED_HEIGHTS.length;
const heights = STRETCHED_HEIGHTS.map(([height, weight]) => `vec2f(${height}, ${weight / STRETCHED_AROUND})`).join(
  ', ',
);

/**
 * `openpbr_stretched(eta, alpha, wo)`: the parts of the light that a dielectric with a stretched highlight reflects and
 * lets through by single scattering, seen from `wo`. The energy tables know round highlights only; this is a sum over
 * facets as they are seen. From inside see `openpbr_inside`. From outside what is reflected has an edge, where facets
 * mirror
 * downwards: 32 facets within the conic of those that mirror upwards, as there. What passes goes down everywhere and
 * vanishes at the cap's rim: 4 heights of the whole cap, ten around each, turned by what is left of the golden ratio.
 *
 * Tried from outside, largest error of what is kept (and in the mean square), and of what is reflected, over 590
 * interfaces of indices 1.1 to 2.5, roughness 0.05 to 1, anisotropy 0.2 to 0.99, many of them low and across the long
 * slopes: 64 facets of the cap at steps of the golden ratio, closer at its ends, 0.0061 (0.0011) and 0.0065. As here
 * 0.0016 (0.0005) and 0.0015; with 24 within the conic 0.003, with 48 0.0007 of what is reflected; what passes over 64
 * in golden steps no better than as here, over 4 by 8 0.0043.
 */
export const openpbrStretched = wgslModule(
  'openpbr/stretched',
  /* wgsl */ `fn openpbr_stretched(eta: f32, alpha: vec2f, given: vec3f) -> vec2f {
  //#if OPENPBR_INNER
  if (eta < 1.0) { return openpbr_inside(eta, alpha, given); }
  //#endif
  let wo = vec3f(given.xy, max(given.z, 1e-5));
  let towards = openpbr_ggx_azimuth(alpha, wo);
  // As in openpbr_inside, of the one conic with its axis upright.
  let slope = vec2f(length(alpha * wo.xy), wo.z);
  let view = slope / length(slope);
  let p = alpha * towards;
  let q = alpha * vec2f(-towards.y, towards.x);
  let square = dot(q, q);
  let skew = dot(p, q) / square;
  let least = alpha.x * alpha.y * (alpha.x * alpha.y / square);
  let lean = 2.0 * slope.x / wo.z;
  let root = 0.5 * lean + sqrt(0.25 * lean * lean + least);
  let ends = vec2f(-1.0 / root, root / least);
  let range = (ends * view.y - view.x) * inverseSqrt(ends * ends + 1.0);
  var heights = array<vec2f, ${STRETCHED_HEIGHTS.length}>(${heights});
  var kept = vec2f(0.0);
  for (var i = 0u; i < ${count}u; i++) {
    let mirrors = i < ${STRETCHED_MIRRORS}u;
    var h: vec3f;
    var weight: f32;
    if (mirrors) {
      let u = (f32(i) + 0.5) * ${1 / STRETCHED_MIRRORS};
      let v = fract(f32(i) * 0.618034 + 0.5);
      let s = range.x + (range.y - range.x) * u * u * (3.0 - 2.0 * u);
      let rest = sqrt(max(1.0 - s * s, 0.0));
      let psi = vec2f(s * view.y + rest * view.x, max(rest * view.y - s * view.x, 0.0));
      let width = sqrt(max(psi.y * (lean * psi.x + psi.y) - least * psi.x * psi.x, 0.0) / square);
      let tangents = vec2f(-width, width) - skew * psi.x;
      let bounds = tangents * inverseSqrt(tangents * tangents + 1.0);
      let out = bounds.x + (bounds.y - bounds.x) * v * v * (3.0 - 2.0 * v);
      let along = sqrt(max(1.0 - out * out, 0.0));
      h = normalize(vec3f(along * psi.x * p + out * q, along * psi.y));
      weight = ${22.918312 / STRETCHED_MIRRORS} * (range.y - range.x) / (1.0 + view.y) * (bounds.y - bounds.x) * along * u * (1.0 - u) * v * (1.0 - v);
    } else {
      let k = (i - ${STRETCHED_MIRRORS}u) / ${STRETCHED_AROUND}u;
      let place = openpbr_circle(fract(f32(i - ${STRETCHED_MIRRORS}u - ${STRETCHED_AROUND}u * k) * ${1 / STRETCHED_AROUND} + f32(k) * ${0.382 / STRETCHED_AROUND}));
      h = openpbr_ggx_cap(alpha, wo, vec2f(towards.x * place.x - towards.y * place.y, towards.x * place.y + towards.y * place.x), heights[k].x, 1.0);
      weight = heights[k].y;
    }
    let seen = openpbr_facet_seen(eta, alpha, wo, h);
    let reflectance = openpbr_fresnel_dielectric(eta, clamp(dot(wo, h), 0.0, 1.0));
    kept += weight * select(vec2f(0.0, (1.0 - reflectance) * seen.y), vec2f(reflectance * seen.x, 0.0), mirrors);
  }
  return kept;
}`,
  [openpbrGgx, openpbrFresnelDielectric, openpbrSeen, gated('OPENPBR_INNER', openpbrInside)],
);
