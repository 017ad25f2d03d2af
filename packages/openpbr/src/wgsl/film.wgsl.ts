import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { FILM_BANDS, type FilmBands } from '../tables/film';
import { openpbrDielectric } from './dielectric.wgsl';
import { openpbrFresnelDielectric } from './fresnel.wgsl';
import { openpbrGgx } from './ggx.wgsl';
import { openPbrStruct } from './record';

/**
 * A thin film on the base, below the coat. Waves reflected by its two faces interfere; Airy's sum, with all its orders and
 * unpolarised, takes the place of the Fresnel factor, by the coverage. Below it lies the dielectric, or metal of a complex
 * index by its reflectance and edge tint (Gulbrandsen 2014).
 *
 * For a band of Lorentzian shape over wavenumbers the spectrum's integral is Airy's sum with a reflection that fades with the
 * path, in closed form: eight such bands stand for the visible spectrum, and give red, green and blue (`FILM_BANDS`), with
 * no aliasing however thick the film. From inside, light beyond the critical angle is reflected whatever the film.
 */
export const openpbrFilm = /* @__PURE__ */ filmModule(FILM_BANDS);

function filmModule({ wavenumbers, width, weights }: FilmBands): WgslModule {
  const bands = (first: number): string => wavenumbers.slice(first, first + 4).map((wavenumber) => `${256 * wavenumber}u`).join(', ');
  const columns = (first: number): string => [0, 1, 2, 3].map((i) => `vec3f(${weights.map((row) => row[first + i]).join(', ')})`).join(', ');
  return wgslModule(
  'openpbr/film',
  /* wgsl */ `struct OpenPbrFilm {
  // Coverage.
  weight: f32,
  // Indices of the film, of what lies on it and of the dielectric below, over that of what is outside of the object.
  index: f32,
  outer: f32,
  base: f32,
  // Optical path through the film and back, in µm, over the part of the wave's vector across it.
  path: f32,
  // Square of the part of the wave's vector along the surface at grazing angles: outside, and on the viewer's side.
  grazing: f32,
  viewer: f32,
  //#if OPENPBR_METAL
  // Complex index of the metal below.
  metal_n: vec3f,
  metal_k: vec3f,
  //#endif
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
  film.base = film.outer * (1.0 + epsilon) / (1.0 - epsilon);
  if (inside) { film.viewer = film.base * film.base; }
  //#endif
  //#if OPENPBR_METAL
  let r = clamp(p.base_weight * p.base_color, vec3f(0.0), vec3f(0.999));
  let root = sqrt(r);
  // 1 - √r
  let rest = (1.0 - r) / (1.0 + root);
  film.metal_n = mix((1.0 + root) / rest, (1.0 - r) / (1.0 + r), p.specular_color);
  // √((r (n + 1)² - (n - 1)²) / (1 - r)), without its differences of nearly equal numbers.
  film.metal_k = sqrt(4.0 * r * p.specular_color * (2.0 * (1.0 - p.specular_color) / rest + p.specular_color * rest / (1.0 + r)) / ((1.0 + r) * rest));
  //#endif
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

//#if OPENPBR_METAL
// Reflectance of metal for a facet seen at cosine c; "clear" is that without the film.
fn openpbr_film_metal(film: OpenPbrFilm, specular_weight: f32, c: f32, clear: vec3f) -> vec3f {
  if (film.weight <= 0.0) { return clear; }
  var color = vec3f(0.0);
  for (var i = 0; i < 3; i++) {
    color[i] = openpbr_film_light(film, vec2f(film.metal_n[i], film.metal_k[i]), (1.0 - c * c) * film.grazing).reflected[i];
  }
  return mix(clear, min(specular_weight * color, vec3f(1.0)), film.weight);
}
//#endif

//#if OPENPBR_DIELECTRIC
// Of the dielectric, for a facet seen at cosine c.
fn openpbr_film_facet(film: OpenPbrFilm, c: f32) -> OpenPbrFilmLight {
  return openpbr_film_light(film, vec2f(film.base, 0.0), (1.0 - c * c) * film.viewer);
}

struct OpenPbrFilmShare {
  // What the film adds to the part of the light that single scattering reflects.
  more: vec3f,
  // Factor on what single scattering lets through, and on all that goes through; the latter less the former.
  direct: vec3f,
  passed: vec3f,
  apart: vec3f,
}

// Sums over sixteen facets as they are seen: four along the cap by Gauss and Legendre, four around it whose cosines are
// Chebyshev's. "eta" and "share" are those of the interface without the film.
fn openpbr_film_share(film: OpenPbrFilm, eta: f32, share: f32, alpha: vec2f, wo: vec3f) -> OpenPbrFilmShare {
  if (film.weight <= 0.0) { return OpenPbrFilmShare(vec3f(0.0), vec3f(1.0), vec3f(1.0), vec3f(0.0)); }
  let azimuth = openpbr_ggx_azimuth(alpha, wo);
  var around = vec2f(0.92387953 * azimuth.x - 0.38268343 * azimuth.y, 0.38268343 * azimuth.x + 0.92387953 * azimuth.y);
  let so = openpbr_ggx_stretch(alpha, wo);
  // Of what the film adds, what is seen, and what is shadowed.
  var more = vec3f(0.0);
  var hidden = vec3f(0.0);
  var clear = 0.0;
  for (var i = 0u; i < 16u; i++) {
    let h = openpbr_ggx_cap(alpha, wo, around, vec4f(0.06943184, 0.33000948, 0.66999052, 0.93056816)[i >> 2u], 1.0);
    around = vec2f(-around.y, around.x);
    let c = clamp(dot(wo, h), 0.0, 1.0);
    let wi = 2.0 * c * h - wo;
    let flat = alpha * wi.xy;
    let si = openpbr_ggx_stretch(alpha, wi);
    let shadowed = select(1.0, wo.z * dot(flat, flat) / ((si + wi.z) * (wo.z * si + wi.z * so)), wi.z > 0.0);
    let part = select(0.08151814, 0.04348186, i < 4u || i > 11u);
    let bare = openpbr_fresnel_dielectric(eta, c);
    let change = (part * film.weight) * (openpbr_film_facet(film, c).reflected - bare);
    clear += part * (1.0 - bare);
    more += (1.0 - shadowed) * change;
    hidden += shadowed * change;
  }
  let through = max(clear, 1e-5);
  let taken = more / max(1.0 - share, 1e-5);
  return OpenPbrFilmShare(more, max(1.0 - (more + hidden) / through, vec3f(0.0)), max(1.0 - taken, vec3f(0.0)), (hidden + taken * (max(1.0 - share, 1e-5) - through)) / through);
}
//#endif`,
  [openPbrStruct.module, openpbrGgx, openpbrFresnelDielectric, gated('OPENPBR_DIELECTRIC', openpbrDielectric)],
);
}
