import { bvhInstanceStruct, bvhNodeStruct, bvhTypes } from '@glanz/bvh/wgsl';
import { openPbrStruct } from '@glanz/openpbr';
import { struct } from '@glanz/wgsl';
import { blockLayout } from './blocks';

/** Everything the kernels need to know about the image, the camera and the environment. One uniform buffer. */
export const frameStruct = struct('Frame', {
  camera_origin: 'vec3f',
  /** Sides of the aperture's polygon; below 3 it is round. */
  lens_blades: 'u32',
  camera_right: 'vec3f',
  lens_radius: 'f32',
  camera_up: 'vec3f',
  focus_distance: 'f32',
  camera_forward: 'vec3f',
  cone_spread: 'f32',
  half_extent: 'vec2f',
  size: 'vec2u',
  seed: 'u32',
  max_depth: 'u32',
  light_count: 'u32',
  /** Bits `BACKGROUND_…`; in the upper half the softness of shadows, 65,535 for 1. */
  background: 'u32',
  environment_radiance: 'vec3f',
  environment_probability: 'f32',
  environment_rotation: 'vec2f',
  environment_cells: 'vec2u',
  lod_bias: 'f32',
  scene_scale: 'f32',
  /** Radians. */
  lens_rotation: 'f32',
  /** Pixels. */
  filter_radius: 'f32',
  /** Width of a camera ray's footprint at its origin, metres. */
  cone_width: 'f32',
  environment_group: 'u32',
  /** Root of the hierarchy that holds catchers and what glows. */
  catcher_root: 'u32',
  /** Largest component that a contribution of indirect light may have. */
  clamp_indirect: 'f32',
  /** Share of the widest bounce so far that lobes are at least as wide as. */
  regularization: 'f32',
  /** Most bounces: diffuse, specular, transmitted, in volumes. */
  bounce_limits: 'vec4u',
  max_volume_depth: 'u32',
  /** The lights with a size of their own among the light records. */
  first_area_light: 'u32',
  area_light_count: 'u32',
  /** Of the environment over all directions. */
  mean_luminance: 'f32',
  /** Light samples at the first vertex, of which one is tested for visibility. */
  light_candidates: 'u32',
});

/** The part of the image and the samples that one batch works on. */
export const batchStruct = struct('Batch', {
  pixel_offset: 'u32',
  pixel_count: 'u32',
  sample_offset: 'u32',
  sample_count: 'u32',
  /** Pixels times samples, twice that with catchers. */
  path_count: 'u32',
  /** Number of the film's first sample. */
  first_sample: 'u32',
  /** Number of the frame whose light samples are kept, and of the one that they were kept of before; 0: none. */
  reuse: 'u32',
  reuse_before: 'u32',
});

/** Which of a batch's samples record AOVs. */
export const aovBatchStruct = struct('AovBatch', {
  /** Number of the first sample that does. */
  begin: 'u32',
  /** Number of the first sample after those. */
  end: 'u32',
  /** Whether paths are traced for their AOVs alone, and end where these are known. */
  only: 'u32',
});

/** The camera of the frame before, and how many instances have moved since. */
export const historyStruct = struct('History', {
  origin: 'vec3f',
  moved: 'u32',
  right: 'vec3f',
  /** Whether there is a frame before; else the rest does not count. */
  known: 'u32',
  up: 'vec3f',
  forward: 'vec3f',
  half_extent: 'vec2f',
});

const SHADOW = {
  origin: 'vec3f',
  distance: 'f32',
  direction: 'vec3f',
  path: 'u32',
  contribution: 'vec3f',
  /** Light group. */
  group: 'u32',
} as const;

/** The interiors that a light sample starts in, where it may pass null interfaces. */
const MEDIA_SHADOW = { ...SHADOW, media: 'vec2u' } as const;

/** Light samples waiting for their visibility: `shadow_load` and `shadow_store` of a `Shadow`. */
const shadowBlocks = (fields: typeof SHADOW | typeof MEDIA_SHADOW) =>
  blockLayout('Shadow', 'shadow', 'shadows', fields, struct('Shadow', fields));
const shadows = shadowBlocks(SHADOW);
const mediaShadows = shadowBlocks(MEDIA_SHADOW);

/** Which records of light samples a scene's kernels use. */
export const shadowRecords = (flags: Readonly<Record<string, boolean>>) =>
  flags.NULL_SURFACES ? mediaShadows : shadows;

/**
 * An emissive triangle or one of the scene's lights, and its row of the alias table; or a node of the light tree: `a`
 * middle, `probability` radius, `b` axis, `c` cosines of spread and reach and the energy, `other` the first child or
 * the light.
 */
export const lightStruct = struct('Light', {
  a: 'vec3f',
  kind: 'u32',
  b: 'vec3f',
  /** Probability that the table picks this light, among the lights other than the environment. */
  probability: 'f32',
  c: 'vec3f',
  /** The light taken instead when the draw falls beyond `keep`; with a tree the way to it, see `LightTree`. */
  other: 'u32',
  color: 'vec3f',
  keep: 'f32',
  ids: 'vec4u',
});

/** An instance: what the traversal reads of it, then what shading reads. */
export const instanceStruct = struct('Instance', {
  traversal: bvhInstanceStruct,
  to_world_0: 'vec4f',
  to_world_1: 'vec4f',
  to_world_2: 'vec4f',
  material: 'u32',
  /** Index of its mesh in the attribute heap's table. */
  mesh: 'u32',
  /** Index of the light of this instance's triangle 0, or NONE. */
  first_light: 'u32',
  /** Index in the scene. */
  id: 'u32',
});

/** A material: the surface's parameters, its textures and how it is seen. */
export const materialStruct = struct('Material', {
  parameters: openPbrStruct,
  /** Word offset of its first TextureBindingRecord in the attribute heap. */
  first_binding: 'u32',
  binding_count: 'u32',
  flags: 'u32',
  opacity_threshold: 'f32',
});

export const MATERIAL_TWO_SIDED_EMISSION = 1;
export const MATERIAL_OPAQUE = 2;
export const MATERIAL_EMISSIVE = 4;
export const MATERIAL_MASK = 8;
/** Light may go through its surface into an inside. */
export const MATERIAL_INTERIOR = 16;
/** Its interior has air's index of refraction: in air, it is a null interface. */
export const MATERIAL_INDEX_MATCHED = 32;
/** Its index of refraction varies with the wavelength. */
export const MATERIAL_DISPERSIVE = 64;
/** A smooth thin wall: light passes it without a change of direction. */
export const MATERIAL_DELTA_TRANSMISSION = 128;
/** Bits 8 to 15 of a material's flags: its priority where interiors overlap. */
export const MATERIAL_PRIORITY_SHIFT = 8;
/** The camera does not see its back faces. */
export const MATERIAL_CULLED = 1 << 16;
/** Bits 17 and up of a material's flags and of a light's kind: its light group. */
export const GROUP_SHIFT = 17;

/** Word offsets of a mesh's attributes in the attribute heap; NONE where absent. */
export const meshStruct = struct('MeshShading', {
  indices: 'u32',
  normals: 'u32',
  tangents: 'u32',
  colors: 'u32',
  uv0: 'u32',
  uv1: 'u32',
  reserved: 'vec2u',
});

/** One texture driving one parameter of one material. */
export const bindingStruct = struct('TextureBindingRecord', {
  parameter: 'u32',
  /** Bits 0..7: channel (0..3, 4 = rgb); 8..15: uv set. */
  channels: 'u32',
  /** Which sampling case: a texture array together with a sampler. */
  sampling: 'u32',
  layer: 'u32',
  row_u: 'vec3f',
  /** Of a normal map's tangent-plane components; else what the texel 1 adds to `offset`. */
  scale: 'f32',
  row_v: 'vec3f',
  /** Half of log2(width × height). */
  log_size: 'f32',
  /** What the texel 0 stands for. */
  offset: 'f32',
});

/** Bit of an instance's traversal flags: it is a catcher. */
export const INSTANCE_CATCHER = 1;

export const NONE = 0xffffffff;
/**
 * In place of a hit's instance: the ray was scattered at the path's new origin, or is in the middle of a random walk.
 */
export const HIT_SCATTERED = 0xfffffffe;
export const HIT_WALKING = 0xfffffffd;
export const LIGHT_TRIANGLE = 0;
export const LIGHT_POINT = 1;
export const LIGHT_SPOT = 2;
export const LIGHT_DIRECTIONAL = 3;
export const LIGHT_RECTANGLE = 4;
export const LIGHT_DISK = 5;
export const LIGHT_SPHERE = 6;
export const LIGHT_PROFILE = 7;
/** Angles from the axis that a profile is kept at, a degree apart, and around it, where it differs there. */
export const PROFILE_VERTICAL = 181;
export const PROFILE_HORIZONTAL = 72;
/** Added to a triangle light's kind: it shines from both sides. */
export const LIGHT_TWO_SIDED = 16;
/**
 * Added to a triangle light's kind: the instance mirrors, so the front is where the world-space winding is clockwise.
 */
export const LIGHT_MIRRORED = 32;
/** Added to the kind of a light with a size: the camera does not see it. */
export const LIGHT_HIDDEN = 64;
/** The environment, among the ids of lights (`LightIds`), and the first id of others. */
export const LIGHT_ID_ENVIRONMENT = 0;
export const LIGHT_ID_FIRST = 1;
/** The environment, in place of a light record. */
export const LIGHT_RECORD_ENVIRONMENT = 0xfffffffe;
/** Kinds of nodes of the light tree, added up. */
export const LIGHT_NODE_LEAF = 1;
export const LIGHT_NODE_DISTANT = 2;
/** Frame.background bits: the environment is hidden from the camera; misses leave the pixel transparent. */
export const BACKGROUND_HIDDEN = 1;
export const BACKGROUND_TRANSPARENT = 2;
/** Cells in a row of the environment's importance table at most; where searches of rows begin is stored times this. */
export const ENVIRONMENT_ROW_START = 1024;

// The modules of structs, by the names that shaders import.
export const Frame = frameStruct.module;
export const Batch = batchStruct.module;
export const AovBatch = aovBatchStruct.module;
export const History = historyStruct.module;
export const Instance = instanceStruct.module;
export const Material = materialStruct.module;
export const Light = lightStruct.module;
export const OpenPbrParameters = openPbrStruct.module;
export const BvhNode = bvhNodeStruct.module;
export const BvhInstance = bvhInstanceStruct.module;
export const BvhHit = bvhTypes;
export const BvhTriangle = bvhTypes;

const meshWord = (field: Parameters<typeof meshStruct.offsetOf>[0]) => meshStruct.offsetOf(field) / 4;
const bindingWord = (field: Parameters<typeof bindingStruct.offsetOf>[0]) => bindingStruct.offsetOf(field) / 4;

// Words of a mesh's record in the attribute heap, and where its fields are.
export const MESH_WORDS = meshStruct.size / 4;
export const MESH_INDICES = meshWord('indices');
export const MESH_NORMALS = meshWord('normals');
export const MESH_TANGENTS = meshWord('tangents');
export const MESH_COLORS = meshWord('colors');
export const MESH_UV0 = meshWord('uv0');
export const MESH_UV1 = meshWord('uv1');

// The same of a texture binding.
export const BINDING_WORDS = bindingStruct.size / 4;
export const BINDING_PARAMETER = bindingWord('parameter');
export const BINDING_CHANNELS = bindingWord('channels');
export const BINDING_SAMPLING = bindingWord('sampling');
export const BINDING_LAYER = bindingWord('layer');
export const BINDING_ROW_U = bindingWord('row_u');
export const BINDING_SCALE = bindingWord('scale');
export const BINDING_ROW_V = bindingWord('row_v');
export const BINDING_LOG_SIZE = bindingWord('log_size');
export const BINDING_OFFSET = bindingWord('offset');
