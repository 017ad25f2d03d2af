import { bvhOffset } from '@glanz/bvh/wgsl';
import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import type { TexturedParameterInfo } from './materials';
import random from '../random/random.wesl';
import shadingNormal from './shading_normal.wesl';
import tangent from './tangent.wesl';
import { bindingStruct, instanceStruct, materialStruct, MATERIAL_MASK, meshStruct } from '../storage/layout';

const word = (field: Parameters<typeof bindingStruct.offsetOf>[0]) => bindingStruct.offsetOf(field) / 4;
const meshWord = (field: Parameters<typeof meshStruct.offsetOf>[0]) => meshStruct.offsetOf(field) / 4;

/** Reads of the attribute heap: vertex attributes of a triangle, interpolated at a hit. */
const attributes = wgslModule(
  'renderer/attributes',
  /* wgsl */ `
fn attribute_mesh(mesh: u32, field: u32) -> u32 { return attributes[mesh * ${meshStruct.size / 4}u + field]; }

fn attribute_corners(mesh: u32, triangle: u32) -> vec3u {
  let at = attribute_mesh(mesh, ${meshWord('indices')}u) + 3u * triangle;
  return vec3u(attributes[at], attributes[at + 1u], attributes[at + 2u]);
}

fn attribute_2(at: u32) -> vec2f { return bitcast<vec2f>(vec2u(attributes[at], attributes[at + 1u])); }
fn attribute_3(at: u32) -> vec3f { return bitcast<vec3f>(vec3u(attributes[at], attributes[at + 1u], attributes[at + 2u])); }
fn attribute_4(at: u32) -> vec4f { return bitcast<vec4f>(vec4u(attributes[at], attributes[at + 1u], attributes[at + 2u], attributes[at + 3u])); }

struct AttributeUv {
  uv: vec2f,
  // Edges of the triangle in texture space.
  edge_1: vec2f,
  edge_2: vec2f,
}

fn attribute_uv(base: u32, corners: vec3u, weights: vec3f) -> AttributeUv {
  if (base == 0xffffffffu) { return AttributeUv(vec2f(0.0), vec2f(0.0), vec2f(0.0)); }
  let a = attribute_2(base + 2u * corners.x);
  let b = attribute_2(base + 2u * corners.y);
  let c = attribute_2(base + 2u * corners.z);
  return AttributeUv(weights.x * a + weights.y * b + weights.z * c, b - a, c - a);
}

fn attribute_color(mesh: u32, corners: vec3u, weights: vec3f) -> vec4f {
  let base = attribute_mesh(mesh, ${meshWord('colors')}u);
  if (base == 0xffffffffu) { return vec4f(1.0); }
  return weights.x * attribute_4(base + 4u * corners.x) + weights.y * attribute_4(base + 4u * corners.y) + weights.z * attribute_4(base + 4u * corners.z);
}
`,
  [meshStruct.module],
);

/**
 * The module that reads a material with its textures. Its text depends on the scene: a case for each pair of texture
 * array and sampler, and one for each parameter that some material textures.
 *
 * @param samplings Pairs of texture array and sampler indices, in the order of the records' `sampling` numbers.
 * @param textured Parameters that are textured, with their number in the records and what they are.
 */
export function materialModule(
  samplings: readonly (readonly [texture: number, sampler: number])[],
  textured: readonly TexturedParameterInfo[],
): WgslModule {
  const cases = samplings
    .map(
      ([texture, sampler], index) =>
        `    case ${index}u: { return textureSampleLevel(scene_texture_${texture}, scene_sampler_${sampler}, uv, layer, lod); }`,
    )
    .join('\n');
  const FACTOR = {
    f32: 'value',
    vec3f: 'factor.rgb',
    any: 'select(vec3f(value), factor.rgb, (channels & 255u) == 4u)',
  } as const;
  const DIRECTION: Readonly<Record<string, string>> = {
    geometry_normal: `result.normal = (2.0 * texel.xyz - 1.0) * vec3f(vec2f(bitcast<f32>(attributes[at + ${word('scale')}u])), 1.0);`,
    geometry_coat_normal: `result.coat_normal = (2.0 * texel.xyz - 1.0) * vec3f(vec2f(bitcast<f32>(attributes[at + ${word('scale')}u])), 1.0);`,
    geometry_tangent:
      'result.tangent = mat2x2f(result.tangent, vec2f(-result.tangent.y, result.tangent.x)) * (2.0 * texel.xy - 1.0);',
  };
  const cased = ({ name, id, type }: TexturedParameterInfo) =>
    `      case ${id}u: { ${type === 'direction' ? DIRECTION[name] : `result.parameters.${name} *= ${FACTOR[type]};`} }`;
  const gates: Readonly<Record<string, string>> = {
    geometry_tangent: 'TANGENT_MAP',
    geometry_coat_normal: 'OPENPBR_COAT_FRAME',
  };
  const apply = textured
    .map((info) => (gates[info.name] ? `      //#if ${gates[info.name]}\n${cased(info)}\n      //#endif` : cased(info)))
    .join('\n');
  return wgslModule(
    'renderer/material',
    /* wgsl */ `
struct MaterialSample {
  parameters: OpenPbrParameters,
  // Tangent-space normal from the normal map, before normalising; (0, 0, 1) without one.
  normal: vec3f,
  flags: u32,
  threshold: f32,
  //#if TANGENT_MAP
  // Direction in the tangent plane that the highlight is stretched along.
  tangent: vec2f,
  //#endif
  //#if OPENPBR_COAT_FRAME
  // As the normal, of the coat.
  coat_normal: vec3f,
  //#endif
}

//#if TEXTURES
fn material_texel(sampling: u32, uv: vec2f, layer: u32, lod: f32) -> vec4f {
  switch (sampling) {
${cases}
    default: { return vec4f(1.0); }
  }
}
//#endif

// "only" picks one parameter to texture, 0xffffffff all of them; "lod" is log2 of the footprint in units of uv.
fn material_sample(index: u32, uv0: vec2f, uv1: vec2f, lod0: f32, lod1: f32, only: u32) -> MaterialSample {
  var result: MaterialSample;
  result.parameters = materials[index].parameters;
  result.normal = vec3f(0.0, 0.0, 1.0);
  result.flags = materials[index].flags;
  result.threshold = materials[index].opacity_threshold;
  //#if TANGENT_MAP
  result.tangent = result.parameters.geometry_tangent.xy;
  //#endif
  //#if OPENPBR_COAT_FRAME
  result.coat_normal = result.parameters.geometry_coat_normal;
  //#endif
  //#if TEXTURES
  let count = min(materials[index].binding_count, 64u);
  let first = materials[index].first_binding;
  for (var i = 0u; i < count; i++) {
    let at = first + i * ${bindingStruct.size / 4}u;
    let parameter = attributes[at + ${word('parameter')}u];
    if (only != 0xffffffffu && parameter != only) { continue; }
    let channels = attributes[at + ${word('channels')}u];
    let second = (channels >> 8u) != 0u;
    let uv = vec3f(select(uv0, uv1, second), 1.0);
    let placed = vec2f(dot(attribute_3(at + ${word('row_u')}u), uv), dot(attribute_3(at + ${word('row_v')}u), uv));
    let lod = select(lod0, lod1, second) + bitcast<f32>(attributes[at + ${word('log_size')}u]);
    let texel = material_texel(attributes[at + ${word('sampling')}u], placed, attributes[at + ${word('layer')}u], max(lod, 0.0));
    //#if TEXTURE_RANGES
    let factor = bitcast<f32>(attributes[at + ${word('offset')}u]) + bitcast<f32>(attributes[at + ${word('scale')}u]) * texel;
    //#else
    let factor = texel;
    //#endif
    let value = factor[min(channels & 255u, 3u)];
    switch (parameter) {
${apply}
      default: { }
    }
  }
  //#endif
  return result;
}
`,
    [bindingStruct.module, materialStruct.module, attributes],
  );
}

/** Opacity of a candidate hit for the traversal: accepted with the probability of the surface being there. */
export function opacityModule(material: WgslModule, opacityParameter: number): WgslModule {
  return wgslModule(
    'renderer/opacity',
    /* wgsl */ `
var<private> opacity_key: vec3u;

// Names the random numbers of one ray: pixel, sample and its place along the path.
fn opacity_begin(pixel: u32, sample: u32, stream: u32) { opacity_key = vec3u(pixel, sample, stream); }

fn opacity_at(hit: BvhHit) -> f32 {
  let index = instances[hit.instance].material;
  if ((materials[index].flags & 2u) != 0u) { return 1.0; }
  let mesh = instances[hit.instance].mesh;
  let corners = attribute_corners(mesh, bitcast<u32>(triangles[3u * hit.triangle].w));
  let weights = vec3f(1.0 - hit.u - hit.v, hit.u, hit.v);
  let uv0 = attribute_uv(attribute_mesh(mesh, ${meshWord('uv0')}u), corners, weights).uv;
  let uv1 = attribute_uv(attribute_mesh(mesh, ${meshWord('uv1')}u), corners, weights).uv;
  let sample = material_sample(index, uv0, uv1, -64.0, -64.0, ${opacityParameter}u);
  var opacity = sample.parameters.geometry_opacity;
  //#if VERTEX_COLORS
  opacity *= attribute_color(mesh, corners, weights).a;
  //#endif
  if ((sample.flags & ${MATERIAL_MASK}u) != 0u) { return select(0.0, 1.0, opacity >= sample.threshold); }
  return opacity;
}

// Crossing a surface of opacity α goes on with probability 1 − α. The decision hangs on ray, instance and triangle alone,
// not on the order of traversal, so the nearest accepted hit is well defined.
fn opacity_accept(hit: BvhHit) -> bool {
  let opacity = opacity_at(hit);
  if (opacity >= 1.0) { return true; }
  let seed = vec4u(opacity_key.xy, opacity_key.z + 0x10000u * (frame.seed & 0xffffu), (hit.triangle * 0x9e3779b9u) ^ (hit.instance * 0x85ebca6bu + 1u));
  return f32(random_pcg4d(seed).x >> 8u) * 5.9604644775390625e-8 < opacity;
}
`,
    [material, random],
  );
}

/** A hit with everything that shading needs: place, frames, the material's parameters there. */
export function surfaceModule(material: WgslModule): WgslModule {
  return wgslModule(
    'renderer/surface',
    /* wgsl */ `
struct Surface {
  position: vec3f,
  // Unit; towards the front (the side the triangle's counter-clockwise winding faces).
  geometric: vec3f,
  // Unit shading frame on the front side.
  normal: vec3f,
  tangent: vec3f,
  bitangent: vec3f,
  parameters: OpenPbrParameters,
  flags: u32,
  material: u32,
  // Light index of this triangle, or 0xffffffff.
  light: u32,
  id: u32,
  // Twice the triangle's area in the world.
  double_area: f32,
  // Largest coordinate that went into the position; rounding errors are proportional to it.
  magnitude: f32,
  //#if TERMINATOR_LIFT
  // From the position to the smooth surface that the normals stand for, where that bulges towards the ray's side; else 0.
  lift: vec3f,
  //#endif
  //#if OPENPBR_COAT_FRAME
  // Of the coat, unit, on the front side.
  coat_normal: vec3f,
  coat_tangent: vec3f,
  //#endif
}

// A normal that the viewer sees.
fn surface_facing(normal: vec3f, wo: vec3f) -> vec3f {
  let facing = dot(normal, wo);
  return select(normal, normalize(normal + wo * (1e-3 - facing)), facing < 1e-3);
}

//#if OPENPBR_COAT_FRAME
// The parameters with the coat's frame as seen from the base's, whose columns are tangent, bitangent and normal on the
// viewer's side. The coat reflects almost everything at grazing angles, so a mirrored ray below the base's plane or below
// the triangle would leave the silhouette black: its normal faces the viewer, and is bent until that ray leaves above both.
fn surface_coated(s: Surface, side: f32, to_world: mat3x3f, wo: vec3f) -> OpenPbrParameters {
  var parameters = s.parameters;
  var coat = surface_facing(side * s.coat_normal, wo);
  coat = normal_raise(coat, to_world[2], wo, min(0.02, dot(to_world[2], wo)));
  //#if TERMINATOR_LIFT
  // Rays from the smooth surface may leave below the triangle's horizon.
  //#if OPENPBR_TRANSMISSION
  let lifted = parameters.transmission_weight <= 0.0 && any(s.lift != vec3f(0.0));
  //#else
  let lifted = any(s.lift != vec3f(0.0));
  //#endif
  //#else
  let lifted = false;
  //#endif
  let geometric = side * s.geometric;
  if (!lifted) { coat = normal_raise(coat, geometric, wo, min(0.02, dot(geometric, wo))); }
  parameters.geometry_coat_normal = coat * to_world;
  parameters.geometry_coat_tangent = s.coat_tangent * to_world;
  return parameters;
}

// A frame of that normal in which the viewer lies over the tangent.
fn surface_view_frame(normal: vec3f, wo: vec3f) -> mat3x3f {
  let across = cross(normal, wo);
  let sine2 = dot(across, across);
  let bitangent = select(surface_tangent(normal), across * inverseSqrt(max(sine2, 1e-30)), sine2 > 1e-12);
  return mat3x3f(cross(bitangent, normal), bitangent, normal);
}
//#endif

fn surface_normal_to_world(columns: mat3x3f, orientation: f32, n: vec3f) -> vec3f {
  return orientation * (cross(columns[1], columns[2]) * n.x + cross(columns[2], columns[0]) * n.y + cross(columns[0], columns[1]) * n.z);
}

// "hit": barycentrics as bits, triangle, instance. "cone": width of the ray's footprint per unit of distance, and at its origin.
fn surface_load(hit: vec4u, origin: vec3f, direction: vec3f, cone_width: f32) -> Surface {
  var s: Surface;
  let u = bitcast<f32>(hit.x);
  let v = bitcast<f32>(hit.y);
  let weights = vec3f(1.0 - u - v, u, v);
  let first = triangles[3u * hit.z];
  let a = first.xyz;
  let b = triangles[3u * hit.z + 1u].xyz;
  let c = triangles[3u * hit.z + 2u].xyz;
  let edge_1 = b - a;
  let edge_2 = c - a;
  let triangle = bitcast<u32>(first.w);
  let x = instances[hit.w].to_world_0;
  let y = instances[hit.w].to_world_1;
  let z = instances[hit.w].to_world_2;
  var p = a + u * edge_1 + v * edge_2;
  let reach = vec4f(max(abs(a), max(abs(b), abs(c))), 1.0);
  s.magnitude = max(dot(abs(x), reach), max(dot(abs(y), reach), dot(abs(z), reach)));
  let columns = transpose(mat3x3f(x.xyz, y.xyz, z.xyz));
  let orientation = select(-1.0, 1.0, dot(columns[0], cross(columns[1], columns[2])) >= 0.0);
  let area = surface_normal_to_world(columns, orientation, cross(edge_1, edge_2));
  s.double_area = length(area);
  s.geometric = area / max(s.double_area, 1e-37);
  // Within the length of a ray's first step from an edge, rounding and that step may lead behind the wall that meets this one
  // there, and light would leak through the corner. Such points are moved inwards as far; not more than a few of these
  // lengths, though, as needles would want.
  let sides = mat3x3f(columns * (edge_2 - edge_1), columns * edge_2, columns * edge_1);
  let lengths = sqrt(vec3f(dot(sides[0], sides[0]), dot(sides[1], sides[1]), dot(sides[2], sides[2])));
  let step = s.magnitude * BVH_OFFSET;
  if (any(weights * s.double_area < step * lengths)) {
    let kept = max(weights, min(step * lengths / max(s.double_area, 1e-37), vec3f(1.0)));
    let inside = kept / (kept.x + kept.y + kept.z);
    let pulled = a + inside.y * edge_1 + inside.z * edge_2;
    if (distance(columns * pulled, columns * p) <= 4.0 * step) { p = pulled; }
  }
  s.position = vec3f(dot(x.xyz, p) + x.w, dot(y.xyz, p) + y.w, dot(z.xyz, p) + z.w);
  s.normal = s.geometric;
  s.id = instances[hit.w].id;
  s.material = instances[hit.w].material;
  let light = instances[hit.w].first_light;
  s.light = select(light + triangle, 0xffffffffu, light == 0xffffffffu);

  let mesh = instances[hit.w].mesh;
  let corners = attribute_corners(mesh, triangle);
  let normals = attribute_mesh(mesh, ${meshWord('normals')}u);
  if (normals != 0xffffffffu) {
    let n = mat3x3f(attribute_3(normals + 3u * corners.x), attribute_3(normals + 3u * corners.y), attribute_3(normals + 3u * corners.z));
    let world = surface_normal_to_world(columns, orientation, n * weights);
    let length2 = dot(world, world);
    if (length2 > 0.0) { s.normal = world * inverseSqrt(length2); }
    //#if TERMINATOR_LIFT
    let side = select(-1.0, 1.0, dot(s.geometric, direction) <= 0.0);
    for (var i = 0u; i < 3u; i++) {
      let corner = surface_normal_to_world(columns, orientation, n[i]);
      let unit = corner * inverseSqrt(max(dot(corner, corner), 1e-37));
      let height = side * dot(columns * (p - select(select(a, b, i == 1u), c, i == 2u)), unit);
      // Corners whose normals lean further belong to hard edges.
      s.lift -= side * weights[i] * smoothstep(0.6, 0.8, dot(unit, s.geometric)) * min(height, 0.0) * unit;
    }
    //#endif
  }

  //#if TEXTURES
  let uv0 = attribute_uv(attribute_mesh(mesh, ${meshWord('uv0')}u), corners, weights);
  let uv1 = attribute_uv(attribute_mesh(mesh, ${meshWord('uv1')}u), corners, weights);
  // Texture level from the ray's cone (Akenine-Möller et al., "Texture Level of Detail Strategies", Ray Tracing Gems 2019).
  let width = cone_width + frame.cone_spread * distance(origin, s.position);
  let footprint = log2(max(width, 1e-30)) - log2(max(abs(dot(direction, s.geometric)), 1e-3)) + frame.lod_bias - 0.5 * log2(max(s.double_area, 1e-37));
  let lod0 = footprint + 0.5 * log2(max(abs(uv0.edge_1.x * uv0.edge_2.y - uv0.edge_1.y * uv0.edge_2.x), 1e-37));
  let lod1 = footprint + 0.5 * log2(max(abs(uv1.edge_1.x * uv1.edge_2.y - uv1.edge_1.y * uv1.edge_2.x), 1e-37));
  let sample = material_sample(s.material, uv0.uv, uv1.uv, lod0, lod1, 0xffffffffu);
  //#else
  let sample = material_sample(s.material, vec2f(0.0), vec2f(0.0), 0.0, 0.0, 0xffffffffu);
  //#if UV_FRAME
  let uv0 = attribute_uv(attribute_mesh(mesh, ${meshWord('uv0')}u), corners, weights);
  //#endif
  //#endif
  s.parameters = sample.parameters;
  s.flags = sample.flags;
  //#if VERTEX_COLORS
  let painted = attribute_color(mesh, corners, weights).rgb;
  s.parameters.base_color *= painted;
  //#if OPENPBR_EMISSION
  // Where nothing is reflected (glTF's unlit materials), it is the light that is painted.
  if (s.parameters.base_weight == 0.0 && s.parameters.specular_weight == 0.0) { s.parameters.emission_color *= painted; }
  //#endif
  //#if OPENPBR_TRANSMISSION
  if (s.parameters.transmission_depth <= 0.0) { s.parameters.transmission_color *= painted; }
  //#endif
  //#endif

  var tangent = surface_tangent(s.normal);
  var handedness = 1.0;
  let tangents = attribute_mesh(mesh, ${meshWord('tangents')}u);
  if (tangents != 0xffffffffu) {
    let t = weights.x * attribute_4(tangents + 4u * corners.x) + weights.y * attribute_4(tangents + 4u * corners.y) + weights.z * attribute_4(tangents + 4u * corners.z);
    let world = columns * t.xyz;
    let flat = world - s.normal * dot(s.normal, world);
    if (dot(flat, flat) > 1e-12 * dot(world, world)) {
      tangent = normalize(flat);
      handedness = select(-1.0, 1.0, t.w >= 0.0) * orientation;
    }
  }
  //#if UV_FRAME
  else {
    // Tangents from the texture coordinates: along +u, with the bitangent against +v, since v runs down the image.
    let det = uv0.edge_1.x * uv0.edge_2.y - uv0.edge_1.y * uv0.edge_2.x;
    if (det != 0.0) {
      let along_u = columns * (edge_1 * uv0.edge_2.y - edge_2 * uv0.edge_1.y) * sign(det);
      let against_v = columns * (edge_1 * uv0.edge_2.x - edge_2 * uv0.edge_1.x) * sign(det);
      let flat = along_u - s.normal * dot(s.normal, along_u);
      if (dot(flat, flat) > 0.0) {
        tangent = normalize(flat);
        handedness = select(-1.0, 1.0, dot(cross(s.normal, tangent), against_v) >= 0.0);
      }
    }
  }
  //#endif
  //#if OPENPBR_COAT_FRAME
  // The coat lies smoothly over what its base's maps make of the surface.
  let across = handedness * cross(s.normal, tangent);
  let coat = sample.coat_normal.x * tangent + sample.coat_normal.y * across + sample.coat_normal.z * s.normal;
  s.coat_normal = select(s.normal, coat * inverseSqrt(max(dot(coat, coat), 1e-30)), dot(coat, coat) > 1e-12 && sample.coat_normal.z > 0.0);
  s.coat_tangent = s.parameters.geometry_coat_tangent.x * tangent + s.parameters.geometry_coat_tangent.y * across;
  //#endif
  //#if TANGENT_MAP
  if (dot(sample.tangent, sample.tangent) > 1e-6) { tangent = sample.tangent.x * tangent + (handedness * sample.tangent.y) * cross(s.normal, tangent); }
  //#endif
  //#if NORMAL_MAP
  let mapped = sample.normal.x * tangent + handedness * sample.normal.y * cross(s.normal, tangent) + sample.normal.z * s.normal;
  let mapped2 = dot(mapped, mapped);
  if (mapped2 > 1e-12 && sample.normal.z > 0.0) { s.normal = mapped * inverseSqrt(mapped2); }
  //#endif
  tangent -= s.normal * dot(s.normal, tangent);
  let tangent2 = dot(tangent, tangent);
  s.tangent = select(surface_tangent(s.normal), tangent * inverseSqrt(max(tangent2, 1e-30)), tangent2 > 1e-6);
  s.bitangent = handedness * cross(s.normal, s.tangent);
  return s;
}
`,
    [
      material,
      instanceStruct.module,
      tangent,
      bvhOffset,
      gated('TEXTURES', attributes),
      gated('OPENPBR_COAT_FRAME', shadingNormal),
    ],
  );
}
