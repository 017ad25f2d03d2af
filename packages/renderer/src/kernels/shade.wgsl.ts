import { bvhOffset } from '@glanz/bvh/wgsl';
import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { BACKGROUND_HIDDEN, BACKGROUND_TRANSPARENT, GROUP_SHIFT, INSTANCE_CATCHER } from './layout';
import { random } from './random.wgsl';
import { shortcuts } from './shortcuts.wgsl';
import { pathSample } from './path.wgsl';

/**
 * One vertex of every active path: what the surface emits, a light sample to be tested by the connect kernel, and the
 * next direction. Light samples and BSDF samples are combined by the balance heuristic (Veach 1997, section 9.2).
 */
export function shadeModule(path: WgslModule, surface: WgslModule, lights: WgslModule, openpbr: WgslModule, energy: WgslModule): WgslModule {
  return wgslModule(
    'renderer/shade',
    /* wgsl */ `
var<workgroup> shade_next: atomic<u32>;
var<workgroup> shade_shadow: atomic<u32>;
var<workgroup> shade_next_base: u32;
var<workgroup> shade_shadow_base: u32;

struct ShadeResult {
  goes_on: bool,
  asks: bool,
  shadow: Shadow,
}

// Radiance from outside the scene.
fn shade_miss(index: u32, depth: u32) {
  //#if CATCHER
  if (depth == 0u && paths[index].role == PATH_WITHOUT) { return; }
  //#endif
  let direction = paths[index].direction;
  if (depth == 0u && frame.background != 0u) {
    if ((frame.background & ${BACKGROUND_TRANSPARENT}u) != 0u) { paths[index].alpha = 0.0; }
    if ((frame.background & ${BACKGROUND_HIDDEN}u) != 0u) { return; }
  }
  var weight = 1.0;
  //#if ENVIRONMENT_SAMPLED
  if (depth > 0u) {
    let pdf = paths[index].pdf;
    weight = pdf / (pdf + frame.environment_probability * environment_pdf(direction));
  }
  //#endif
  var arriving = paths[index].throughput * environment_radiance(direction) * weight;
  //#if CLAMP_INDIRECT
  arriving = shortcut_clamp(arriving, depth);
  //#endif
  path_deposit(index, frame.environment_group, arriving);
}

fn shade_path(index: u32, depth: u32) -> ShadeResult {
  var result: ShadeResult;
  let hit = paths[index].hit;
  if (hit.w == 0xffffffffu) {
    shade_miss(index, depth);
    return result;
  }
  let origin = paths[index].origin;
  let direction = paths[index].direction;
  let throughput = paths[index].throughput;
  let cone_width = paths[index].cone_width;
  let wo = -direction;
  //#if CATCHER
  if (depth == 0u) {
    let caught = (instances[hit.w].traversal.flags & ${INSTANCE_CATCHER}u) != 0u;
    if (paths[index].role == PATH_WITHOUT) {
      if (!caught) { return result; }
    } else if (caught) {
      paths[index].role = PATH_WITH;
      paths[index].alpha = 0.0;
      if ((frame.background & ${BACKGROUND_HIDDEN}u) == 0u) { path_behind(index, frame.environment_group, environment_radiance(direction)); }
    }
  }
  //#endif
  var s = surface_load(hit, origin, direction, cone_width);

  //#if LIGHTS
  let emitted = light_emission(s, wo);
  if (any(emitted > vec3f(0.0))) {
    var weight = 1.0;
    if (depth > 0u) {
      let pdf = paths[index].pdf;
      weight = pdf / (pdf + light_pdf(s, origin, direction));
    }
    var arriving = throughput * emitted * weight;
    //#if CLAMP_INDIRECT
    arriving = shortcut_clamp(arriving, depth);
    //#endif
    path_deposit(index, s.flags >> ${GROUP_SHIFT}u, arriving);
  }
  //#endif
  // "depth" counts from 0, so this vertex ends edge depth + 1; the next edge must be allowed.
  if (depth + 1u >= frame.max_depth) { return result; }
  //#if BOUNCE_LIMITS
  if ((paths[index].bounces & SHORTCUT_LAST) != 0u) { return result; }
  //#endif

  // Everything reflects on both sides: the frame turns to the side the path came from.
  let side = select(-1.0, 1.0, dot(s.geometric, wo) >= 0.0);
  let geometric = side * s.geometric;
  var normal = side * s.normal;
  let facing = dot(normal, wo);
  if (facing < 1e-3) { normal = normalize(normal + wo * (1e-3 - facing)); }
  let tangent = normalize(s.tangent - normal * dot(s.tangent, normal));
  let bitangent = side * sign(dot(cross(s.normal, s.tangent), s.bitangent)) * cross(normal, tangent);
  let to_world = mat3x3f(tangent, bitangent, normal);
  let local_wo = wo * to_world;
  //#if REGULARIZE
  s.parameters = shortcut_soften(index, s.parameters);
  //#endif
  let bsdf = openpbr_prepare(s.parameters, local_wo);
  let start = bvh_offset_origin(s.position, geometric, s.magnitude);
  random_begin(paths[index].pixel, path_sample(index), depth + 1u, frame.seed);

  //#if NEXT_EVENT
  let light = light_sample(vec4f(random_2(), random_2()), start);
  if (light.pdf > 0.0 && dot(geometric, light.direction) > 0.0) {
    let local_wi = light.direction * to_world;
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
    }
  }
  //#endif

  let scattered = openpbr_sample(bsdf, local_wo, random_3());
  if (!scattered.valid) { return result; }
  let next = to_world * scattered.wi;
  if (dot(next, geometric) <= 0.0) { return result; }
  //#if NO_CAUSTICS
  if (shortcut_caustic(index, scattered.pdf)) { return result; }
  //#endif
  //#if PATH_STATE
  shortcut_bounce(index, scattered.pdf, false);
  //#endif
  var carried = throughput * scattered.weight;
  let brightest = max(carried.x, max(carried.y, carried.z));
  if (!(brightest > 0.0)) { return result; }
  // Russian roulette from the third scattering on, for paths that carry less than a sixteenth of what they began with:
  // earlier, the noise it adds outweighs the rays it saves.
  if (depth >= 2u && brightest < 0.0625) {
    let survival = 16.0 * brightest;
    if (random_next() >= survival) { return result; }
    carried /= survival;
  }
  paths[index].origin = start;
  paths[index].pdf = scattered.pdf;
  paths[index].direction = next;
  paths[index].cone_width = cone_width + frame.cone_spread * distance(origin, s.position);
  paths[index].throughput = carried;
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
  if (result.asks) { shadows[shade_shadow_base + shadow_slot] = result.shadow; }
}
`,
    [path, pathSample, surface, lights, openpbr, energy, random, shortcuts, bvhOffset],
  );
}
