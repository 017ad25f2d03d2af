import { wgslModule } from '@glanz/wgsl';
import { openpbrFresnelDielectric } from './fresnel.wgsl';
import { openpbrGgx } from './ggx.wgsl';

/**
 * `openpbr_stretched(eta, alpha, wo)`: the parts of the light that a dielectric with a stretched highlight reflects and
 * lets through by single scattering, seen from `wo`. The energy tables know round highlights only; this is a sum over
 * facets as they are seen. From outside over 64, on the cap of visible normals at steps of the golden ratio, closer at the
 * cap's ends.
 *
 * From inside the reflectance jumps at the critical angle, right through the facets. So the sum is of what facets mirror
 * upwards, 64 of them, and of what 96 facets that let light through change of that. The slopes of each kind lie within a
 * conic: with the angle ψ to the normal in the plane of the view, and χ out of it, its bounds are roots of quadratics, and
 * nothing jumps inside of them. Steps of the golden ratio again, closer at the bounds.
 *
 * Tried, largest error (and in the mean square) over 300 interfaces of indices 1.1 to 2.5, roughness 0.05 to 1, anisotropy
 * 0.2 to 0.9: from outside 64 facets by Gauss and Legendre 0.011; as here 0.0028 (0.0009); from inside 64 facets of the cap
 * 0.027 (0.007), with means over their surroundings 0.019 (0.005), 1024 facets 0.003; within the conics, 8 × 8 by Gauss and
 * Legendre twice 0.016, 64 and 64 as here 0.006, 64 and 96 0.0024 (0.0004).
 */
export const openpbrStretched = wgslModule(
  'openpbr/stretched',
  /* wgsl */ `// What a facet mirrors to where it is seen, and what it refracts to there; and the part of the light that it reflects.
fn openpbr_stretched_seen(eta: f32, alpha: vec2f, wo: vec3f, h: vec3f) -> vec3f {
  let c = clamp(dot(wo, h), 0.0, 1.0);
  let so = openpbr_ggx_stretch(alpha, wo);
  let mirrored = 2.0 * c * h - wo;
  let refracted = (c / eta - sqrt(max(1.0 - (1.0 - c * c) / (eta * eta), 1e-6))) * h - wo / eta;
  let up = select(0.0, mirrored.z * (wo.z + so) / (wo.z * openpbr_ggx_stretch(alpha, mirrored) + mirrored.z * so), mirrored.z > 0.0);
  let down = select(0.0, 2.0 * refracted.z / (refracted.z - openpbr_ggx_stretch(alpha, refracted)), refracted.z < 0.0);
  return vec3f(up, down, openpbr_fresnel_dielectric(eta, c));
}

//#if OPENPBR_INNER
fn openpbr_stretched_inside(eta: f32, alpha: vec2f, wo: vec3f) -> vec2f {
  let towards = openpbr_ggx_azimuth(alpha, wo);
  // Where facets are stretched to a round highlight the view has this sine and cosine.
  let slope = length(alpha * wo.xy);
  let view = vec2f(slope, wo.z) / length(vec2f(slope, wo.z));
  // Facets are cos χ (sin ψ p + cos ψ z) + sin χ q; of p, what is not along q is "least" long, squared.
  let p = alpha * towards;
  let q = alpha * vec2f(-towards.y, towards.x);
  let square = dot(q, q);
  let skew = dot(p, q) / square;
  let least = alpha.x * alpha.y * (alpha.x * alpha.y / square);
  var kept = vec2f(0.0);
  for (var i = 0u; i < 160u; i++) {
    // Facets a with a² ≤ (a·wo) (a·axis): those that mirror upwards, then those that let light through.
    let mirrors = i < 64u;
    let count = select(96.0, 64.0, mirrors);
    let k = f32(select(i - 64u, i, mirrors));
    let axis = select(vec2f(slope, wo.z) / (1.0 - eta * eta), vec2f(0.0, 2.0 / wo.z), mirrors);
    let a = slope * axis.x - least;
    let b = 0.5 * (slope * axis.y + wo.z * axis.x);
    let c = wo.z * axis.y - 1.0;
    let discriminant = b * b - a * c;
    if (discriminant <= 0.0) { continue; }
    let root = b + select(-1.0, 1.0, b >= 0.0) * sqrt(discriminant);
    let slopes = clamp(vec2f(-root / a, -c / root), vec2f(-1e15), vec2f(1e15));
    let most = max(slopes.x, slopes.y);
    let ends = vec2f(select(min(slopes.x, slopes.y), most, a > 0.0), most);
    // sin (ψ - ψ of the view), which is even among the facets that are seen.
    let places = (ends * view.y - view.x) * inverseSqrt(ends * ends + 1.0);
    let first = places.x;
    let last = select(places.y, view.y, a > 0.0);
    let u = (k + 0.5) / count;
    let v = fract(k * 0.618034 + 0.5);
    let s = first + (last - first) * u * u * (3.0 - 2.0 * u);
    let rest = sqrt(max(1.0 - s * s, 0.0));
    let psi = vec2f(s * view.y + rest * view.x, max(rest * view.y - s * view.x, 0.0));
    let width = sqrt(max((psi.x * slope + psi.y * wo.z) * dot(psi, axis) - least * psi.x * psi.x - psi.y * psi.y, 0.0) / square);
    let tangents = vec2f(-width, width) - skew * psi.x;
    let bounds = tangents * inverseSqrt(tangents * tangents + 1.0);
    let out = bounds.x + (bounds.y - bounds.x) * v * v * (3.0 - 2.0 * v);
    let along = sqrt(max(1.0 - out * out, 0.0));
    let h = normalize(vec3f(along * psi.x * p + out * q, along * psi.y));
    let weight = 22.918312 * (last - first) / (1.0 + view.y) * (bounds.y - bounds.x) * along * u * (1.0 - u) * v * (1.0 - v) / count;
    let seen = openpbr_stretched_seen(eta, alpha, wo, h);
    kept += weight * select((1.0 - seen.z) * vec2f(-seen.x, seen.y), vec2f(seen.x, 0.0), mirrors);
  }
  return max(kept, vec2f(0.0));
}
//#endif

fn openpbr_stretched(eta: f32, alpha: vec2f, wo: vec3f) -> vec2f {
  //#if OPENPBR_INNER
  if (eta < 1.0) { return openpbr_stretched_inside(eta, alpha, wo); }
  //#endif
  let azimuth = openpbr_ggx_azimuth(alpha, wo);
  var kept = vec2f(0.0);
  for (var i = 0u; i < 64u; i++) {
    let at = (f32(i) + 0.5) * 0.015625;
    let place = openpbr_circle(fract(f32(i) * 0.618034));
    let u = clamp(at, 0.002, 0.998);
    let h = openpbr_ggx_cap(alpha, wo, vec2f(azimuth.x * place.x - azimuth.y * place.y, azimuth.x * place.y + azimuth.y * place.x), u * u * (3.0 - 2.0 * u), 1.0);
    let seen = openpbr_stretched_seen(eta, alpha, wo, h);
    kept += vec2f(seen.z * seen.x, (1.0 - seen.z) * seen.y) * (0.09375 * at * (1.0 - at));
  }
  return kept;
}`,
  [openpbrGgx, openpbrFresnelDielectric],
);
