import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { GROUP_SHIFT, LIGHT_HIDDEN, LIGHT_RECTANGLE, LIGHT_SPHERE, frameStruct, lightStruct } from '../storage/layout';
import { lightChoice } from './light-choice.wgsl';
import pathCone from '../path/path_cone.wesl';
import shortcuts from '../path/shortcuts.wesl';
import tangent from '../materials/tangent.wesl';

/**
 * Rectangles, disks and spheres of light. They are no surfaces: they block nothing and reflect nothing, so a ray
 * gathers all those on its way to the next surface, and none has to be in a hierarchy. A sphere is sampled over the
 * cone it fills (Shirley, Wang and Zimmerman 1996), a rectangle over the solid angle it fills (Ureña, Fajardo and King
 * 2013, "An Area-Preserving Parametrization for Spherical Rectangles"), a disk over its area.
 */
export const areaLights = /* @__PURE__ */ wgslModule(
  'renderer/area-lights',
  /* wgsl */ `
struct AreaLightSample {
  direction: vec3f,
  distance: f32,
  // Over solid angle; 0 if there is nothing to be seen.
  pdf: f32,
}

// Where a ray meets a light on the side that shines, and the density with which area_light_sample finds the place.
fn area_light_meet(index: u32, origin: vec3f, direction: vec3f) -> AreaLightSample {
  var result = AreaLightSample(direction, 0.0, 0.0);
  let a = lights[index].a;
  let b = lights[index].b;
  let c = lights[index].c;
  let kind = lights[index].kind & 15u;
  if (kind == ${LIGHT_SPHERE}u) {
    let offset = a - origin;
    let distance2 = dot(offset, offset);
    let radius2 = b.x * b.x;
    if (distance2 <= radius2) { return result; }
    let along = dot(offset, direction);
    // Distance of the line from the middle, without the cancellation of distance² − along².
    let off = offset - along * direction;
    let inside = radius2 - dot(off, off);
    if (along <= 0.0 || inside <= 0.0) { return result; }
    result.distance = along - sqrt(inside);
    result.pdf = 1.0 / area_light_cap(radius2 / distance2);
    return result;
  }
  let normal = cross(b, c);
  let facing = -dot(normal, direction);
  if (facing <= 0.0) { return result; }
  let distance = -dot(a - origin, normal) / facing;
  if (distance <= 0.0) { return result; }
  let at = origin + distance * direction - a;
  let x = dot(at, b) / dot(b, b);
  let y = dot(at, c) / dot(c, c);
  result.distance = distance;
  if (kind == ${LIGHT_RECTANGLE}u) {
    if (min(x, y) < 0.0 || max(x, y) > 1.0) { return result; }
    let seen = area_light_see(index, origin);
    // Too small for its angle: by area, as it is sampled then.
    result.pdf = select(distance * distance / facing, 1.0 / seen.angle, seen.angle > AREA_LIGHT_SMALL);
    return result;
  }
  if (x * x + y * y > 1.0) { return result; }
  result.pdf = distance * distance / (3.141592653589793 * facing);
  return result;
}

// Solid angle of a sphere's cone, by the squared sine of half its opening.
fn area_light_cap(sine2: f32) -> f32 { return 6.283185307179586 * sine2 / (1.0 + sqrt(max(1.0 - sine2, 0.0))); }

// Below this many steradians the solid angle of a rectangle is lost in rounding.
const AREA_LIGHT_SMALL = 0.01;

// A rectangle as it is seen from a place.
struct AreaLightView {
  x0: f32,
  y0: f32,
  z0: f32,
  x1: f32,
  y1: f32,
  b0: f32,
  b1: f32,
  k: f32,
  angle: f32,
}

fn area_light_see(index: u32, origin: vec3f) -> AreaLightView {
  var v: AreaLightView;
  let b = lights[index].b;
  let c = lights[index].c;
  let offset = lights[index].a - origin;
  let width = length(b);
  let height = length(c);
  v.x0 = dot(offset, b) / width;
  v.y0 = dot(offset, c) / height;
  // The side that shines is seen from positive normals: z0 is negative.
  v.z0 = dot(offset, cross(b, c)) / (width * height);
  v.x1 = v.x0 + width;
  v.y1 = v.y0 + height;
  if (v.z0 >= 0.0) { return v; }
  // Cosines between the planes through the edges and the eye.
  let n0 = -v.y0 * inverseSqrt(v.z0 * v.z0 + v.y0 * v.y0);
  let n1 = v.x1 * inverseSqrt(v.z0 * v.z0 + v.x1 * v.x1);
  let n2 = v.y1 * inverseSqrt(v.z0 * v.z0 + v.y1 * v.y1);
  let n3 = -v.x0 * inverseSqrt(v.z0 * v.z0 + v.x0 * v.x0);
  v.b0 = n0;
  v.b1 = n2;
  v.k = 6.283185307179586 - acos(clamp(-n2 * n3, -1.0, 1.0)) - acos(clamp(-n3 * n0, -1.0, 1.0));
  v.angle = acos(clamp(-n0 * n1, -1.0, 1.0)) + acos(clamp(-n1 * n2, -1.0, 1.0)) - v.k;
  return v;
}
`,
  [frameStruct.module, lightStruct.module],
);

/**
 * `fn area_light_sample(index: u32, u: vec2f, origin: vec3f) -> AreaLightSample`: towards a light, stopping short of
 * it.
 */
export const areaLightSampling = /* @__PURE__ */ wgslModule(
  'renderer/area-light-sampling',
  /* wgsl */ `
fn area_light_sample(index: u32, u: vec2f, origin: vec3f) -> AreaLightSample {
  var result = AreaLightSample(vec3f(0.0, 1.0, 0.0), 0.0, 0.0);
  let a = lights[index].a;
  let b = lights[index].b;
  let c = lights[index].c;
  let kind = lights[index].kind & 15u;
  var point: vec3f;
  if (kind == ${LIGHT_SPHERE}u) {
    let offset = a - origin;
    let distance2 = dot(offset, offset);
    let sine2 = b.x * b.x / distance2;
    if (!(sine2 < 1.0)) { return result; }
    // 1 − cosine, which small angles need.
    let off = u.x * sine2 / (1.0 + sqrt(1.0 - sine2));
    let sine = sqrt(max(off * (2.0 - off), 0.0));
    let axis = offset * inverseSqrt(distance2);
    let tangent = surface_tangent(axis);
    let phi = 6.283185307179586 * u.y;
    result.direction = normalize((1.0 - off) * axis + sine * (cos(phi) * tangent + sin(phi) * cross(axis, tangent)));
    let along = dot(offset, result.direction);
    let off_axis = offset - along * result.direction;
    result.distance = (along - sqrt(max(b.x * b.x - dot(off_axis, off_axis), 0.0))) * (1.0 - 1e-4);
    result.pdf = 1.0 / area_light_cap(sine2);
    return result;
  }
  let normal = cross(b, c);
  if (dot(a - origin, normal) >= 0.0) { return result; }
  var angle = 0.0;
  if (kind == ${LIGHT_RECTANGLE}u) {
    let v = area_light_see(index, origin);
    angle = v.angle;
    if (angle > AREA_LIGHT_SMALL) {
      let au = u.x * angle + v.k;
      let fu = (cos(au) * v.b0 - v.b1) / sin(au);
      let cu = clamp(inverseSqrt(fu * fu + v.b0 * v.b0) * select(-1.0, 1.0, fu > 0.0), -0.9999999, 0.9999999);
      let xu = clamp(-(cu * v.z0) / max(sqrt(1.0 - cu * cu), 1e-7), v.x0, v.x1);
      let d2 = xu * xu + v.z0 * v.z0;
      let h0 = v.y0 * inverseSqrt(d2 + v.y0 * v.y0);
      let h1 = v.y1 * inverseSqrt(d2 + v.y1 * v.y1);
      let hv = h0 + u.y * (h1 - h0);
      let yv = select(v.y1, hv * sqrt(d2) / sqrt(max(1.0 - hv * hv, 1e-12)), hv * hv < 0.999999);
      point = a + b * ((xu - v.x0) / (v.x1 - v.x0)) + c * ((clamp(yv, v.y0, v.y1) - v.y0) / (v.y1 - v.y0));
    } else {
      point = a + u.x * b + u.y * c;
    }
  } else {
    let radius = sqrt(u.x);
    let phi = 6.283185307179586 * u.y;
    point = a + radius * (cos(phi) * b + sin(phi) * c);
  }
  let offset = point - origin;
  let distance2 = dot(offset, offset);
  let distance = sqrt(distance2);
  result.direction = offset / max(distance, 1e-30);
  let facing = -dot(normal, result.direction);
  if (facing <= 0.0) { return result; }
  result.distance = distance * (1.0 - 1e-4);
  if (angle > AREA_LIGHT_SMALL) {
    result.pdf = 1.0 / angle;
  } else {
    result.pdf = distance2 / (select(3.141592653589793, 1.0, kind == ${LIGHT_RECTANGLE}u) * facing);
  }
  return result;
}
`,
  [areaLights, tangent],
);

/**
 * `fn area_light_gather(index, origin, direction, reach, throughput, extinction, walking)`: what the lights on a path's
 * way add to it. `throughput` is that at the origin; on a random walk it is divided by the chance to come as far.
 */
export const areaLightGathering = (path: WgslModule): WgslModule =>
  wgslModule(
    'renderer/area-light-gathering',
    /* wgsl */ `
fn area_light_gather(index: u32, origin: vec3f, direction: vec3f, reach: f32, throughput: vec3f, extinction: vec3f, walking: bool) {
  //#if PATH_DEPTH
  let depth = path_counters(index) & 0xffffu;
  let travelled = path_travelled(index);
  //#else
  let depth = queues.depth;
  let travelled = 0.0;
  //#endif
  //#if CATCHER
  if (depth == 0u && path_role(index) == PATH_WITHOUT) { return; }
  //#endif
  let vertex = origin - travelled * direction;
  let pdf = path_pdf(index);
  for (var i = 0u; i < frame.area_light_count; i++) {
    let light = frame.first_area_light + i;
    let met = area_light_meet(light, vertex, direction);
    let distance = met.distance - travelled;
    if (met.pdf <= 0.0 || distance <= 0.0 || distance >= reach) { continue; }
    var weight = 1.0;
    if (depth == 0u) {
      if ((lights[light].kind & ${LIGHT_HIDDEN}u) != 0u) { continue; }
    } else {
      weight = pdf / (pdf + light_choice(light, vertex, cone_normal(path_cone(index))) * met.pdf);
    }
    let passed = exp(-extinction * distance);
    var arriving = throughput * passed * lights[light].color * weight;
    if (walking) { arriving /= max(dot(throughput / max(throughput.x + throughput.y + throughput.z, 1e-37), passed), 1e-37); }
    //#if CLAMP_INDIRECT
    arriving = shortcut_clamp(arriving, depth);
    //#endif
    path_deposit(index, lights[light].kind >> ${GROUP_SHIFT}u, arriving);
  }
}
`,
    [path, areaLights, lightChoice, pathCone, gated('CLAMP_INDIRECT', shortcuts)],
  );
