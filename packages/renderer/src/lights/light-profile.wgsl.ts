import { wgslModule } from '@glanz/wgsl';
import { lightStruct, PROFILE_VERTICAL } from '../storage/layout';

/**
 * `fn light_profile(index: u32, outward: vec3f) -> f32`: what a measured lamp sends that way, W/sr. Its intensities lie
 * behind the lights, four to a record (see `profileRecords`), a degree apart from the axis on, linear in between.
 */
export const lightProfile = /* @__PURE__ */ wgslModule(
  'renderer/light-profile',
  /* wgsl */ `
fn light_profile_at(first: u32, entry: u32) -> f32 { return bitcast<f32>(lights[first + entry / 4u].ids[entry % 4u]); }

fn light_profile(index: u32, outward: vec3f) -> f32 {
  let axis = lights[index].b;
  let tangent = lights[index].c;
  let first = lights[index].ids.x;
  let around = lights[index].ids.y;
  // By the half angle, exact near both poles where the cosine is not.
  let theta = 2.0 * atan2(length(outward - axis), length(outward + axis));
  let v = clamp(theta * ${((PROFILE_VERTICAL - 1) / Math.PI).toFixed(7)}, 0.0, ${PROFILE_VERTICAL - 1}.0);
  let row = min(u32(v), ${PROFILE_VERTICAL - 2}u);
  let h = (atan2(dot(outward, cross(tangent, axis)), dot(outward, tangent)) * 0.15915494 + 1.0) * f32(around);
  let column = u32(h);
  let left = ${PROFILE_VERTICAL}u * (column % around) + row;
  let right = ${PROFILE_VERTICAL}u * ((column + 1u) % around) + row;
  let a = mix(light_profile_at(first, left), light_profile_at(first, left + 1u), v - f32(row));
  let b = mix(light_profile_at(first, right), light_profile_at(first, right + 1u), v - f32(row));
  return mix(a, b, h - f32(column));
}
`,
  [lightStruct.module],
);
