import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { BACKGROUND_HIDDEN, BACKGROUND_TRANSPARENT } from '../storage/layout';
import camera from '../camera/camera.wesl';

/**
 * What can be shown before the kernels of the renderer are there: base colours of flat facets under a lamp at the
 * camera, as bright as the surroundings are on average. Small on purpose: no textures, no surface model, one ray a
 * pixel.
 */
export function firstLightModule(traversal: WgslModule): WgslModule {
  return wgslModule(
    'renderer/first-light',
    /* wgsl */ `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= batch.pixel_count) { return; }
  let pixel = batch.pixel_offset + id.x;
  let ray = camera_ray(vec2u(pixel % frame.size.x, pixel / frame.size.x), vec2f(0.5), vec2f(0.5));
  //#if CULLING
  culling_begin(ray.direction, true);
  //#endif
  let hit = bvh_closest_hit(ray.origin, ray.direction, 0.0, 3.4e38);
  if (hit.instance == 0xffffffffu) {
    let shown = (frame.background & ${BACKGROUND_HIDDEN}u) == 0u;
    beauty[pixel] = vec4f(select(vec3f(0.0), vec3f(frame.mean_luminance), shown), select(0.0, 1.0, (frame.background & ${BACKGROUND_TRANSPARENT}u) == 0u && shown));
    return;
  }
  let a = triangles[3u * hit.triangle].xyz;
  let n = cross(triangles[3u * hit.triangle + 1u].xyz - a, triangles[3u * hit.triangle + 2u].xyz - a);
  let columns = transpose(mat3x3f(instances[hit.instance].to_world_0.xyz, instances[hit.instance].to_world_1.xyz, instances[hit.instance].to_world_2.xyz));
  let normal = cross(columns[1], columns[2]) * n.x + cross(columns[2], columns[0]) * n.y + cross(columns[0], columns[1]) * n.z;
  let facing = abs(dot(normal, ray.direction)) / max(length(normal), 1e-37);
  let material = instances[hit.instance].material;
  let color = materials[material].parameters.base_weight * materials[material].parameters.base_color;
  // A lamp of this brightness lights a white facet as the surroundings would.
  let lamp = select(1.0, frame.mean_luminance, frame.mean_luminance > 0.0);
  let glow = materials[material].parameters.emission_color * materials[material].parameters.emission_luminance;
  beauty[pixel] = vec4f(color * (lamp * (0.25 + 0.75 * facing)) + glow, 1.0);
}
`,
    [camera, traversal],
  );
}
