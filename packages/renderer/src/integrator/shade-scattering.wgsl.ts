import { wgslModule, type WgslModule } from '@glanz/wgsl';
import media from '../materials/media.wesl';
import pathCone from '../path/path_cone.wesl';
import random from '../random/random.wesl';
import shortcuts from '../path/shortcuts.wesl';

/**
 * `fn shade_scattering(index: u32, iteration: u32, depth: u32) -> ShadeResult`: a vertex in an interior without an
 * optical surface.
 */
export function shadeScattering(
  common: WgslModule,
  path: WgslModule,
  lights: WgslModule,
  openpbr: WgslModule,
): WgslModule {
  return wgslModule(
    'renderer/shade-scattering',
    /* wgsl */ `
// A scattering event in an interior without an optical surface.
fn shade_scattering(index: u32, iteration: u32, depth: u32) -> ShadeResult {
  var result: ShadeResult;
  // Light that was scattered does not show what is behind.
  path_set_alpha(index, min(path_alpha(index), 1.0));
  if (depth + 1u >= frame.max_depth) { return result; }
  //#if BOUNCE_LIMITS
  if ((path_bounces(index) & SHORTCUT_LAST) != 0u) { return result; }
  //#endif
  let origin = path_origin(index);
  let wo = -path_direction(index);
  let throughput = path_throughput(index);
  let stack = path_media(index);
  let anisotropy = media_of(media_top(stack)).anisotropy;
  shade_random(index, iteration);
  //#if NEXT_EVENT
  let light = light_sample(random_2(), origin, vec3f(0.0));
  if (light.pdf > 0.0) {
    let phase = openpbr_phase_eval(anisotropy, wo, light.direction);
    let weight = select(1.0, light.pdf / (light.pdf + phase), light.extended);
    result.asks = true;
    result.shadow.origin = origin;
    result.shadow.distance = light.distance;
    result.shadow.direction = light.direction;
    result.shadow.path = index;
    result.shadow.group = light.group;
    result.shadow.contribution = throughput * light.radiance * (phase * weight / light.pdf);
    //#if CLAMP_INDIRECT
    result.shadow.contribution = shortcut_clamp(result.shadow.contribution, depth + 1u);
    //#endif
    //#if NULL_SURFACES
    result.shadow.media = stack;
    //#else
    result.shadow.contribution *= media_transmittance(stack, light.distance);
    //#endif
  }
  //#endif
  let wi = openpbr_phase_sample(anisotropy, wo, random_2());
  let carried = shade_roulette(throughput, depth);
  if (all(carried == vec3f(0.0))) { return result; }
  let density = openpbr_phase_eval(anisotropy, wo, wi);
  //#if PATH_STATE
  shortcut_bounce(index, density, SHORTCUT_VOLUME);
  //#endif
  path_set_pdf(index, density);
  path_set_direction(index, wi);
  path_set_cone(index, cone_pack(cone_width(path_cone(index)), vec3f(0.0)));
  path_set_throughput(index, carried);
  path_set_travelled(index, 0.0);
  path_set_counters(index, path_counters(index) + 1u);
  result.goes_on = true;
  return result;
}
`,
    [common, path, pathCone, lights, openpbr, random, shortcuts, media],
  );
}
