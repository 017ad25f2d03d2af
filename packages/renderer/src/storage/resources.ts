import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { DeviceError } from '../errors';
import { GPU_STAGE_COMPUTE } from './buffers';
import { AovBatch, Batch, BvhNode, Frame, History, Instance, Light, Material, shadowRecords } from './layout';
import queues from './queues.wesl';

/** Light groups that an image may have. */
export const MAX_LIGHT_GROUPS = 16;

type Flags = Readonly<Record<string, boolean>>;

interface Resource {
  /** WGSL type after `var<…> name:`. */
  readonly type: string;
  readonly space:
    | 'uniform'
    | 'read'
    | 'read_write'
    | 'texture_2d'
    | 'texture_2d_array'
    | 'texture_3d'
    | 'unfilterable'
    | 'uint_texture'
    | 'storage_texture'
    | 'sampler';
  readonly deps?: readonly WgslModule[];
  /** The struct of its elements, where that depends on the scene. */
  readonly layout?: (flags: Flags) => { readonly module: WgslModule };
}

/** What batches of paths work with. Replaced when more paths are kept at once. */
const LAUNCH = {
  frame: { type: 'Frame', space: 'uniform', deps: [Frame] },
  batch: { type: 'Batch', space: 'uniform', deps: [Batch] },
  aov_batch: { type: 'AovBatch', space: 'uniform', deps: [AovBatch] },
  history: { type: 'History', space: 'uniform', deps: [History] },
  light_groups: { type: `array<vec4f, ${2 * MAX_LIGHT_GROUPS}>`, space: 'uniform' },
  // Its layout depends on the scene: the kernels bring it with `pathLayout`.
  paths: { type: 'array<PathBlock>', space: 'read_write' },
  queues: { type: 'Queues', space: 'read_write', deps: [queues] },
  shadows: { type: 'array<ShadowBlock>', space: 'read_write', layout: shadowRecords },
  dispatch: { type: 'array<u32, 8>', space: 'read_write' },
  history_moves: { type: 'array<vec4u>', space: 'read' },
} as const satisfies Record<string, Resource>;

/** Replaced by edits that need more memory, or another texture. Textures of its materials come after these. */
const SCENE = {
  nodes: { type: 'array<BvhNode>', space: 'read', deps: [BvhNode] },
  triangles: { type: 'array<vec4f>', space: 'read' },
  instances: { type: 'array<Instance>', space: 'read', deps: [Instance] },
  attributes: { type: 'array<u32>', space: 'read' },
  materials: { type: 'array<Material>', space: 'read', deps: [Material] },
  lights: { type: 'array<Light>', space: 'read', deps: [Light] },
  light_index: { type: 'array<u32>', space: 'read' },
  environment: { type: 'texture_2d<f32>', space: 'unfilterable' },
  environment_table: { type: 'texture_2d<f32>', space: 'unfilterable' },
  energy_dielectric: { type: 'texture_3d<f32>', space: 'texture_3d' },
  energy_conductor: { type: 'texture_2d<f32>', space: 'texture_2d' },
  energy_sampler: { type: 'sampler', space: 'sampler' },
  guide: { type: 'texture_2d<f32>', space: 'unfilterable' },
} as const satisfies Record<string, Resource>;

/** Replaced when the film changes its size or scale. */
const FILM = {
  film_block: { type: 'array<vec4f>', space: 'read_write' },
  film_total: { type: 'array<vec4f>', space: 'read_write' },
  film_moment: { type: 'array<vec4f>', space: 'read_write' },
  film_noise: { type: 'array<vec4f>', space: 'read_write' },
  film_pixels: { type: 'array<u32>', space: 'read' },
  beauty: { type: 'array<vec4f>', space: 'read_write' },
  aov_albedo: { type: 'array<vec4f>', space: 'read_write' },
  aov_normal: { type: 'array<vec4f>', space: 'read_write' },
  aov_position: { type: 'array<vec4f>', space: 'read_write' },
  aov_ids: { type: 'array<vec4u>', space: 'read_write' },
  aov_motion: { type: 'array<vec2f>', space: 'read_write' },
  film_variance: { type: 'array<vec4f>', space: 'read_write' },
  guide_points: { type: 'array<vec4f>', space: 'read' },
  light_casters: { type: 'array<vec4f, 17>', space: 'uniform' },
  light_splats: { type: 'array<atomic<u32>>', space: 'read_write' },
  reservoirs_before: { type: 'texture_2d<u32>', space: 'uint_texture' },
  reservoirs_surfaces_before: { type: 'texture_2d<u32>', space: 'uint_texture' },
  reservoirs_visible_before: { type: 'texture_2d<u32>', space: 'uint_texture' },
  reservoirs_kept: { type: 'texture_storage_2d<rgba32uint, write>', space: 'storage_texture' },
  reservoirs_surfaces: { type: 'texture_storage_2d<rgba32uint, write>', space: 'storage_texture' },
  reservoirs_visible: { type: 'texture_storage_2d<r32uint, write>', space: 'storage_texture' },
} as const satisfies Record<string, Resource>;

/**
 * What kernels may bind, described once: WGSL declarations and the entries of bind group layouts come from the same row.
 * A row's place is its number in its group. Groups are made by how often they are replaced; their order here is that of
 * their numbers, which leaves kernels no empty group but that of the scene.
 */
const GROUPS = { launch: LAUNCH, scene: SCENE, film: FILM } as const;

/** Which bind group a resource belongs to. */
export type BindGroupName = keyof typeof GROUPS;

export type ResourceName = keyof typeof LAUNCH | keyof typeof SCENE | keyof typeof FILM;

/** Scene textures and samplers that a kernel binds in addition, in order: `[name, kind]`. */
export type SceneBinding = readonly [name: string, kind: 'texture_2d_array' | 'sampler'];

/** A resource that a kernel binds. */
export interface KernelBinding extends Pick<Resource, 'type' | 'space' | 'deps' | 'layout'> {
  readonly name: string;
  readonly binding: number;
  /** Of the bind group layout, where it does not follow from `space`. */
  readonly entry?: Omit<GPUBindGroupLayoutEntry, 'binding' | 'visibility'>;
}

/** The bind groups of a kernel by their numbers, up to the last one that it uses. */
export type KernelBindings = readonly {
  readonly group: BindGroupName;
  /** Equal for groups that bind the same. */
  readonly key: string;
  readonly bindings: readonly KernelBinding[];
}[];

/**
 * What a kernel binds, and where.
 *
 * @param names Its resources, in any order.
 * @param extra Textures and samplers of the scene.
 */
export function kernelBindings(names: readonly ResourceName[], extra: readonly SceneBinding[]): KernelBindings {
  const groups = (Object.entries(GROUPS) as [BindGroupName, Record<string, Resource>][]).map(([group, table]) => {
    const rows = Object.entries(table);
    const bindings: KernelBinding[] = rows.flatMap(([name, row], binding) =>
      (names as readonly string[]).includes(name) ? [{ name, binding, ...row }] : [],
    );
    if (group === 'scene')
      extra.forEach(([name, space], index) =>
        bindings.push({
          name,
          binding: rows.length + index,
          space,
          type: space === 'sampler' ? space : 'texture_2d_array<f32>',
        }),
      );
    return { group, key: bindings.map(({ name }) => name).join(' '), bindings };
  });
  while (groups.at(-1)?.bindings.length === 0) groups.pop();
  return groups;
}

const QUALIFIERS: Partial<Record<Resource['space'], string>> = {
  uniform: '<uniform>',
  read: '<storage, read>',
  read_write: '<storage, read_write>',
};

/** The declarations of a kernel's bindings. */
export function bindingModule(kernel: string, groups: KernelBindings, flags: Flags): WgslModule {
  const lines = groups.flatMap(({ bindings }, group) =>
    bindings.map(
      ({ name, binding, type, space }) =>
        `@group(${group}) @binding(${binding}) var${QUALIFIERS[space] ?? ''} ${name}: ${type};`,
    ),
  );
  const structs = groups.flatMap(({ bindings }) =>
    bindings.flatMap(({ deps = [], layout }) => (layout ? [...deps, layout(flags).module] : deps)),
  );
  return wgslModule(`renderer/${kernel}-bindings`, lines.join('\n'), structs);
}

/** The bind group layouts that match {@link bindingModule}, by the numbers of the groups. */
export function bindGroupLayouts(device: GPUDevice, kernel: string, groups: KernelBindings): GPUBindGroupLayout[] {
  return groups.map(({ group, bindings }) =>
    device.createBindGroupLayout({
      label: `glanz ${kernel} ${group}`,
      entries: bindings.map(({ binding, space, type, entry = layoutEntry(space, type) }) => ({
        binding,
        visibility: GPU_STAGE_COMPUTE,
        ...entry,
      })),
    }),
  );
}

/**
 * A bind group of a kernel.
 *
 * @param find Where resources are looked up.
 * @throws {DeviceError} `renderer/gpu-error` for one that is not found
 */
export function createBindGroup(
  device: GPUDevice,
  layout: GPUBindGroupLayout,
  { group, bindings }: KernelBindings[number],
  find: (name: string) => GPUBindingResource | undefined,
): GPUBindGroup {
  const entries = bindings.map(({ name, binding }) => {
    const resource = find(name);
    if (!resource) throw new DeviceError('renderer/gpu-error', `A kernel asks for "${name}", which nothing provides.`);
    return { binding, resource };
  });
  return device.createBindGroup({ label: `glanz ${group}`, layout, entries });
}

function layoutEntry(space: Resource['space'], type: string): Omit<GPUBindGroupLayoutEntry, 'binding' | 'visibility'> {
  switch (space) {
    case 'uniform':
      return { buffer: { type: 'uniform' } };
    case 'read':
      return { buffer: { type: 'read-only-storage' } };
    case 'read_write':
      return { buffer: { type: 'storage' } };
    case 'texture_2d':
      return { texture: { sampleType: 'float' } };
    case 'texture_2d_array':
      return { texture: { sampleType: 'float', viewDimension: '2d-array' } };
    case 'texture_3d':
      return { texture: { sampleType: 'float', viewDimension: '3d' } };
    case 'unfilterable':
      return { texture: { sampleType: 'unfilterable-float' } };
    case 'uint_texture':
      return { texture: { sampleType: 'uint' } };
    case 'storage_texture':
      return { storageTexture: { format: /<(\w+)/.exec(type)?.[1] as GPUTextureFormat } };
    case 'sampler':
      return { sampler: { type: 'filtering' } };
  }
}
