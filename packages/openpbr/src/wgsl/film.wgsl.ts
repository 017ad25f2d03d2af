import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { FILM_BANDS, type FilmBands } from '../tables/film';
import { openpbrDielectric } from './dielectric.wgsl';
import openpbrFresnelDielectric from './fresnel_dielectric.wesl';
import openpbrGgx from './ggx.wesl';
import { openPbrStruct } from './record';

/**
 * A thin film on the base, below the coat. Waves reflected by its two faces interfere; Airy's sum, with all its orders
 * and unpolarised, takes the place of the Fresnel factor, by the coverage. Below it lies the dielectric, or metal of a
 * complex index by its reflectance and edge tint (Gulbrandsen 2014).
 *
 * For a band of Lorentzian shape over wavenumbers the spectrum's integral is Airy's sum with a reflection that fades
 * with the path, in closed form: eight such bands stand for the visible spectrum, and give red, green and blue
 * (`FILM_BANDS`), with no aliasing however thick the film. From inside, light beyond the critical angle is reflected
 * whatever the film.
 */
export const openpbrFilm = /* @__PURE__ */ filmModule(FILM_BANDS);

function filmModule({ wavenumbers, width, weights }: FilmBands): WgslModule {
  const bands = (first: number): string =>
    wavenumbers
      .slice(first, first + 4)
      .map((wavenumber) => `${256 * wavenumber}u`)
      .join(', ');
  const columns = (first: number): string =>
    [0, 1, 2, 3].map((i) => `vec3f(${weights.map((row) => row[first + i]).join(', ')})`).join(', ');
  return wgslModule(
    'openpbr/film',
    /* wgsl */ `struct OpenPbrFilm {
  // Coverage.
  weight: f32,
  // Indices of the film and of what lies on it, over that of what is outside of the object.
  index: f32,
  outer: f32,
  // Complex ones of what lies below: those of metal for red, green and blue, and that of the dielectric.
  n: vec4f,
  k: vec4f,
  // The first of these bases that there is, and one more than the last.
  bases: vec2u,
  // Optical path through the film and back, in µm, over the part of the wave's vector across it.
  path: f32,
  // Square of the part of the wave's vector along the surface at grazing angles: outside, and on the viewer's side.
  grazing: f32,
  viewer: f32,
  //#if OPENPBR_DIELECTRIC
  // Factor on what lies below the interface.
  passed: vec3f,
  //#endif
}

// Indices of p are relative to what is outside, whose own is outer_ior.
fn openpbr_film_prepare(p: OpenPbrParameters, outer_ior: f32, inside: bool) -> OpenPbrFilm {
  var film: OpenPbrFilm;
  // Too thin to be seen: it fades, and metal below it goes back to the tint that it has without.
  film.weight = p.thin_film_weight * min(p.thin_film_thickness * 100.0, 1.0);
  film.index = p.thin_film_ior / outer_ior;
  film.outer = 1.0;
  //#if OPENPBR_COAT
  film.outer = mix(1.0, p.coat_ior, p.coat_weight);
  //#endif
  film.path = 2.0 * p.thin_film_thickness * outer_ior;
  // The film shall not reflect all light because the coat is denser: such light does not come in through the coat.
  film.grazing = min(film.outer, film.index) * min(film.outer, film.index);
  film.viewer = film.grazing;
  //#if OPENPBR_DIELECTRIC
  var below = p;
  below.specular_ior = p.specular_ior / film.outer;
  let epsilon = openpbr_dielectric_epsilon(below);
  film.n.w = film.outer * (1.0 + epsilon) / (1.0 - epsilon);
  if (inside) { film.viewer = film.n.w * film.n.w; }
  //#endif
  film.bases = vec2u(3u, 4u);
  //#if OPENPBR_METAL
  let r = clamp(p.base_weight * p.base_color, vec3f(0.0), vec3f(0.999));
  let root = sqrt(r);
  // 1 - √r
  let rest = (1.0 - r) / (1.0 + root);
  film.n = vec4f(mix((1.0 + root) / rest, (1.0 - r) / (1.0 + r), p.specular_color), film.n.w);
  // √((r (n + 1)² - (n - 1)²) / (1 - r)), without its differences of nearly equal numbers.
  film.k = vec4f(sqrt(4.0 * r * p.specular_color * (2.0 * (1.0 - p.specular_color) / rest + p.specular_color * rest / (1.0 + r)) / ((1.0 + r) * rest)), 0.0);
  film.bases = vec2u(select(0u, 3u, p.base_metalness <= 0.0), select(4u, 3u, p.base_metalness >= 1.0));
  //#endif
  if (film.weight <= 0.0) { film.bases = vec2u(0u); }
  return film;
}

fn openpbr_film_ratio(a: vec2f, b: vec2f) -> vec2f {
  return vec2f(dot(a, b), a.y * b.x - a.x * b.y) / dot(b, b);
}

// The upper half of a number's digits: products of such are exact.
fn openpbr_film_coarse(x: f32) -> f32 {
  return bitcast<f32>(bitcast<u32>(x) & 0xfffff000u);
}

// path · √(index² - tangential) in steps of 2⁻²⁴ µm, given that root in single precision. A phase is many turns, of which only
// the last part counts: single precision would keep five digits of it. Films beyond 255 µm have lost their coherence.
fn openpbr_film_steps(index: f32, tangential: f32, root: f32, path: f32) -> u32 {
  let high = openpbr_film_coarse(index);
  let near = high * high - tangential;
  let far = ((high * high - near) - tangential) + (index - high) * (index + high);
  let q = openpbr_film_coarse(root);
  let fine = root - q;
  let missing = 0.5 * ((((near - q * q) - 2.0 * q * fine) - fine * fine) + far) / root;
  let p = openpbr_film_coarse(path);
  let head = u32(round(min(p * q, 255.0) * 16777216.0));
  return head + bitcast<u32>(i32(round((p * fine + (path - p) * root + path * missing) * 16777216.0)));
}

// Cosines and sines of turns that are counted in steps of 2⁻³², to single precision on every device: see openpbr_circle.
fn openpbr_film_phase(turns: vec4u) -> mat2x4f {
  let quarter = (turns + 0x20000000u) >> vec4u(30u);
  let x = vec4f(bitcast<vec4i>(turns - (quarter << vec4u(30u)))) * 1.4629180792671596e-9;
  let x2 = x * x;
  let c = 1.0 + x2 * (-0.5 + x2 * (0.041666667 + x2 * (-0.0013888889 + x2 * 0.000024801587)));
  let s = x * (1.0 + x2 * (-0.16666667 + x2 * (0.0083333333 + x2 * (-0.0001984127 + x2 * 0.0000027557319))));
  let odd = (quarter & vec4u(1u)) == vec4u(1u);
  let back = quarter >= vec4u(2u);
  let cosine = select(c, -s, odd);
  let sine = select(s, c, odd);
  return mat2x4f(select(cosine, -cosine, back), select(sine, -sine, back));
}

// Of four bands and for one polarisation, by Airy's sum: what is reflected, and what gets through. Both without a difference of
// nearly equal numbers, so that a film that hardly reflects, and one that hardly lets anything through, keep their digits.
// Amplitude of the near face, and of the far one; what either lets through; phase, and what of the wave's coherence is left.
fn openpbr_film_wave(near: f32, far: vec2f, through: vec2f, phase: mat2x4f, kept: f32) -> mat2x4f {
  let a = near * near;
  let b = dot(far, far);
  let rest = max(through.x + a * through.y, 1e-7);
  let real = far.x * phase[0] - far.y * phase[1];
  let imaginary = far.x * phase[1] + far.y * phase[0];
  let first = near + real;
  let back = 1.0 + (kept * near) * real;
  let aside = (kept * near) * imaginary;
  // Rounding may take it to nothing; it is not below (1 - √(a b))².
  let all = rest * max(back * back + aside * aside, vec4f(0.25 * rest * rest));
  let apart = (1.0 - kept) * (a * through.y * (1.0 - kept * b) + b * through.x * (1.0 - kept * a));
  let faded = 1.0 - kept * kept + kept * kept * rest;
  return mat2x4f(((kept * rest) * (first * first + imaginary * imaginary) + apart) / all, (through.x * through.y * faded) / all);
}

// As red, green and blue: what is reflected, and what gets through, or is lost in what lies below.
struct OpenPbrFilmLight {
  reflected: vec3f,
  through: vec3f,
}

// On a base of complex index; "tangential" is the square of the part of the wave's vector that all layers share.
fn openpbr_film_light(film: OpenPbrFilm, base: vec2f, tangential: f32) -> OpenPbrFilmLight {
  let square = vec2f(film.outer, film.index) * vec2f(film.outer, film.index);
  let across = square - tangential;
  if (min(across.x, across.y) <= 0.0) { return OpenPbrFilmLight(vec3f(1.0), vec3f(0.0)); }
  let q = sqrt(across);
  let inner = vec2f(base.x * base.x - base.y * base.y, 2.0 * base.x * base.y);
  let difference = inner.x - tangential;
  // The root of a complex number: its larger part, and from that the smaller one, which as a difference would have few digits.
  let larger = sqrt(0.5 * (length(vec2f(difference, inner.y)) + abs(difference)));
  let smaller = 0.5 * inner.y / max(larger, 1e-18);
  let below = select(vec2f(smaller, larger), vec2f(larger, smaller), difference >= 0.0);
  let up = vec2f(q.y, 0.0);
  let whole_s = up + below;
  let whole_p = inner * q.y + square.y * below;
  let far_s = openpbr_film_ratio(up - below, whole_s);
  let far_p = openpbr_film_ratio(inner * q.y - square.y * below, whole_p);
  let sum = vec2f(q.x + q.y, square.y * q.x + square.x * q.y);
  let near = vec2f(q.x - q.y, square.y * q.x - square.x * q.y) / sum;
  let entered = 4.0 * q.x * q.y * vec2f(1.0, square.x * square.y) / (sum * sum);
  let left = 4.0 * q.y * max(vec2f(below.x / dot(whole_s, whole_s), square.y * dot(inner, below) / dot(whole_p, whole_p)), vec2f(0.0));
  let through_s = vec2f(entered.x, left.x);
  let through_p = vec2f(entered.y, left.y);
  let path = film.path * q.y;
  let kept = exp(${-width} * path);
  let steps = openpbr_film_steps(film.index, tangential, q.y, film.path);
  let first = openpbr_film_phase(steps * vec4u(${bands(0)}));
  let second = openpbr_film_phase(steps * vec4u(${bands(4)}));
  let a = openpbr_film_wave(near.x, far_s, through_s, first, kept) + openpbr_film_wave(near.y, far_p, through_p, first, kept);
  let b = openpbr_film_wave(near.x, far_s, through_s, second, kept) + openpbr_film_wave(near.y, far_p, through_p, second, kept);
  let one = mat4x3f(${columns(0)});
  let other = mat4x3f(${columns(4)});
  return OpenPbrFilmLight(clamp(0.5 * (one * a[0] + other * b[0]), vec3f(0.0), vec3f(1.0)), clamp(0.5 * (one * a[1] + other * b[1]), vec3f(0.0), vec3f(1.0)));
}

//#if OPENPBR_DIELECTRIC
// Of the dielectric, for a facet seen at cosine c.
fn openpbr_film_dielectric(film: OpenPbrFilm, c: f32) -> OpenPbrFilmLight {
  return openpbr_film_light(film, vec2f(film.n.w, 0.0), (1.0 - c * c) * film.viewer);
}
//#endif

// Of a facet seen at cosine c: what metal below the film reflects, and the light of the dielectric.
struct OpenPbrFilmFacet {
  //#if OPENPBR_METAL
  metal: vec3f,
  //#endif
  //#if OPENPBR_DIELECTRIC
  dielectric: OpenPbrFilmLight,
  //#endif
}

// On the bases from the first to before the last.
fn openpbr_film_facet(film: OpenPbrFilm, c: f32, bases: vec2u) -> OpenPbrFilmFacet {
  var facet: OpenPbrFilmFacet;
  //#if OPENPBR_METAL
  // One loop for all, since this is what takes long to compile; its length hangs on the material, so that nobody unrolls it.
  for (var i = bases.x; i < bases.y; i++) {
    let base = vec2f(film.n[i], film.k[i]);
    //#if OPENPBR_DIELECTRIC
    // From inside metal looks as it does from outside.
    facet.dielectric = openpbr_film_light(film, base, (1.0 - c * c) * select(film.grazing, film.viewer, i == 3u));
    let reflected = facet.dielectric.reflected;
    //#else
    let reflected = openpbr_film_light(film, base, (1.0 - c * c) * film.grazing).reflected;
    //#endif
    facet.metal = select(facet.metal, reflected, vec3u(0u, 1u, 2u) == vec3u(i));
  }
  //#else
  if (bases.x < bases.y) { facet.dielectric = openpbr_film_dielectric(film, c); }
  //#endif
  return facet;
}

//#if OPENPBR_METAL
// Reflectance of metal: "color" is that below the film, "clear" that without.
fn openpbr_film_metal(film: OpenPbrFilm, specular_weight: f32, color: vec3f, clear: vec3f) -> vec3f {
  return mix(clear, min(specular_weight * color, vec3f(1.0)), film.weight);
}
//#endif

//#if OPENPBR_DIELECTRIC
// Sums over the facets of an interface.
struct OpenPbrFilmSum {
  // Of what the film adds to what they reflect, what is seen, and what is shadowed.
  more: vec3f,
  hidden: vec3f,
  // What they let through without the film.
  through: f32,
}

// One more facet: its part of all, with how much of that is shadowed, and what it reflects with and without the film.
fn openpbr_film_add(sum: OpenPbrFilmSum, part: f32, shadowed: f32, weight: f32, color: vec3f, bare: f32) -> OpenPbrFilmSum {
  let change = (part * weight) * (color - bare);
  return OpenPbrFilmSum(sum.more + (1.0 - shadowed) * change, sum.hidden + shadowed * change, sum.through + part * (1.0 - bare));
}

// Of the opaque part's interface and of the clear one: the film is the same, without it they are not.
struct OpenPbrFilmSums {
  opaque: OpenPbrFilmSum,
  //#if OPENPBR_TRANSMISSION
  clear: OpenPbrFilmSum,
  //#endif
}

// Over sixteen facets as they are seen: four along the cap by Gauss and Legendre, four around it whose cosines are Chebyshev's.
// "eta" are the indices of the two interfaces without the film.
fn openpbr_film_sums(film: OpenPbrFilm, eta: vec2f, alpha: vec2f, wo: vec3f) -> OpenPbrFilmSums {
  var sums: OpenPbrFilmSums;
  if (film.bases.y <= 3u) { return sums; }
  let azimuth = openpbr_ggx_azimuth(alpha, wo);
  var around = vec2f(0.92387953 * azimuth.x - 0.38268343 * azimuth.y, 0.38268343 * azimuth.x + 0.92387953 * azimuth.y);
  let so = openpbr_ggx_stretch(alpha, wo);
  for (var i = 0u; i < 16u; i++) {
    let h = openpbr_ggx_cap(alpha, wo, around, vec4f(0.06943184, 0.33000948, 0.66999052, 0.93056816)[i >> 2u], 1.0);
    around = vec2f(-around.y, around.x);
    let c = clamp(dot(wo, h), 0.0, 1.0);
    let wi = 2.0 * c * h - wo;
    let flat = alpha * wi.xy;
    let si = openpbr_ggx_stretch(alpha, wi);
    let shadowed = select(1.0, wo.z * dot(flat, flat) / ((si + wi.z) * (wo.z * si + wi.z * so)), wi.z > 0.0);
    let part = select(0.08151814, 0.04348186, i < 4u || i > 11u);
    let color = openpbr_film_dielectric(film, c).reflected;
    sums.opaque = openpbr_film_add(sums.opaque, part, shadowed, film.weight, color, openpbr_fresnel_dielectric(eta.x, c));
    //#if OPENPBR_TRANSMISSION
    sums.clear = openpbr_film_add(sums.clear, part, shadowed, film.weight, color, openpbr_fresnel_dielectric(eta.y, c));
    //#endif
  }
  return sums;
}

struct OpenPbrFilmShare {
  // What the film adds to the part of the light that single scattering reflects.
  more: vec3f,
  // Factor on what single scattering lets through, and on all that goes through; the latter less the former.
  direct: vec3f,
  passed: vec3f,
  apart: vec3f,
}

// "share" is what the interface reflects without the film.
fn openpbr_film_share(sum: OpenPbrFilmSum, share: f32) -> OpenPbrFilmShare {
  let through = max(sum.through, 1e-5);
  let rest = max(1.0 - share, 1e-5);
  let taken = sum.more / rest;
  let direct = max(1.0 - (sum.more + sum.hidden) / through, vec3f(0.0));
  return OpenPbrFilmShare(sum.more, direct, max(1.0 - taken, vec3f(0.0)), (sum.hidden + taken * (rest - through)) / through);
}
//#endif`,
    [openPbrStruct.module, openpbrGgx, openpbrFresnelDielectric, gated('OPENPBR_DIELECTRIC', openpbrDielectric)],
  );
}
