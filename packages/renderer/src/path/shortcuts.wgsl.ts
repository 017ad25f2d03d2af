import { wgslModule } from '@glanz/wgsl';

/**
 * Deliberate shortcuts, all of them off by default and then not in any text: limits per kind of bounce (BOUNCE_LIMITS),
 * no caustics (NO_CAUSTICS), wider lobes after wide bounces (REGULARIZE), a clamp on indirect light (CLAMP_INDIRECT).
 *
 * Kinds of bounces go by the density of the direction, which lobes alone do not tell: below 0.5 per steradian a bounce
 * is as wide as Lambert's (or as a microfacet lobe of roughness 0.65 and more) and counts as diffuse, else as specular.
 */
export const shortcuts = wgslModule(
  'renderer/shortcuts',
  /* wgsl */ `
const SHORTCUT_SHARP = 0.5;

//#if CLAMP_INDIRECT
// Light that arrives after more than one bounce; "bounces" counts those between camera and light.
fn shortcut_clamp(value: vec3f, bounces: u32) -> vec3f {
  let most = max(value.x, max(value.y, value.z));
  if (bounces < 2u || most <= frame.clamp_indirect) { return value; }
  return value * (frame.clamp_indirect / most);
}
//#endif

//#if NO_CAUSTICS
// Whether light that comes in by this direction would be a caustic: a sharp bounce before a wide one, seen from the camera after it.
fn shortcut_caustic(index: u32, pdf: f32) -> bool { return pdf >= SHORTCUT_SHARP && (path_bounces(index) & 255u) != 0u; }
//#endif

//#if PATH_STATE
// Set when a bounce was the last that may be: the ray may still find a light, as the light sample of that bounce did.
const SHORTCUT_LAST = 0x80000000u;

const SHORTCUT_TRANSMITTED = 2u;
const SHORTCUT_VOLUME = 3u;

// Diffuse or specular.
fn shortcut_kind(pdf: f32) -> u32 { return select(0u, 1u, pdf >= SHORTCUT_SHARP); }

// Takes note of a bounce.
fn shortcut_bounce(index: u32, pdf: f32, kind: u32) {
  let before = path_bounces(index);
  let count = (before >> (8u * kind)) & 255u;
  if (count < 127u) { path_set_bounces(index, before + (1u << (8u * kind))); }
  //#if BOUNCE_LIMITS
  if (count >= frame.bounce_limits[kind]) { path_set_bounces(index, path_bounces(index) | SHORTCUT_LAST); }
  //#endif
  // GGX's peak density towards a viewer straight above is 1/(4π α²).
  path_set_spread(index, max(path_spread(index), min(inverseSqrt(12.566370614359172 * max(pdf, 1e-12)), 1.0)));
}
//#endif

//#if REGULARIZE
// The surface as a path sees it that has bounced wide before: the sharper a lobe behind a wide bounce, the less of it shows
// and the noisier it is (Kaplanyan and Dachsbacher, "Path Space Regularization for Holistic and Robust Light Transport", 2013).
fn shortcut_soften(index: u32, parameters: OpenPbrParameters) -> OpenPbrParameters {
  var soft = parameters;
  let roughness = sqrt(frame.regularization * path_spread(index));
  soft.specular_roughness = max(soft.specular_roughness, roughness);
  soft.coat_roughness = max(soft.coat_roughness, roughness);
  return soft;
}
//#endif
`,
);
