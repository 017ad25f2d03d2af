import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { GPU_STAGE_COMPUTE } from './buffers';
import { AovBatch, Batch, BvhNode, Frame, Instance, Light, Material, shadowRecords } from './layout';
import queues from './queues.wesl';

/** Light groups that an image may have. */
export const MAX_LIGHT_GROUPS = 16;

/**
 * What a kernel may bind, described once: the WGSL declaration and the bind group layout entry come from the same row.
 * Textures of the scene are added by the material module, since their number depends on the scene.
 */
type Flags = Readonly<Record<string, boolean>>;

interface Resource {
  /** WGSL type after `var<…> name:`. */
  readonly type: string;
  readonly space:
    'uniform' | 'read' | 'read_write' | 'texture_2d' | 'texture_2d_array' | 'texture_3d' | 'unfilterable' | 'sampler';
  readonly deps?: readonly WgslModule[];
  /** The struct of its elements, where that depends on the scene. */
  readonly layout?: (flags: Flags) => { readonly module: WgslModule };
}

const RESOURCES = {
  frame: { type: 'Frame', space: 'uniform', deps: [Frame] },
  batch: { type: 'Batch', space: 'uniform', deps: [Batch] },
  // Its layout depends on the scene: the kernels bring it with `pathLayout`.
  paths: { type: 'array<PathBlock>', space: 'read_write' },
  queues: { type: 'Queues', space: 'read_write', deps: [queues] },
  shadows: { type: 'array<ShadowBlock>', space: 'read_write', layout: shadowRecords },
  dispatch: { type: 'array<u32, 8>', space: 'read_write' },
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
  film_block: { type: 'array<vec4f>', space: 'read_write' },
  film_total: { type: 'array<vec4f>', space: 'read_write' },
  film_moment: { type: 'array<vec4f>', space: 'read_write' },
  film_noise: { type: 'array<vec4f>', space: 'read_write' },
  film_pixels: { type: 'array<u32>', space: 'read' },
  light_groups: { type: `array<vec4f, ${2 * MAX_LIGHT_GROUPS}>`, space: 'uniform' },
  beauty: { type: 'array<vec4f>', space: 'read_write' },
  aov_batch: { type: 'AovBatch', space: 'uniform', deps: [AovBatch] },
  aov_albedo: { type: 'array<vec4f>', space: 'read_write' },
  aov_normal: { type: 'array<vec4f>', space: 'read_write' },
  aov_position: { type: 'array<vec4f>', space: 'read_write' },
  aov_ids: { type: 'array<vec4u>', space: 'read_write' },
} as const satisfies Record<string, Resource>;

export type ResourceName = keyof typeof RESOURCES;

/** Scene textures and samplers that a kernel binds in addition, in order: `[name, kind]`. */
export type SceneBinding = readonly [name: string, kind: 'texture_2d_array' | 'sampler'];

/** The declarations of a kernel's bindings, all in group 0, numbered in order. */
export function bindingModule(
  kernel: string,
  names: readonly ResourceName[],
  extra: readonly SceneBinding[],
  flags: Flags,
): WgslModule {
  const lines = names.map((name, index) => {
    const { type, space } = RESOURCES[name] as Resource;
    const qualifier =
      space === 'uniform'
        ? '<uniform>'
        : space === 'read'
          ? '<storage, read>'
          : space === 'read_write'
            ? '<storage, read_write>'
            : '';
    return `@group(0) @binding(${index}) var${qualifier} ${name}: ${type};`;
  });
  extra.forEach(([name, kind], index) => {
    lines.push(
      `@group(0) @binding(${names.length + index}) var ${name}: ${kind === 'sampler' ? 'sampler' : 'texture_2d_array<f32>'};`,
    );
  });
  const structs = names.flatMap((name) => {
    const { deps = [], layout } = RESOURCES[name] as Resource;
    return layout ? [...deps, layout(flags).module] : deps;
  });
  return wgslModule(`renderer/${kernel}-bindings`, lines.join('\n'), structs);
}

/** The bind group layout that matches {@link bindingModule}. */
export function bindGroupLayout(
  device: GPUDevice,
  kernel: string,
  names: readonly ResourceName[],
  extra: readonly SceneBinding[],
): GPUBindGroupLayout {
  const entries: GPUBindGroupLayoutEntry[] = names.map((name, binding) => ({
    binding,
    visibility: GPU_STAGE_COMPUTE,
    ...layoutEntry((RESOURCES[name] as Resource).space),
  }));
  extra.forEach(([, kind], index) =>
    entries.push({ binding: names.length + index, visibility: GPU_STAGE_COMPUTE, ...layoutEntry(kind) }),
  );
  return device.createBindGroupLayout({ label: `glanz ${kernel}`, entries });
}

function layoutEntry(space: Resource['space']): Omit<GPUBindGroupLayoutEntry, 'binding' | 'visibility'> {
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
    case 'sampler':
      return { sampler: { type: 'filtering' } };
  }
}
