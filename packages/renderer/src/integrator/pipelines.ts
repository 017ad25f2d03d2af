import { bvhAnyHit, bvhClosestHit, bvhOffset } from '@glanz/bvh/wgsl';
import { openpbr, openpbrMedium, openpbrPhase, openpbrSubsurface } from '@glanz/openpbr';
import { beginShaderModule, compose, wgslModule, type ComposedWgsl, type WgslModule } from '@glanz/wgsl';
import { DeviceError } from '../errors';
import { inErrorScopes, lossOr } from '../device/error-scopes';
import type { TexturedParameterInfo } from '../materials/materials';
import type { Sampling } from '../materials/textures';
import advance from './advance.wesl';
import begin from './begin.wesl';
import camera from '../camera/camera.wesl';
import filterOffset from '../camera/filter.wesl';
import connect from './connect.wesl';
import { aovBuffers } from '../film/aovs';
import pathAov from '../path/path_aov.wesl';
import { pathLayout } from '../path/path-layout';
import energyHost from '../materials/energy.wesl';
import firstLight from './first_light.wesl';
import generate from './generate.wesl';
import intersect from './intersect.wesl';
import media from '../materials/media.wesl';
import mediaFront from '../materials/media_front.wesl';
import areaLightGathering from '../lights/area_light_gathering.wesl';
import lights from '../lights/lights.wesl';
import {
  bindGroupLayouts,
  bindingModule,
  kernelBindings,
  type KernelBindings,
  type ResourceName,
  type SceneBinding,
} from '../storage/resources';
import type { ShapeArray } from '../storage/shape-arrays';
import instances from '../storage/instances.wesl';
import random from '../random/random.wesl';
import resolve from '../film/resolve.wesl';
import shade from './shade.wesl';
import deltaTransmission from '../materials/delta_transmission.wesl';
import { materialCases } from '../materials/material-cases';
import surface from '../materials/surface.wesl';
import traversal from '../geometry/traversal.wesl';

/** What about a scene decides the text of its kernels. Two scenes with equal features share pipelines. */
export interface KernelFeatures {
  readonly flags: Readonly<Record<string, boolean>>;
  readonly samplings: readonly Sampling[];
  readonly textured: readonly TexturedParameterInfo[];
  readonly textureCount: number;
  readonly samplerCount: number;
  /** Sums of light that the film keeps apart: the number of light groups, four times that with catchers. */
  readonly lightPasses: number;
  /** Arrays that lie in textures. */
  readonly pages?: readonly ShapeArray[] | undefined;
  /** Whether shapes are compact. */
  readonly compact?: boolean | undefined;
}

/** Kernels with these flags do what those without do, only slower: a lobe of weight 0, a filter that accepts. */
const HARMLESS =
  /^(OPENPBR_|OPACITY$|CULLING$|CULLING_ALL$|VERTEX_COLORS$|EMISSION_TEXTURES$|LIGHTS$|LIGHT_TREE$|LIGHT_PROFILES$|AREA_LIGHTS$|NEXT_EVENT$|DISPERSION$|TERMINATOR_LIFT$)/;

/**
 * Whether kernels for `present` features render `wanted` ones too: they may contain features that the scene no longer
 * has, so that a coat that comes and goes is compiled once.
 */
export function serves(present: KernelFeatures, requested: KernelFeatures): boolean {
  const { flags: has, ...given } = present;
  const { flags: needs, ...asked } = requested;
  if (JSON.stringify(given) !== JSON.stringify(asked)) return false;
  return Object.entries(needs).every(
    ([name, value]) =>
      has[name] === value || (has[name] === true && HARMLESS.test(name) && name !== 'OPENPBR_MULTISCATTER'),
  );
}

/** In the order in which they are compiled: `shade` takes longest, and has the others' time too. */
export const KERNELS = [
  'shade',
  'generate',
  'begin',
  'intersect',
  'advance',
  'connect',
  'resolve',
  'aov',
  'aov_ids',
  'relight',
  'noise',
  'variance',
  'first',
  'light_begin',
  'light_start',
  'light_trace',
  'reservoirs',
] as const;
export type KernelName = (typeof KERNELS)[number];

/** A compiled kernel and what it binds. */
export interface Kernel {
  readonly pipeline: GPUComputePipeline;
  /** Its bind groups, and the layout of each. */
  readonly groups: KernelBindings;
  readonly layouts: readonly GPUBindGroupLayout[];
}

/** In place of the entry points that are loaded later, see `FILM_KERNELS`. */
const FILM_KERNEL = wgslModule('renderer/film-kernel', '');

interface KernelText {
  /** The module with the entry point. */
  readonly root: WgslModule;
  /** The modules that depend on the scene and define what the `host.wesl` files declare. */
  readonly host?: readonly (WgslModule | false | undefined)[];
  readonly resources: readonly ResourceName[];
  readonly textures: boolean;
  /** Where they are not the scene's. */
  readonly flags?: Readonly<Record<string, boolean>>;
}

function kernelText(name: KernelName, features: KernelFeatures): KernelText {
  const { flags } = features;
  const cases = flags.TEXTURES && materialCases(features.samplings, features.textured, flags);
  const surfaces = [bvhOffset, cases, openpbr, energyHost];
  const query = (bvhQuery: WgslModule, chosen = flags) => [bvhQuery, traversal, chosen.OPACITY && cases];
  const interiors = [media, openpbrMedium, ...(flags.OPENPBR_SUBSURFACE ? [openpbrSubsurface, energyHost] : [])];
  const filter: ResourceName[] = flags.OPACITY
    ? ['frame', 'batch', 'attributes', 'materials']
    : flags.CATCHER
      ? ['frame', 'batch']
      : [];
  const culling: ResourceName[] = [
    ...(flags.CULLING ? (['materials'] as const) : []),
    ...(flags.CULLING_ALL ? (['frame'] as const) : []),
  ];
  const energy: ResourceName[] = ['energy_dielectric', 'energy_conductor', 'energy_sampler'];
  // What subsurface scatters depends on how its surface reflects.
  const walking: ResourceName[] = flags.OPENPBR_SUBSURFACE ? energy : [];
  const recording: ResourceName[] = flags.AOVS ? ['aov_batch'] : [];
  const { module: path, lightPasses } = pathLayout(features);
  const filmBuffers: ResourceName[] = [
    'film_block',
    'film_total',
    'film_moment',
    'beauty',
    ...(flags.LIGHT_GROUPS ? (['light_groups'] as const) : []),
  ];
  const lit: ResourceName[] = ['attributes', 'lights', 'environment', 'environment_table', ...energy];
  const scene: ResourceName[] = ['triangles', 'instances', 'attributes', 'materials'];
  switch (name) {
    case 'generate':
      return {
        root: generate,
        host: [path],
        resources: ['frame', 'batch', 'paths', 'queues', 'film_pixels', ...recording],
        textures: false,
      };
    case 'begin':
    case 'light_begin':
      return { root: begin, resources: ['batch', 'queues', 'dispatch'], textures: false };
    case 'advance':
      return { root: advance, resources: ['queues', 'dispatch'], textures: false };
    case 'intersect': {
      const resources = [
        ...new Set([
          ...filter,
          ...(flags.SCATTERING ? (['frame', 'batch'] as const) : []),
          ...(flags.AREA_LIGHTS ? (['frame', 'lights'] as const) : []),
          ...culling,
          ...(flags.MEDIA ? (['materials'] as const) : []),
          ...walking,
          ...(flags.REFRACTED_LIGHT ? lit : []),
        ]),
      ];
      return {
        root: intersect,
        host: [
          path,
          ...query(bvhClosestHit),
          flags.AREA_LIGHTS && areaLightGathering,
          ...(flags.MEDIA ? interiors : []),
          flags.SCATTERING && openpbrPhase,
          ...(flags.REFRACTED_LIGHT ? [lights, ...surfaces] : []),
        ],
        resources: [...resources, 'paths', 'queues', 'nodes', 'triangles', 'instances'],
        textures: flags.OPACITY === true || flags.REFRACTED_LIGHT === true,
      };
    }
    case 'connect': {
      // Light meets all faces that are there for others than the camera alone.
      const shadowFlags = { ...flags, CULLING: flags.CULLING_ALL === true };
      const walls: ResourceName[] = flags.DELTA_TRANSMISSION ? ['frame', 'attributes', ...energy] : [];
      const resources = [
        ...new Set([
          ...filter,
          ...(flags.CULLING_ALL ? culling : []),
          ...(flags.NULL_SURFACES ? (['materials'] as const) : []),
          ...(flags.NULL_SURFACES ? walking : []),
          ...walls,
        ]),
      ];
      return {
        root: connect,
        host: [
          path,
          ...query(flags.NULL_SURFACES ? bvhClosestHit : bvhAnyHit, shadowFlags),
          ...(flags.NULL_SURFACES ? [...interiors, mediaFront] : []),
          ...(flags.DELTA_TRANSMISSION ? [deltaTransmission, ...surfaces] : []),
        ],
        resources: [...resources, 'paths', 'queues', 'shadows', 'nodes', 'triangles', 'instances'],
        textures: flags.OPACITY === true || flags.DELTA_TRANSMISSION === true,
        flags: shadowFlags,
      };
    }
    case 'shade':
    case 'light_start':
    case 'light_trace':
    case 'reservoirs':
      return {
        root: shade,
        host: [path, surface, lights, ...surfaces],
        resources: [
          'frame',
          'batch',
          'paths',
          'queues',
          'shadows',
          ...scene,
          ...lit,
          ...recording,
          ...(flags.GUIDE ? (['guide'] as const) : []),
        ],
        textures: true,
      };
    case 'resolve':
      return {
        root: resolve,
        host: [path, lightPasses],
        resources: ['batch', 'paths', 'queues', 'film_pixels', ...filmBuffers],
        textures: false,
      };
    case 'aov':
      return {
        root: FILM_KERNEL,
        host: [path, pathAov, ...(flags.AOV_POSITION ? [camera, filterOffset, random] : [])],
        resources: [
          ...(flags.AOV_POSITION ? (['frame'] as const) : []),
          'batch',
          'paths',
          'film_pixels',
          ...recording,
          ...aovBuffers(flags).filter((buffer) => buffer !== 'aov_ids' && buffer !== 'aov_motion'),
        ],
        textures: false,
      };
    case 'aov_ids':
      return {
        root: FILM_KERNEL,
        host: [path, pathAov, filterOffset, random, instances, flags.AOV_MOTION && camera],
        resources: [
          'frame',
          'batch',
          'paths',
          'film_pixels',
          'instances',
          ...recording,
          'aov_ids',
          ...(flags.AOV_MOTION ? (['aov_motion', 'history', 'history_moves'] as const) : []),
        ],
        textures: false,
      };
    case 'relight':
      return { root: FILM_KERNEL, host: [lightPasses], resources: ['batch', ...filmBuffers], textures: false };
    case 'noise':
      return {
        root: FILM_KERNEL,
        host: [lightPasses],
        resources: ['frame', ...filmBuffers, 'film_noise'],
        textures: false,
      };
    case 'variance':
      return {
        root: FILM_KERNEL,
        host: [lightPasses],
        resources: ['batch', ...filmBuffers, 'film_variance'],
        textures: false,
      };
    case 'first': {
      const firstFlags = { ...flags, OPACITY: false, CATCHER: false };
      // Neither opacity nor catchers: they would bring half of the renderer.
      return {
        root: firstLight,
        host: query(bvhClosestHit, firstFlags),
        resources: ['frame', 'batch', 'nodes', 'triangles', 'instances', 'materials', 'beauty'],
        textures: false,
        flags: firstFlags,
      };
    }
  }
}

/** What one kernel binds for a scene's features. */
export function bindingsOf(name: KernelName, features: KernelFeatures): KernelBindings {
  const { resources, textures } = kernelText(name, features);
  return kernelBindings(resources, textures ? sceneBindings(features) : []);
}

const sceneBindings = ({ textureCount, samplerCount }: KernelFeatures): SceneBinding[] => [
  ...Array.from({ length: textureCount }, (_, i) => [`scene_texture_${i}`, 'texture_2d_array'] as const),
  ...Array.from({ length: samplerCount }, (_, i) => [`scene_sampler_${i}`, 'sampler'] as const),
];

/** A kernel before it is compiled. Kernels of equal `key` are the same, whatever scenes they were composed for. */
export interface KernelSource {
  readonly key: string;
  /**
   * @throws {ShaderError} with module and line if the text does not compile, {DeviceError} `renderer/gpu-error` if the
   * pipeline is refused.
   */
  readonly compile: (device: GPUDevice) => Promise<Kernel>;
}

/** What is loaded later of a kernel's text: its entry point, more of what it calls, other resources. */
export interface KernelParts extends Partial<Pick<KernelText, 'root' | 'host' | 'resources'>> {
  /** Resources besides its own. */
  readonly more?: readonly ResourceName[];
  /** Modules in place of others. */
  readonly swap?: (module: WgslModule) => WgslModule;
  /** Bindings in place of others. */
  readonly bind?: (groups: KernelBindings) => KernelBindings;
  /** The program in place of the one that was composed, line by line. */
  readonly rewrite?: (program: ComposedWgsl) => string;
}

/**
 * The text of one kernel for a scene's features.
 *
 * @param parts In place of its own, for those of `FILM_KERNELS`, or added to it.
 * @param strided Whether kernels of paths loop over the queue in strides of the grid, for any number of workgroups
 *   (`GRID_STRIDE`); otherwise they need a thread for each path.
 */
export function kernelSource(
  name: KernelName,
  features: KernelFeatures,
  parts: KernelParts = {},
  strided = false,
): KernelSource {
  const own = kernelText(name, features);
  const text = { ...own, ...parts, host: [...(own.host ?? []), ...(parts.host ?? [])] };
  const chosen = text.flags ?? features.flags;
  const flags = {
    ...chosen,
    BVH_FILTER: chosen.OPACITY === true || chosen.CULLING === true,
    PASSES: features.lightPasses > 1,
    GRID_STRIDE: strided,
  };
  const bound = kernelBindings(
    [...text.resources, ...(parts.more ?? [])],
    text.textures ? sceneBindings(features) : [],
  );
  const groups = parts.bind?.(bound) ?? bound;
  const bindings = bindingModule(name, groups, flags);
  const host = text.host.filter((module) => !!module);
  const { swap = (module) => module } = parts;
  const composed = compose([bindings, ...host, text.root].map(swap), { flags });
  const shader = { ...composed, code: parts.rewrite?.(composed) ?? composed.code };
  return {
    key: `${name}\n${shader.code}`,
    async compile(device) {
      const { result, verified } = inErrorScopes(device, `the kernel "${name}"`, () => {
        const layouts = bindGroupLayouts(device, name, groups);
        const { module, checked } = beginShaderModule(device, shader, `glanz ${name}`);
        // Asked for at once, so that the driver works while the next kernel's text is read.
        const compiled = device.createComputePipelineAsync({
          label: `glanz ${name}`,
          layout: device.createPipelineLayout({ label: `glanz ${name}`, bindGroupLayouts: layouts }),
          compute: { module, entryPoint: 'main' },
        });
        compiled.catch(() => {});
        return { layouts, checked, compiled };
      });
      const { layouts, checked, compiled } = result;
      await checked;
      await verified;
      try {
        return { pipeline: await compiled, groups, layouts };
      } catch (cause) {
        throw await lossOr(
          device,
          new DeviceError('renderer/gpu-error', `The GPU refused the kernel "${name}": ${(cause as Error).message}`, {
            cause,
          }),
        );
      }
    },
  };
}
