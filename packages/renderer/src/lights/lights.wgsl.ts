import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import areaLightSampling from './area_light_sampling.wesl';
import environment from '../environment/environment.wesl';
import {
  GROUP_SHIFT,
  LIGHT_DIRECTIONAL,
  LIGHT_MIRRORED,
  LIGHT_POINT,
  LIGHT_PROFILE,
  LIGHT_RECTANGLE,
  LIGHT_SPOT,
  LIGHT_TWO_SIDED,
  lightStruct,
} from '../storage/layout';
import lightChoice from './light_choice.wesl';
import lightProfile from './light_profile.wesl';
import random from '../random/random.wesl';

/** One light sample: where from, how much, how likely. */
const lightSampleStruct = wgslModule(
  'renderer/light-sample',
  /* wgsl */ `
struct LightSample {
  direction: vec3f,
  distance: f32,
  radiance: vec3f,
  // Solid-angle density including the choice of the light; for lights without size the probability of the choice.
  pdf: f32,
  // 1 if a BSDF sample could have found this light too.
  extended: bool,
  // Light group.
  group: u32,
}
`,
);

/**
 * Next-event estimation over all lights: the environment with a fixed probability, otherwise one of the emissive
 * triangles and the scene's lights, chosen by the light tree (LIGHT_TREE) or by power alone.
 */
export function lightsModule(surface: WgslModule): WgslModule {
  return wgslModule(
    'renderer/lights',
    /* wgsl */ `
//#if LIGHTS
// Emitted radiance of a surface point towards wo (world); zero behind a one-sided emitter.
fn light_emission(s: Surface, wo: vec3f) -> vec3f {
  if ((s.flags & 4u) == 0u) { return vec3f(0.0); }
  let front = dot(s.geometric, wo);
  if (front <= 0.0 && (s.flags & 1u) == 0u) { return vec3f(0.0); }
  let cosine = abs(front);
  return openpbr_emission(s.parameters, vec3f(sqrt(max(1.0 - cosine * cosine, 0.0)), 0.0, cosine));
}

// Density with which light_sample would have chosen this emissive point from so far away, over solid angle; "normal" as it
// was given then.
fn light_pdf(s: Surface, reach: f32, direction: vec3f, normal: vec3f) -> f32 {
  if (s.light == 0xffffffffu) { return 0.0; }
  let cosine = abs(dot(s.geometric, direction));
  let area = 0.5 * s.double_area;
  return light_choice(s.light, s.position - reach * direction, normal) * (reach * reach) / max(cosine * area, 1e-30);
}

fn light_table_sample(draws: vec2f, position: vec3f, normal: vec3f) -> LightSample {
  var result = LightSample(vec3f(0.0, 1.0, 0.0), 0.0, vec3f(0.0), 0.0, false, 0u);
  // One pair chooses the light and the place on it: the draws that choose a light are a strip of the square, as evenly
  // spread as the square.
  //#if LIGHT_TREE
  let pick = light_tree_pick(draws.x, position, normal);
  let index = pick.light;
  let chance = pick.probability;
  if (chance <= 0.0) { return result; }
  let u = vec2f(pick.rest, draws.y);
  //#else
  let at = draws.x * f32(frame.light_count);
  var index = min(u32(at), frame.light_count - 1u);
  var rest = at - f32(index);
  // Of many lights, the choice takes most bits.
  if (frame.light_count > 1024u) { rest = random_fresh(); }
  let keep = lights[index].keep;
  if (rest >= keep) {
    index = lights[index].other;
    rest = (rest - keep) / max(1.0 - keep, 1e-7);
  } else {
    rest /= keep;
  }
  let chance = lights[index].probability;
  let u = vec2f(min(rest, 0.99999994), draws.y);
  //#endif
  let light = lights[index];
  let choice = (1.0 - frame.environment_probability) * chance;
  let kind = light.kind & 15u;
  result.group = light.kind >> ${GROUP_SHIFT}u;
  if (kind == ${LIGHT_DIRECTIONAL}u) {
    result.direction = -light.b;
    result.distance = 3.4e38;
    result.radiance = light.color;
    result.pdf = choice;
    return result;
  }
  if (kind == ${LIGHT_POINT}u || kind == ${LIGHT_SPOT}u || kind == ${LIGHT_PROFILE}u) {
    let offset = light.a - position;
    let distance2 = max(dot(offset, offset), 1e-20);
    result.distance = sqrt(distance2);
    result.direction = offset / result.distance;
    result.radiance = light.color / distance2;
    if (kind == ${LIGHT_SPOT}u) {
      // KHR_lights_punctual's falloff: c.x scales, c.y shifts the cosine to 0..1, squared.
      let falloff = clamp(dot(-result.direction, light.b) * light.c.x + light.c.y, 0.0, 1.0);
      result.radiance *= falloff * falloff;
    }
    //#if LIGHT_PROFILES
    if (kind == ${LIGHT_PROFILE}u) { result.radiance *= light_profile(index, -result.direction); }
    //#endif
    result.pdf = choice;
    return result;
  }
  //#if AREA_LIGHTS
  if (kind >= ${LIGHT_RECTANGLE}u) {
    let sample = area_light_sample(index, u, position);
    result.direction = sample.direction;
    result.distance = sample.distance;
    result.radiance = light.color;
    result.pdf = choice * sample.pdf;
    result.extended = true;
    return result;
  }
  //#endif
  // A uniform point on the triangle.
  let root = sqrt(u.x);
  let b1 = root * (1.0 - u.y);
  let b2 = root * u.y;
  let edge_1 = light.b - light.a;
  let edge_2 = light.c - light.a;
  var face = cross(edge_1, edge_2);
  let double_area = length(face);
  face /= max(double_area, 1e-37);
  if ((light.kind & ${LIGHT_MIRRORED}u) != 0u) { face = -face; }
  let offset = light.a + b1 * edge_1 + b2 * edge_2 - position;
  let distance2 = dot(offset, offset);
  let distance = sqrt(distance2);
  let direction = offset / max(distance, 1e-30);
  let cosine = -dot(face, direction);
  if ((cosine <= 0.0 && (light.kind & ${LIGHT_TWO_SIDED}u) == 0u) || abs(cosine) * double_area <= 1e-30) { return result; }
  //#if EMISSION_TEXTURES
  let s = surface_load(vec4u(bitcast<u32>(b1), bitcast<u32>(b2), light.ids.y, light.ids.x), position, direction, 0.0);
  result.radiance = light_emission(s, -direction);
  //#else
  let one = abs(cosine);
  result.radiance = openpbr_emission(materials[light.ids.z].parameters, vec3f(sqrt(max(1.0 - one * one, 0.0)), 0.0, one));
  //#endif
  result.direction = direction;
  // Stops short of the light itself.
  result.distance = distance * (1.0 - 1e-4);
  result.pdf = choice * distance2 / (abs(cosine) * 0.5 * double_area);
  result.extended = true;
  return result;
}
//#endif

// "normal": of an opaque surface; 0 where light may come from all sides.
fn light_sample(draws: vec2f, position: vec3f, normal: vec3f) -> LightSample {
  var u = draws;
  //#if ENVIRONMENT_SAMPLED
  let share = frame.environment_probability;
  if (u.x < share) {
    let direction = environment_sample(vec2f(u.x / share, u.y));
    return LightSample(direction, 3.4e38, environment_radiance(direction), frame.environment_probability * environment_pdf(direction), true, frame.environment_group);
  }
  u.x = min((u.x - share) / max(1.0 - share, 1e-7), 0.99999994);
  //#endif
  //#if LIGHTS
  return light_table_sample(u, position, normal);
  //#else
  return LightSample(vec3f(0.0, 1.0, 0.0), 0.0, vec3f(0.0), 0.0, false, 0u);
  //#endif
}
`,
    [
      surface,
      lightStruct.module,
      lightSampleStruct,
      environment,
      random,
      gated('LIGHTS', lightChoice),
      gated('LIGHT_PROFILES', lightProfile),
      gated('AREA_LIGHTS', areaLightSampling),
    ],
  );
}
