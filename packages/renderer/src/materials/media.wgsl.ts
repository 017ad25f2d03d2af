import { openpbrMedium, openpbrSubsurface } from '@glanz/openpbr/wgsl';
import { gated, wgslModule } from '@glanz/wgsl';
import energyHost from './energy.wesl';
import {
  instanceStruct,
  MATERIAL_INDEX_MATCHED,
  MATERIAL_INTERIOR,
  MATERIAL_PRIORITY_SHIFT,
  materialStruct,
} from '../storage/layout';

/**
 * Which interiors a ray is in: a stack of up to four materials, the last entered first, in two words; an entry is the
 * material's index + 1, with bit 15 for its subsurface instead of its transmission medium. Where interiors overlap, the
 * one of the highest `dielectric_priority` is there, of equal ones the last entered; surfaces inside of a higher one
 * are not there at all (Schmidt and Budge 2002, "Simple Nested Dielectrics in Ray Traced Images"). A fifth interior
 * pushes the first out.
 */
export const media = /* @__PURE__ */ wgslModule(
  'renderer/media',
  /* wgsl */ `
fn media_entry(stack: vec2u, place: u32) -> u32 { return (select(stack.x, stack.y, place > 1u) >> (16u * (place & 1u))) & 0xffffu; }

fn media_material(entry: u32) -> u32 { return (entry & 0x7fffu) - 1u; }

fn media_priority(entry: u32) -> u32 { return (materials[media_material(entry)].flags >> ${MATERIAL_PRIORITY_SHIFT}u) & 255u; }

// The entry that the ray is in; 0 for none.
fn media_top(stack: vec2u) -> u32 {
  var top = 0u;
  for (var i = 0u; i < 4u; i++) {
    let entry = media_entry(stack, i);
    if (entry == 0u) { break; }
    if (top == 0u || media_priority(entry) > media_priority(top)) { top = entry; }
  }
  return top;
}

fn media_enter(stack: vec2u, material: u32) -> vec2u {
  return vec2u((stack.x << 16u) | (material + 1u), (stack.y << 16u) | (stack.x >> 16u));
}

// Without the last entry of the material.
fn media_leave(stack: vec2u, material: u32) -> vec2u {
  let entry = material + 1u;
  if ((stack.x & 0x7fffu) == entry) { return vec2u((stack.x >> 16u) | (stack.y << 16u), stack.y >> 16u); }
  if (((stack.x >> 16u) & 0x7fffu) == entry) { return vec2u((stack.x & 0xffffu) | (stack.y << 16u), stack.y >> 16u); }
  if ((stack.y & 0x7fffu) == entry) { return vec2u(stack.x, stack.y >> 16u); }
  if (((stack.y >> 16u) & 0x7fffu) == entry) { return vec2u(stack.x, stack.y & 0xffffu); }
  return stack;
}

// Whether no optical surface bounds the interior.
fn media_index_matched(entry: u32) -> bool { return (materials[media_material(entry)].flags & ${MATERIAL_INDEX_MATCHED}u) != 0u; }

struct MediaCrossing {
  // The stack beyond the surface.
  beyond: vec2u,
  // Entry of what is outside of the surface's object, if it bends light, and its index of refraction.
  outer: u32,
  outer_ior: f32,
  // Whether light goes on as if there were no surface.
  nothing: bool,
}

// What a ray meets at a surface of the material, on its front or from within.
fn media_cross(stack: vec2u, material: u32, front: bool) -> MediaCrossing {
  var result = MediaCrossing(stack, 0u, 1.0, false);
  let flags = materials[material].flags;
  var others = stack;
  if ((flags & ${MATERIAL_INTERIOR}u) != 0u) {
    others = media_leave(stack, material);
    if (front) {
      others = stack;
      result.beyond = media_enter(stack, material);
    } else {
      result.beyond = others;
    }
  }
  let around = media_top(others);
  if (around != 0u && !media_index_matched(around)) {
    result.outer = around;
    result.outer_ior = materials[media_material(around)].parameters.specular_ior;
  }
  if ((flags & ${MATERIAL_INTERIOR}u) != 0u) {
    let hidden = around != 0u && media_priority(around) > ((flags >> ${MATERIAL_PRIORITY_SHIFT}u) & 255u);
    result.nothing = hidden || ((flags & ${MATERIAL_INDEX_MATCHED}u) != 0u && result.outer_ior == 1.0);
  }
  return result;
}

fn media_of(entry: u32) -> OpenPbrMedium {
  //#if OPENPBR_SUBSURFACE
  if ((entry & 0x8000u) != 0u) { return openpbr_subsurface_medium(materials[media_material(entry)].parameters); }
  //#endif
  return openpbr_medium(materials[media_material(entry)].parameters);
}

// What is left of light after a distance, without what is scattered into the ray.
fn media_transmittance(stack: vec2u, distance: f32) -> vec3f {
  let top = media_top(stack);
  if (top == 0u) { return vec3f(1.0); }
  return exp(-media_of(top).extinction * distance);
}
`,
  [
    openpbrMedium,
    gated('OPENPBR_SUBSURFACE', openpbrSubsurface),
    gated('OPENPBR_SUBSURFACE', energyHost),
    materialStruct.module,
  ],
);

/** `fn media_normal(hit: BvhHit) -> vec3f`: geometric normal of the front side, of any length. */
export const mediaFront = /* @__PURE__ */ wgslModule(
  'renderer/media-front',
  /* wgsl */ `
fn media_normal(hit: BvhHit) -> vec3f {
  let a = triangles[3u * hit.triangle].xyz;
  let n = cross(triangles[3u * hit.triangle + 1u].xyz - a, triangles[3u * hit.triangle + 2u].xyz - a);
  let columns = transpose(mat3x3f(instances[hit.instance].to_world_0.xyz, instances[hit.instance].to_world_1.xyz, instances[hit.instance].to_world_2.xyz));
  let orientation = select(-1.0, 1.0, dot(columns[0], cross(columns[1], columns[2])) >= 0.0);
  return orientation * (cross(columns[1], columns[2]) * n.x + cross(columns[2], columns[0]) * n.y + cross(columns[0], columns[1]) * n.z);
}
`,
  [instanceStruct.module],
);
