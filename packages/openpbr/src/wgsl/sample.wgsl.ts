import { gated, wgslModule } from '@glanz/wgsl';
import openpbrCosine from './cosine.wesl';
import { openpbrScatter } from './scatter.wgsl';

/**
 * `openpbr_sample`: a lobe by its probability, a direction of it, and the weight by the density of all lobes together.
 */
export const openpbrSample = wgslModule(
  'openpbr/sample',
  /* wgsl */ `//#if OPENPBR_FUZZ
fn openpbr_sample(b: OpenPbrBsdf, wo: vec3f, numbers: vec3f) -> OpenPbrSample {
  let fuzzy = numbers.z < b.fuzz.probability;
  let u = vec3f(numbers.xy, min((numbers.z - b.fuzz.probability) / max(1.0 - b.fuzz.probability, 1e-7), 0.99999994));
//#else
fn openpbr_sample(b: OpenPbrBsdf, wo: vec3f, u: vec3f) -> OpenPbrSample {
//#endif
  var s: OpenPbrSample;
  var h = vec3f(0.0, 0.0, 1.0);
  //#if OPENPBR_COAT_FRAME
  // Of the coat, where that was sampled.
  var coat_h = vec3f(0.0);
  //#endif
  //#if OPENPBR_SUBSURFACE
  var medium = 1.0;
  //#endif
  //#if OPENPBR_TRANSMISSION
  // Whether a facet was sampled, not the direction. What is left of the random number tells whether it reflects.
  var by_facet = false;
  var side = 0.0;
  //#endif
  //#if OPENPBR_SPECULAR
  //#if OPENPBR_COAT
  let top = u.z < b.coat.probability;
  let chosen = u.z - b.coat.probability;
  let limit = (1.0 - b.coat.probability) * b.specular_probability;
  //#if OPENPBR_FUZZ
  if (fuzzy) {
    s.wi = openpbr_fuzz_sample(b.fuzz, u.xy);
    h = openpbr_half(wo, s.wi);
  } else
  //#endif
  if (top || chosen < limit) {
    var alpha = select(b.alpha, b.coat.alpha, top);
    let bound = select(b.bound, b.coat.bound, top);
  //#else
  let chosen = u.z;
  let limit = b.specular_probability;
  //#if OPENPBR_FUZZ
  if (fuzzy) {
    s.wi = openpbr_fuzz_sample(b.fuzz, u.xy);
    h = openpbr_half(wo, s.wi);
  } else
  //#endif
  if (chosen < limit) {
    var alpha = b.alpha;
    let bound = b.bound;
  //#endif
    //#if OPENPBR_TRANSMISSION
    by_facet = true;
    side = chosen / limit;
    //#if OPENPBR_THIN_WALLED
    if (b.transmission.thin && side >= b.transmission.chance) { alpha = b.transmission.thin_alpha; }
    //#endif
    //#endif
    //#if OPENPBR_COAT_FRAME
    let normal = openpbr_ggx_sample(alpha, select(wo, wo * b.coat.frame, top), u.xy, bound);
    h = select(normal, b.coat.frame * normal, top);
    coat_h = select(vec3f(0.0), normal, top);
    //#else
    h = openpbr_ggx_sample(alpha, wo, u.xy, bound);
    //#endif
    s.wi = 2.0 * dot(wo, h) * h - wo;
    //#if OPENPBR_COAT_FRAME
    // Down below the coat's plane: lost, though it may be above that of the base.
    if (top && dot(s.wi, b.coat.frame[2]) <= 0.0) { return s; }
    //#endif
  }
  //#if OPENPBR_COSINE
  else {
    s.wi = openpbr_cosine_sample(u.xy);
    h = openpbr_half(wo, s.wi);
    //#if OPENPBR_TRANSMISSION
    //#if OPENPBR_COAT
    let rest = 1.0 - b.coat.probability - limit;
    //#else
    let rest = 1.0 - limit;
    //#endif
    s.transmitted = chosen - limit < b.transmission.below * rest;
    //#if OPENPBR_SUBSURFACE
    medium = (chosen - limit) / (b.transmission.below * rest);
    //#endif
    if (s.transmitted) {
      s.wi.z = -s.wi.z;
      h = openpbr_through_half(b, wo, s.wi);
    }
    //#endif
  }
  //#endif
  //#else
  s.wi = openpbr_cosine_sample(u.xy);
  //#if OPENPBR_FUZZ
  if (fuzzy) { s.wi = openpbr_fuzz_sample(b.fuzz, u.xy); }
  //#endif
  //#endif
  var facet = openpbr_facet(b, wo, h);
  //#if OPENPBR_COAT_FRAME
  facet.coat_h = select(facet.coat_h, coat_h, coat_h.z > 0.0);
  //#endif
  //#if OPENPBR_TRANSMISSION
  if (by_facet) {
    // Below 0 for the coat, which always reflects.
    let chance = openpbr_reflection_chance(b, facet);
    s.transmitted = side >= chance;
    //#if OPENPBR_SUBSURFACE
    medium = (side - chance) / (1.0 - chance);
    //#endif
    if (s.transmitted) {
      //#if OPENPBR_THIN_WALLED
      if (b.transmission.thin) { s.wi.z = -s.wi.z; } else { s.wi = openpbr_refract(b.transmission.eta, wo, h); }
      //#else
      s.wi = openpbr_refract(b.transmission.eta, wo, h);
      //#endif
    }
    // A facet may reflect downwards or refract upwards: lost.
    if (s.transmitted != (s.wi.z < 0.0)) { return s; }
  }
  //#endif
  let f = openpbr_scatter(b, wo, s.wi, facet);
  s.pdf = f.w;
  s.valid = f.w > 0.0;
  s.weight = select(vec3f(0.0), f.xyz / f.w, s.valid);
  //#if OPENPBR_SUBSURFACE
  let enters = b.transmission.subsurface_chance;
  if (s.transmitted && enters > 0.0) {
    s.subsurface = medium < enters;
    s.weight *= select((1.0 - b.transmission.subsurface) / (1.0 - enters), b.transmission.subsurface / enters, s.subsurface);
  }
  //#endif
  return s;
}`,
  [openpbrScatter, gated('OPENPBR_COSINE', openpbrCosine)],
);
