import { bvhOffset } from '@glanz/bvh/wgsl';
import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import {
  BACKGROUND_HIDDEN,
  GROUP_SHIFT,
  HIT_SCATTERED,
  HIT_WALKING,
  INSTANCE_CATCHER,
  MATERIAL_DISPERSIVE,
  MATERIAL_INTERIOR,
  MATERIAL_STRAIGHT,
} from '../storage/layout';
import dispersion from './dispersion.wesl';
import media from '../materials/media.wesl';
import random from '../random/random.wesl';
import { shadeCommon } from './shade-common.wgsl';
import { shadeScattering } from './shade-scattering.wgsl';
import shadingNormal from '../materials/shading_normal.wesl';
import shortcuts from '../path/shortcuts.wesl';
import pathCone from '../path/path_cone.wesl';
import pathSample from '../path/path_sample.wesl';

/**
 * One vertex of every active path: what the surface emits, a light sample to be tested by the connect kernel, and the
 * next direction. Light samples and BSDF samples are combined by the balance heuristic (Veach 1997, section 9.2).
 */
export function shadeModule(
  path: WgslModule,
  surface: WgslModule,
  lights: WgslModule,
  openpbr: WgslModule,
  energy: WgslModule,
): WgslModule {
  const common = shadeCommon(path);
  return wgslModule(
    'renderer/shade',
    /* wgsl */ `
var<workgroup> shade_next: atomic<u32>;
var<workgroup> shade_shadow: atomic<u32>;
var<workgroup> shade_next_base: u32;
var<workgroup> shade_shadow_base: u32;

// Radiance from outside the scene.
fn shade_miss(index: u32, depth: u32) {
  //#if CATCHER
  if (depth == 0u && path_role(index) == PATH_WITHOUT) { return; }
  //#endif
  let direction = path_direction(index);
  if (shade_sees_background(index, depth)) {
    // What is left of the light on its way is how much of the background shows.
    path_set_alpha(index, 1.0 - dot(path_throughput(index), vec3f(0.2126, 0.7152, 0.0722)));
    return;
  }
  if (depth == 0u && (frame.background & ${BACKGROUND_HIDDEN}u) != 0u) { return; }
  var weight = 1.0;
  //#if ENVIRONMENT_SAMPLED
  if (depth > 0u) {
    let pdf = path_pdf(index);
    weight = pdf / (pdf + frame.environment_probability * environment_pdf(direction));
  }
  //#endif
  var arriving = path_throughput(index) * environment_radiance(direction) * weight;
  //#if CLAMP_INDIRECT
  arriving = shortcut_clamp(arriving, depth);
  //#endif
  path_deposit(index, frame.environment_group, arriving);
}

fn shade_path(index: u32, iteration: u32) -> ShadeResult {
  var result: ShadeResult;
  let hit = path_hit(index);
  //#if PATH_DEPTH
  let depth = path_counters(index) & 0xffffu;
  //#else
  let depth = iteration;
  //#endif
  //#if SCATTERING
  if (hit.w == ${HIT_WALKING}u) {
    result.goes_on = any(path_throughput(index) > vec3f(0.0));
    return result;
  }
  if (hit.w == ${HIT_SCATTERED}u) { return shade_scattering(index, iteration, depth); }
  //#endif
  if (hit.w == 0xffffffffu) {
    shade_miss(index, depth);
    return result;
  }
  let origin = path_origin(index);
  let direction = path_direction(index);
  var throughput = path_throughput(index);
  let width = cone_width(path_cone(index));
  let wo = -direction;
  //#if CATCHER
  if (depth == 0u) {
    let caught = (instances[hit.w].traversal.flags & ${INSTANCE_CATCHER}u) != 0u;
    if (path_role(index) == PATH_WITHOUT) {
      if (!caught) { return result; }
    } else if (caught) {
      path_set_role(index, PATH_WITH);
      path_set_alpha(index, 0.0);
      if ((frame.background & ${BACKGROUND_HIDDEN}u) == 0u) { path_behind(index, frame.environment_group, environment_radiance(direction)); }
    }
  }
  //#endif
  var s = surface_load(hit, origin, direction, width);
  // Everything reflects on both sides: the frame turns to the side the path came from.
  let front = dot(s.geometric, wo) >= 0.0;
  let side = select(-1.0, 1.0, front);
  let geometric = side * s.geometric;
  //#if OPENPBR_TRANSMISSION
  let beyond = bvh_offset_origin(s.position, -geometric, s.magnitude);
  //#endif
  var reach = distance(origin, s.position);
  //#if MEDIA
  let stack = path_media(index);
  let crossing = media_cross(stack, s.material, front);
  //#if NULL_SURFACES
  reach += path_travelled(index);
  if (crossing.nothing) {
    path_set_origin(index, beyond);
    path_set_media(index, crossing.beyond);
    path_set_travelled(index, reach);
    result.goes_on = true;
    return result;
  }
  //#endif
  //#endif

  //#if LIGHTS
  let emitted = light_emission(s, wo);
  if (any(emitted > vec3f(0.0))) {
    var weight = 1.0;
    if (depth > 0u) {
      let pdf = path_pdf(index);
      weight = pdf / (pdf + light_pdf(s, reach, direction, cone_normal(path_cone(index))));
    }
    var arriving = throughput * emitted * weight;
    //#if CLAMP_INDIRECT
    arriving = shortcut_clamp(arriving, depth);
    //#endif
    path_deposit(index, s.flags >> ${GROUP_SHIFT}u, arriving);
  }
  //#endif
  // "depth" counts from 0, so this vertex ends edge depth + 1; the next edge must be allowed.
  var last = depth + 1u >= frame.max_depth;
  //#if BOUNCE_LIMITS
  last = last || (path_bounces(index) & SHORTCUT_LAST) != 0u;
  //#endif
  //#if STRAIGHT
  // Going straight through is no edge, as it is none to light samples.
  let through = (s.flags & ${MATERIAL_STRAIGHT}u) != 0u;
  if (last && !through) { return result; }
  //#else
  if (last) { return result; }
  //#endif

  var normal = surface_facing(side * s.normal, wo);
  //#if OPENPBR_TRANSMISSION
  if (s.parameters.transmission_weight > 0.0) {
    var eta = 1.0;
    //#if MEDIA
    if ((s.flags & ${MATERIAL_INTERIOR}u) != 0u) {
      eta = s.parameters.specular_ior / crossing.outer_ior;
      if (!front) { eta = 1.0 / eta; }
    }
    //#endif
    normal = normal_bend(normal, geometric, wo, eta);
  }
  //#endif
  let tangent = normalize(s.tangent - normal * dot(s.tangent, normal));
  let bitangent = side * sign(dot(cross(s.normal, s.tangent), s.bitangent)) * cross(normal, tangent);
  let to_world = mat3x3f(tangent, bitangent, normal);
  let local_wo = wo * to_world;
  //#if OPENPBR_COAT_FRAME
  s.parameters = surface_coated(s, side, to_world, wo);
  //#endif
  //#if REGULARIZE
  //#if STRAIGHT
  if (!through) { s.parameters = shortcut_soften(index, s.parameters); }
  //#else
  s.parameters = shortcut_soften(index, s.parameters);
  //#endif
  //#endif
  //#if MEDIA
  var outer_ior = crossing.outer_ior;
  //#if DISPERSION
  let outer = media_material(max(crossing.outer, 1u));
  let outer_dispersive = crossing.outer != 0u && (materials[outer].flags & ${MATERIAL_DISPERSIVE}u) != 0u;
  if (outer_dispersive || (s.flags & ${MATERIAL_DISPERSIVE}u) != 0u) {
    var wavelength = path_wavelength(index);
    if (wavelength == 0.0) {
      let chosen = dispersion_sample(path_pixel(index), path_sample(index), throughput);
      wavelength = chosen.wavelength;
      throughput = chosen.throughput;
      path_set_wavelength(index, wavelength);
    }
    s.parameters.specular_ior = openpbr_dispersed_ior(s.parameters, wavelength);
    if (outer_dispersive) { outer_ior = openpbr_dispersed_ior(materials[outer].parameters, wavelength); }
  }
  //#endif
  let bsdf = openpbr_prepare_side(s.parameters, local_wo, OpenPbrSide(!front && (s.flags & ${MATERIAL_INTERIOR}u) != 0u, outer_ior));
  //#else
  let bsdf = openpbr_prepare(s.parameters, local_wo);
  //#endif
  //#if TERMINATOR_LIFT
  // A surface that stands for a smooth one reflects from there: rays may leave it below the horizon of the triangle, and
  // what is in their way decides (Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021).
  //#if OPENPBR_TRANSMISSION
  let lifted = s.parameters.transmission_weight <= 0.0 && any(s.lift != vec3f(0.0));
  //#else
  let lifted = any(s.lift != vec3f(0.0));
  //#endif
  let start = bvh_offset_origin(select(s.position, s.position + s.lift, lifted), geometric, s.magnitude);
  //#else
  let lifted = false;
  let start = bvh_offset_origin(s.position, geometric, s.magnitude);
  //#endif
  shade_random(index, iteration);

  // The next vertex asks for the chance of a light with this normal, so it is rounded before.
  //#if OPENPBR_TRANSMISSION
  let opaque = s.parameters.transmission_weight <= 0.0 && s.parameters.subsurface_weight <= 0.0;
  let cone = cone_pack(width + frame.cone_spread * distance(origin, s.position), select(vec3f(0.0), geometric, opaque));
  //#else
  let cone = cone_pack(width + frame.cone_spread * distance(origin, s.position), geometric);
  //#endif
  //#if NEXT_EVENT
  let light = light_sample(random_2(), start, cone_normal(cone));
  let light_side = dot(geometric, light.direction);
  let local_wi = light.direction * to_world;
  //#if STRAIGHT
  let asked = !last && !(through && light_side < 0.0);
  //#else
  let asked = true;
  //#endif
  //#if OPENPBR_TRANSMISSION
  if (asked && light.pdf > 0.0 && (light_side * local_wi.z > 0.0 || (lifted && local_wi.z > 0.0))) {
  //#else
  if (asked && light.pdf > 0.0 && (light_side > 0.0 || lifted)) {
  //#endif
    let scatter = openpbr_eval_pdf(bsdf, local_wo, local_wi);
    if (any(scatter.xyz > vec3f(0.0))) {
      let weight = select(1.0, light.pdf / (light.pdf + scatter.w), light.extended);
      result.asks = true;
      result.shadow.origin = start;
      result.shadow.distance = light.distance;
      result.shadow.direction = light.direction;
      result.shadow.path = index;
      result.shadow.group = light.group;
      result.shadow.contribution = throughput * scatter.xyz * light.radiance * (weight / light.pdf);
      //#if CLAMP_INDIRECT
      result.shadow.contribution = shortcut_clamp(result.shadow.contribution, depth + 1u);
      //#endif
      //#if NO_CAUSTICS
      result.asks = !shortcut_caustic(index, scatter.w);
      //#endif
      //#if OPENPBR_TRANSMISSION
      if (local_wi.z < 0.0) {
        result.shadow.origin = beyond;
        // Surroundings behind glass are not there either.
        if (light.extended && light.distance >= 3.4e38 && shade_sees_background(index, depth)) { result.asks = false; }
      }
      //#endif
      //#if MEDIA
      let light_stack = select(stack, crossing.beyond, local_wi.z < 0.0);
      //#if NULL_SURFACES
      result.shadow.media = light_stack;
      //#else
      result.shadow.contribution *= media_transmittance(light_stack, light.distance);
      //#endif
      //#endif
    }
  }
  //#endif

  let scattered = openpbr_sample(bsdf, local_wo, random_3());
  if (!scattered.valid) { return result; }
  //#if STRAIGHT
  if (through && scattered.transmitted) {
    let kept = shade_roulette(throughput * scattered.weight, depth);
    if (all(kept == vec3f(0.0))) { return result; }
    path_set_origin(index, beyond);
    path_set_travelled(index, reach);
    path_set_throughput(index, kept);
    result.goes_on = true;
    return result;
  }
  if (last) { return result; }
  //#endif
  let next = to_world * scattered.wi;
  // Shading normals must not send light through a surface, or hold it back.
  //#if OPENPBR_TRANSMISSION
  if (dot(next, geometric) * scattered.wi.z <= 0.0 && !(lifted && scattered.wi.z > 0.0)) { return result; }
  //#else
  if (dot(next, geometric) <= 0.0 && !lifted) { return result; }
  //#endif
  //#if NO_CAUSTICS
  if (shortcut_caustic(index, scattered.pdf)) { return result; }
  //#endif
  //#if PATH_STATE
  //#if OPENPBR_TRANSMISSION
  shortcut_bounce(index, scattered.pdf, select(shortcut_kind(scattered.pdf), SHORTCUT_TRANSMITTED, scattered.transmitted));
  //#else
  shortcut_bounce(index, scattered.pdf, shortcut_kind(scattered.pdf));
  //#endif
  //#endif
  let carried = shade_roulette(throughput * scattered.weight, depth);
  if (all(carried == vec3f(0.0))) { return result; }
  //#if OPENPBR_TRANSMISSION
  if (!scattered.transmitted) { path_set_alpha(index, min(path_alpha(index), 1.0)); }
  path_set_origin(index, select(start, beyond, scattered.transmitted));
  //#else
  path_set_origin(index, start);
  //#endif
  //#if MEDIA
  var next_stack = select(stack, crossing.beyond, scattered.transmitted);
  //#if OPENPBR_SUBSURFACE
  if (front && scattered.transmitted && scattered.subsurface) { next_stack.x |= 0x8000u; }
  //#endif
  path_set_media(index, next_stack);
  path_set_travelled(index, 0.0);
  //#endif
  //#if PATH_DEPTH
  path_set_counters(index, path_counters(index) + 1u);
  //#endif
  path_set_pdf(index, scattered.pdf);
  path_set_direction(index, next);
  path_set_cone(index, cone);
  path_set_throughput(index, carried);
  result.goes_on = true;
  return result;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(local_invocation_index) lane: u32) {
  let depth = queues.depth;
  var result: ShadeResult;
  var index = 0u;
  if (id.x < queues.active_count) {
    index = queues.items[(depth & 1u) * queues.capacity + id.x];
    result = shade_path(index, depth);
  }
  // Places in the queues: one global atomic for a workgroup.
  var next_slot = 0u;
  var shadow_slot = 0u;
  if (result.goes_on) { next_slot = atomicAdd(&shade_next, 1u); }
  if (result.asks) { shadow_slot = atomicAdd(&shade_shadow, 1u); }
  workgroupBarrier();
  if (lane == 0u) {
    shade_next_base = atomicAdd(&queues.next_count, atomicLoad(&shade_next));
    shade_shadow_base = atomicAdd(&queues.shadow_count, atomicLoad(&shade_shadow));
  }
  workgroupBarrier();
  if (result.goes_on) { queues.items[((depth + 1u) & 1u) * queues.capacity + shade_next_base + next_slot] = index; }
  if (result.asks) { shadow_store(shade_shadow_base + shadow_slot, result.shadow); }
}
`,
    [
      common,
      path,
      pathSample,
      pathCone,
      surface,
      lights,
      openpbr,
      energy,
      random,
      shortcuts,
      bvhOffset,
      gated('MEDIA', media),
      gated('SCATTERING', shadeScattering(common, path, lights, openpbr)),
      gated('OPENPBR_TRANSMISSION', shadingNormal),
      gated('DISPERSION', dispersion),
    ],
  );
}
