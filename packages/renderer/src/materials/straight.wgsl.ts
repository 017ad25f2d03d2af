import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import energyHost from './energy.wesl';
import shadingNormal from './shading_normal.wesl';

/**
 * `fn straight_transmittance(s: Surface, direction: vec3f) -> vec3f`: what a smooth thin wall lets through. Light goes
 * on behind it as if it were not there, so light samples pass it, and a path that passes it has had no say in its
 * direction: it keeps the density of the last vertex that did, and the two ways of finding a light behind glass are
 * weighed as without it.
 */
export const straight = (surface: WgslModule, openpbr: WgslModule): WgslModule =>
  wgslModule(
    'renderer/straight',
    /* wgsl */ `
fn straight_transmittance(given: Surface, direction: vec3f) -> vec3f {
  var s = given;
  let wo = -direction;
  let side = select(-1.0, 1.0, dot(s.geometric, wo) >= 0.0);
  let normal = normal_bend(surface_facing(side * s.normal, wo), side * s.geometric, wo, 1.0);
  let mu = clamp(dot(normal, wo), 0.0, 1.0);
  //#if OPENPBR_COAT_FRAME
  s.parameters = surface_coated(s, side, surface_view_frame(normal, wo), wo);
  //#endif
  let b = openpbr_prepare(s.parameters, vec3f(sqrt(1.0 - mu * mu), 0.0, mu));
  var passed = b.transmission.albedo;
  //#if OPENPBR_COAT
  passed *= openpbr_coat_through(b, mu);
  //#endif
  //#if OPENPBR_FUZZ
  passed *= b.fuzz.below;
  //#endif
  return passed;
}
`,
    [surface, openpbr, energyHost, gated('OPENPBR_TRANSMISSION', shadingNormal)],
  );
