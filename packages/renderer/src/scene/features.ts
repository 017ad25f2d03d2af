import { requiredFeatures } from '@glanz/openpbr';
import type { Instance, Material, Scene } from '@glanz/scene';
import type { KernelFeatures } from '../integrator/pipelines';
import type { BackFaceCulling, LightGroupMode, Sampler } from '../options';
import { isOneSided } from '../geometry/culling';
import { missingMeshes } from '../geometry/prepare-geometry';
import { isShown } from '../geometry/placement';
import { hasFlatInterfaces } from '../materials/flat-interfaces';
import { interiorFlags } from '../materials/interiors';
import { lightGroupTable } from '../lights/light-groups';
import { hasSize } from '../lights/light-records';
import type { LightSampling } from '../lights/lights';
import { MaterialUse } from '../materials/material-use';
import {
  emittedRadiance,
  hasCoatFrames,
  hasRanges,
  isOpaque,
  texturedParameters,
  turnsTangent,
  usedTextures,
  type TexturedParameterInfo,
} from '../materials/materials';
import { parametersOf } from '../materials/parameters';
import type { Pages } from '../storage/paged/pages';
import { compressedFormats, planTextures, type TexturePlan } from '../materials/textures';

/** Options that decide the kernels' text. */
export interface SceneChoices {
  readonly multipleScattering: boolean;
  readonly sampler: Sampler;
  readonly lightGroups: LightGroupMode;
  readonly lightSampling: LightSampling;
  readonly shadowTerminator: 'smooth' | 'faceted';
  readonly backFaceCulling: BackFaceCulling;
  /** Paths that a guide learns from, in millions; 0: there is none. */
  readonly guiding: number;
  /** Light by way of these is guided. Chosen when the tracer is created: edits do not change it. */
  readonly panes?: readonly Instance[];
  /** Holds the arrays of shapes that are too large for buffers. */
  readonly pages?: Pages | undefined;
  /** Writes the shapes, where they are compact. */
  readonly compact?: unknown;
}

/** The properties of a scene that decide which kernels it needs. */
export interface SceneFacts {
  readonly textured: readonly TexturedParameterInfo[];
  readonly plan: TexturePlan;
  /** Number of light groups. */
  readonly groups: number;
  /** Whether there are any besides the environment. */
  readonly lights: boolean;
  readonly tree: boolean;
  readonly profiles: boolean;
  readonly areaLights: boolean;
  readonly environmentMap: boolean;
  readonly environmentSampled: boolean;
  readonly vertexColors: boolean;
  readonly catchers: boolean;
  readonly isOpaque: (material: number) => boolean;
  /** Whether a visible instance has the material. */
  readonly isVisible: (material: number) => boolean;
}

/** What decides the kernels' text. */
export function sceneFeatures(scene: Scene, choices: SceneChoices, facts: SceneFacts): KernelFeatures {
  const { textured, plan, lights, environmentSampled } = facts;
  const parameters = scene.materials.map((material) => parametersOf(material));
  const names = textured.map(({ name }) => name);
  const visible = scene.materials.flatMap((material, index) =>
    facts.isVisible(index) ? [{ material, opaque: facts.isOpaque(index) }] : [],
  );
  const culled =
    choices.backFaceCulling !== 'off' && visible.some(({ material, opaque }) => isOneSided(material, opaque));
  const openpbrFlags = requiredFeatures(parameters, {
    textured: names,
    multipleScattering: choices.multipleScattering,
  });
  return {
    flags: {
      ...openpbrFlags,
      TEXTURES: textured.length > 0,
      NORMAL_MAP: names.includes('geometry_normal'),
      TEXTURE_RANGES: hasRanges(scene.materials),
      TANGENT_MAP: openpbrFlags.OPENPBR_ANISOTROPY && turnsTangent(scene.materials),
      // Where the mesh has no tangents, they follow the texture coordinates.
      UV_FRAME:
        openpbrFlags.OPENPBR_ANISOTROPY || names.includes('geometry_normal') || names.includes('geometry_coat_normal'),
      OPENPBR_COAT_FRAME: hasCoatFrames(scene.materials),
      // A coat dims what is emitted below it; vertex colours paint what only emits.
      EMISSION_TEXTURES:
        names.some(
          (name) =>
            name === 'emission_color' ||
            name === 'emission_luminance' ||
            (openpbrFlags.OPENPBR_COAT && name.startsWith('coat_')),
        ) ||
        (facts.vertexColors &&
          parameters.some((p) => p.emission_luminance > 0 && p.base_weight === 0 && p.specular_weight === 0)),
      VERTEX_COLORS: facts.vertexColors,
      OPACITY: visible.some(({ opaque }) => !opaque),
      CULLING: culled,
      CULLING_ALL: culled && choices.backFaceCulling === 'all',
      ENVIRONMENT_MAP: facts.environmentMap,
      ENVIRONMENT_SAMPLED: environmentSampled,
      LIGHTS: lights,
      LIGHT_TREE: facts.tree,
      LIGHT_PROFILES: facts.profiles,
      AREA_LIGHTS: facts.areaLights,
      CATCHER: facts.catchers,
      LIGHT_GROUPS: choices.lightGroups !== 'off',
      NEXT_EVENT: lights || environmentSampled,
      PANES: (choices.panes?.length ?? 0) > 0 && environmentSampled,
      ...interiorFlags(scene.materials),
      REFRACTED_LIGHT: hasFlatInterfaces(scene),
      TERMINATOR_LIFT:
        choices.shadowTerminator === 'smooth' && scene.meshes.some(({ normals }) => normals !== undefined),
      SOBOL: choices.sampler !== 'independent',
      SCREEN_NOISE: choices.sampler === 'blue-noise',
    },
    samplings: plan.samplings,
    textured,
    textureCount: plan.arrays.length,
    samplerCount: plan.samplers.length,
    lightPasses: facts.groups * (facts.catchers ? 4 : 1),
    pages: choices.pages?.names,
    compact: !!choices.compact,
  };
}

/** Textures that shading always binds besides the scene's own: environment, its table, two energy tables. */
const OWN_TEXTURES = 4;

/** How the scene's textures lie in those that kernels can bind. */
export function texturePlan(
  device: GPUDevice,
  scene: Scene,
  { guiding, panes, pages }: Pick<SceneChoices, 'guiding' | 'panes' | 'pages'>,
): TexturePlan {
  return planTextures(
    scene,
    usedTextures(scene.materials),
    device.limits.maxSampledTexturesPerShaderStage -
      OWN_TEXTURES -
      (guiding > 0 || (panes?.length ?? 0) > 0 ? 1 : 0) -
      (pages?.names.length ?? 0),
    device.limits,
    compressedFormats(device),
  );
}

/**
 * What {@link sceneFeatures} will most likely say, before anything has been built: kernels compile while the
 * hierarchies are made. Where it is wrong (a light without power, an image of one radiance), nothing is lost but
 * that work.
 */
export function expectedFeatures(device: GPUDevice, scene: Scene, choices: SceneChoices): KernelFeatures {
  const use = new MaterialUse(scene);
  const glows = (material: Material, index: number) =>
    use.isVisible(index) && emittedRadiance(parametersOf(material)).some((value) => value > 0);
  const lights = scene.lights.length > 0 || scene.materials.some(glows);
  const { environment } = scene;
  return sceneFeatures(scene, choices, {
    textured: texturedParameters(scene.materials),
    plan: texturePlan(device, scene, choices),
    groups: lightGroupTable(scene, choices.lightGroups).names.length,
    lights,
    tree: lights && choices.lightSampling === 'tree',
    profiles: scene.lights.some(({ type }) => type === 'profile'),
    areaLights: scene.lights.some(hasSize),
    environmentMap: environment?.type === 'latlong',
    environmentSampled: environment?.type === 'latlong' && (environment.intensity ?? 1) > 0,
    vertexColors: missingMeshes(scene, []).some((mesh) => scene.meshes[mesh]?.colors),
    catchers: scene.instances.some((instance) => instance.catcher && isShown(scene, instance)),
    isOpaque: (material) => isOpaque(scene.materials[material] as Material, use.hasVertexAlpha(material)),
    isVisible: (material) => use.isVisible(material),
  });
}
