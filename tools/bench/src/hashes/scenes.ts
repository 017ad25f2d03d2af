import { createCornellBox, createPushButton } from '@glanz/models';
import type { AovName, FilmLayer, PathTracerOptions } from '@glanz/renderer';
import { RENDER_OPTIONS } from '@glanz/renderer/options';
import { createScene, frameCamera, type Light, type Material, type Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { addTexture, image, place, sphere, square, translation } from './shapes';

/** A scene whose film is hashed. */
export interface HashCase {
  readonly name: string;
  readonly scene: () => Scene | Promise<Scene>;
  readonly options?: Partial<Omit<PathTracerOptions, 'width' | 'height'>>;
  /** Layers that are hashed besides the beauty. */
  readonly layers?: readonly FilmLayer[];
  /** Samples are added until there is this little noise, in place of a fixed number. */
  readonly noise?: number;
  /** The strength that every light group is set to after the samples. */
  readonly relight?: number;
}

const ALL_LAYERS: readonly FilmLayer[] = [
  'variance',
  'albedo',
  'normal',
  'position',
  'depth',
  'objectId',
  'materialId',
];

type Parameters = Material['parameters'];

/** Two spheres on a plane under the studio environment: the second sphere has OpenPBR's default material. */
function stage(parameters: Parameters, change: (scene: Scene, material: Material) => void = () => {}): Scene {
  const scene = createScene();
  const material: Material = { name: 'subject', parameters };
  const ground: Material = { name: 'ground', parameters: { base_color: [0.5, 0.45, 0.4], specular_weight: 0 } };
  place(scene, sphere(), material, translation(-0.7, 1, 0));
  place(scene, sphere(12), { name: 'other', parameters: {} }, translation(1.3, 1, -0.6));
  place(scene, square(), ground, [4, 0, 0, 0, 0, 0, -4, 0, 0, 4, 0, 0, 0, 0, 0, 1]);
  scene.environment = studioEnvironment();
  scene.cameras.push({ type: 'perspective', name: 'camera', transform: translation(0, 1.2, 6), yfov: 0.6 });
  change(scene, material);
  return scene;
}

/** The stage without an environment, under lights. */
const lit =
  (...lights: readonly Light[]): (() => Scene) =>
  () =>
    stage({}, (scene) => {
      delete scene.environment;
      scene.lights.push(...lights);
    });

/** The stage with one of its parameters driven by a texture. */
const textured =
  (parameters: Parameters, textures: (scene: Scene) => NonNullable<Material['textures']>): (() => Scene) =>
  () =>
    stage(parameters, (scene, material) => {
      material.textures = textures(scene);
    });

const checks = (scene: Scene, colorSpace: 'srgb' | 'linear' = 'linear') =>
  addTexture(
    scene,
    image('checks', 16, (x, y) => (((x >> 2) + (y >> 2)) % 2 ? [230, 180, 40, 255] : [60, 90, 200, 120])),
    colorSpace,
  );

const bumps = (scene: Scene) =>
  addTexture(
    scene,
    image('bumps', 16, (x, y) => [128 + 40 * Math.sin(x), 128 + 40 * Math.cos(y), 240, 255]),
    'linear',
  );

const glass: Parameters = { transmission_weight: 1, specular_roughness: 0.1 };
const white = [1, 1, 1] as const;
const area = { color: white, position: [0, 3, 1], direction: [0, -1, 0], intensity: 4 } as const;
const view = translation(0, 1.2, 6);
const material = (name: string, parameters: Parameters): HashCase => ({
  name: `material ${name}`,
  scene: () => stage(parameters),
});

const MATERIALS: readonly HashCase[] = [
  { name: 'material default', scene: () => stage({}), layers: ALL_LAYERS },
  material('rough diffuse', { base_diffuse_roughness: 0.7, specular_weight: 0 }),
  material('metal', { base_metalness: 1, base_color: [0.9, 0.6, 0.3], specular_roughness: 0.4 }),
  material('anisotropic metal', { base_metalness: 1, specular_roughness: 0.5, specular_roughness_anisotropy: 0.8 }),
  material('anisotropic gloss', { specular_roughness: 0.5, specular_roughness_anisotropy: 0.6, coat_weight: 0.5 }),
  material('haze on metal', { base_metalness: 1, specular_roughness: 0, specular_haze: 0.4 }),
  material('retroreflection below a coat', { specular_retroreflectivity: 0.7, coat_weight: 0.5, specular_haze: 0.2 }),
  material('coat', { coat_weight: 1, coat_color: [0.9, 0.5, 0.4], coat_roughness: 0.2 }),
  {
    name: 'material coat with its own normal',
    scene: textured({ coat_weight: 1 }, (scene) => ({
      geometry_coat_normal: { texture: bumps(scene), channels: 'rgb' },
    })),
  },
  material('fuzz', { fuzz_weight: 0.8, fuzz_color: [0.4, 0.6, 0.9], fuzz_roughness: 0.5 }),
  material('thin film', { thin_film_weight: 1, thin_film_thickness: 0.45, specular_roughness: 0.2 }),
  material('emission', {
    emission_luminance: 2,
    emission_color: [1, 0.7, 0.3],
    coat_weight: 0.5,
    coat_color: [0.5, 0.8, 0.9],
  }),
  material('glass', glass),
  material('smooth glass', {
    transmission_weight: 1,
    specular_roughness: 0,
    transmission_color: [0.8, 0.9, 0.7],
    transmission_depth: 1,
  }),
  material('glass near the index of air', { transmission_weight: 1, specular_roughness: 0.3, specular_ior: 1.02 }),
  material('gloss below the index of air', {
    specular_ior: 0.8,
    specular_roughness: 0.3,
    coat_weight: 0.5,
    coat_ior: 0.9,
  }),
  material('dispersion', { ...glass, transmission_dispersion_scale: 1, transmission_dispersion_abbe_number: 20 }),
  material('hazy glass', { ...glass, specular_haze: 0.5, specular_haze_spread: 0.5, specular_retroreflectivity: 0.2 }),
  material('milk', {
    ...glass,
    transmission_depth: 0.5,
    transmission_scatter: [0.9, 0.8, 0.7],
    transmission_color: [0.9, 0.9, 0.8],
  }),
  material('milk behind smooth glass', {
    ...glass,
    specular_roughness: 0,
    transmission_depth: 0.5,
    transmission_scatter: [0.9, 0.8, 0.7],
  }),
  material('fog', {
    transmission_weight: 1,
    specular_ior: 1,
    transmission_depth: 1,
    transmission_scatter: [0.5, 0.5, 0.5],
  }),
  material('subsurface', { subsurface_weight: 0.8, subsurface_color: [0.9, 0.5, 0.4], subsurface_radius: 0.2 }),
  material('thin wall', { transmission_weight: 1, geometry_thin_walled: true, specular_roughness: 0 }),
  material('rough thin wall', { transmission_weight: 0.8, geometry_thin_walled: true, specular_roughness: 0.4 }),
  material('thin subsurface', { subsurface_weight: 0.9, geometry_thin_walled: true, base_diffuse_roughness: 0.3 }),
  material('glass with a film and a coat', {
    ...glass,
    thin_film_weight: 1,
    thin_film_thickness: 0.3,
    coat_weight: 0.7,
    coat_roughness: 0.2,
  }),
  material('metal with all layers', {
    base_metalness: 0.5,
    coat_weight: 0.5,
    fuzz_weight: 0.3,
    thin_film_weight: 0.5,
    specular_roughness: 0.3,
  }),
  {
    name: 'material single scattering',
    scene: () => stage({ base_metalness: 0.5, specular_roughness: 0.6 }),
    options: { multipleScattering: false },
  },
  {
    name: 'material metal alone, single scattering',
    scene: () =>
      stage({ base_metalness: 1, specular_roughness: 0.4 }, (scene) => {
        for (const one of scene.materials)
          one.parameters = { ...one.parameters, base_metalness: 1, specular_weight: 1 };
      }),
    options: { multipleScattering: false },
  },
  {
    name: 'material glass in glass',
    scene: () =>
      stage(glass, (scene, outer) => {
        outer.dielectric_priority = 1;
        place(
          scene,
          sphere(12),
          { name: 'inner', parameters: { transmission_weight: 1, specular_ior: 1.3 }, dielectric_priority: 2 },
          translation(-0.4, 1, 0),
        );
      }),
  },
];

const SURFACES: readonly HashCase[] = [
  {
    name: 'texture of the base colour',
    scene: textured({}, (scene) => ({
      base_color: { texture: checks(scene, 'srgb'), channels: 'rgb', transform: [3, 0, 0, 2, 0.1, 0.2] },
    })),
  },
  {
    name: 'texture of the roughness with a range',
    scene: textured({ base_metalness: 1 }, (scene) => ({
      specular_roughness: { texture: checks(scene), channels: 'g', range: [0.1, 0.9] },
      base_metalness: { texture: checks(scene), channels: 'b' },
    })),
  },
  {
    name: 'texture of the normal',
    scene: textured({}, (scene) => ({ geometry_normal: { texture: bumps(scene), channels: 'rgb', scale: 0.7 } })),
  },
  {
    name: 'texture of the tangent',
    scene: textured({ specular_roughness_anisotropy: 0.7, specular_roughness: 0.4 }, (scene) => ({
      geometry_tangent: { texture: bumps(scene), channels: 'rgb' },
    })),
  },
  {
    name: 'texture of the emission',
    scene: textured({ emission_luminance: 3 }, (scene) => ({
      emission_color: { texture: checks(scene, 'srgb'), channels: 'rgb' },
    })),
  },
  {
    name: 'texture of the opacity',
    scene: textured({}, (scene) => ({ geometry_opacity: { texture: checks(scene), channels: 'a' } })),
    layers: ALL_LAYERS,
  },
  { name: 'opacity', scene: () => stage({ geometry_opacity: 0.4 }) },
  {
    name: 'opacity with a threshold',
    scene: () =>
      stage({}, (scene, subject) => {
        subject.textures = { geometry_opacity: { texture: checks(scene), channels: 'a' } };
        subject.opacity_threshold = 0.5;
      }),
    options: { backFaceCulling: 'camera' },
  },
  {
    name: 'vertex colours',
    scene: () =>
      stage({}, (scene) => {
        const mesh = scene.meshes[0]!;
        mesh.colors = Float32Array.from({ length: (mesh.positions.length / 3) * 4 }, (_, i) =>
          i % 4 === 3 ? 1 : 0.2 + 0.7 * Math.abs(Math.sin(i)),
        );
      }),
  },
  {
    name: 'culling for the camera',
    scene: () => createCornellBox(),
    options: {
      backFaceCulling: 'camera',
      camera: { type: 'perspective', name: 'outside', transform: translation(0.28, 0.28, 3), yfov: 0.4 },
    },
  },
  { name: 'culling for all rays', scene: () => createCornellBox(), options: { backFaceCulling: 'all' } },
  { name: 'faceted shadow terminator', scene: () => stage({}), options: { shadowTerminator: 'faceted' } },
  {
    name: 'catcher',
    scene: () =>
      stage({}, (scene) => {
        scene.instances[2]!.catcher = true;
      }),
    options: { background: 'transparent' },
  },
  {
    name: 'catcher with soft shadows',
    scene: () =>
      stage({}, (scene) => {
        scene.instances[2]!.catcher = true;
      }),
    options: { background: 'transparent', shadowSoftness: 0.5 },
  },
];

const LIGHTS: readonly HashCase[] = [
  {
    name: 'light from a point',
    scene: lit({ type: 'point', name: 'point', color: white, intensity: 20, position: [0, 3, 2] }),
  },
  {
    name: 'lights of four kinds',
    scene: lit(
      {
        type: 'spot',
        name: 'spot',
        color: [1, 0.8, 0.6],
        intensity: 40,
        position: [2, 3, 2],
        direction: [-0.5, -0.7, -0.5],
        inner_cone_angle: 0.2,
        outer_cone_angle: 0.6,
      },
      { type: 'directional', name: 'sun', color: white, intensity: 1, direction: [0.3, -0.9, -0.3] },
      {
        type: 'profile',
        name: 'profile',
        color: white,
        intensity: 1,
        position: [-1, 3, 1],
        direction: [0, -1, 0],
        profile: {
          vertical: Float32Array.of(0, 0.5, 1.2),
          horizontal: Float32Array.of(0, 2),
          intensities: Float32Array.of(20, 10, 0, 15, 12, 2),
        },
      },
      { type: 'point', name: 'point', color: white, intensity: 5, position: [0, 3, 2] },
    ),
  },
  {
    name: 'light from a rectangle',
    scene: lit({ ...area, type: 'rectangle', name: 'rectangle', width: 1, height: 2 }),
  },
  {
    name: 'light from a disk and a sphere',
    scene: lit(
      { ...area, type: 'disk', name: 'disk', radius: 0.7 },
      { type: 'sphere', name: 'ball', color: white, intensity: 3, position: [-1, 3, 2], radius: 0.3, visible: false },
    ),
  },
  {
    name: 'lights by power',
    scene: lit(
      { ...area, type: 'disk', name: 'disk', radius: 0.7 },
      { type: 'point', name: 'point', color: white, intensity: 5, position: [0, 3, 2] },
    ),
    options: { lightSampling: 'power' },
  },
  {
    name: 'candidates for light samples',
    scene: lit(
      { ...area, type: 'disk', name: 'disk', radius: 0.7 },
      { type: 'point', name: 'point', color: white, intensity: 5, position: [0, 3, 2] },
    ),
    options: { lightCandidates: 4 },
  },
  {
    name: 'light groups',
    scene: () => stage({ emission_luminance: 1 }),
    options: { lightGroups: 'each' },
    relight: 0.5,
  },
  { name: 'a guide', scene: () => createCornellBox(), options: { guiding: 0.01 } },
  {
    name: 'light paths',
    scene: () => stage({ transmission_weight: 1, specular_roughness: 0 }),
    options: { lightPaths: 0.5 },
  },
  { name: 'light groups off', scene: () => createCornellBox(), options: { lightGroups: 'off' } },
  {
    name: 'constant environment',
    scene: () =>
      stage({}, (scene) => {
        scene.environment = { type: 'constant', radiance: [0.5, 0.6, 0.7] };
      }),
  },
];

const VIEWS: readonly HashCase[] = [
  {
    name: 'camera orthographic',
    scene: () => stage({}),
    options: { camera: { type: 'orthographic', name: 'o', transform: view, xmag: 2, ymag: 2 } },
  },
  {
    name: 'camera panorama',
    scene: () => stage({}),
    options: { camera: { type: 'panorama', name: 'p', transform: view } },
  },
  {
    name: 'camera with a round lens',
    scene: () => stage({}),
    options: {
      camera: { type: 'perspective', name: 'l', transform: view, yfov: 0.6, lens_radius: 0.2, focus_distance: 5 },
    },
  },
  {
    name: 'camera with blades',
    scene: () => stage({}),
    options: {
      camera: {
        type: 'perspective',
        name: 'b',
        transform: view,
        yfov: 0.6,
        lens_radius: 0.2,
        lens_blades: 6,
        focus_distance: 5,
      },
    },
  },
  { name: 'filter wide box', scene: () => stage({}), options: { filter: { type: 'box', radius: 1 } } },
  { name: 'filter gaussian', scene: () => stage({}), options: { filter: 'gaussian' } },
  { name: 'filter blackman-harris', scene: () => stage({}), options: { filter: 'blackman-harris' } },
  { name: 'sampler sobol', scene: () => stage({}), options: { sampler: 'sobol' } },
  { name: 'sampler independent', scene: () => stage({}), options: { sampler: 'independent' } },
  { name: 'adaptive samples', scene: () => stage({}), noise: 0.2 },
];

const BIASED: readonly HashCase[] = [
  { name: 'biased clamp', scene: () => stage(glass), options: { clampIndirect: 0.5 } },
  { name: 'biased regularization', scene: () => stage(glass), options: { regularization: 0.25 } },
  { name: 'biased without caustics', scene: () => stage(glass), options: { caustics: false } },
  {
    name: 'biased bounce limits',
    scene: () => stage(glass),
    options: { maxBounces: { diffuse: 1, specular: 2, transmission: 3 } },
  },
];

const AOVS = RENDER_OPTIONS.aovs.values;

const layersAlone = (name: string, layers: readonly AovName[], parameters: Parameters): HashCase => ({
  name: `AOVs ${name}`,
  scene: () => stage(parameters),
  options: { aovs: layers },
  layers,
});

const LAYERS: readonly HashCase[] = [
  {
    name: 'first-hit AOVs',
    scene: () => stage({ transmission_weight: 1, specular_roughness: 0 }),
    options: { aovs: AOVS },
    layers: AOVS,
  },
  // Fewer AOVs take fewer buffers and fewer words of a path: each set is a program of its own.
  layersAlone('albedo alone', ['albedo'], { ...glass, transmission_dispersion_scale: 1 }),
  layersAlone('albedo and normal, past fog', ['albedo', 'normal'], {
    transmission_weight: 1,
    specular_ior: 1,
    transmission_depth: 1,
    transmission_scatter: [0.5, 0.5, 0.5],
  }),
  layersAlone('position, in smooth glass', ['position', 'virtualDepth'], {
    transmission_weight: 1,
    specular_roughness: 0,
  }),
  layersAlone('ids, through a thin wall', ['objectId', 'materialId', 'roughness'], {
    transmission_weight: 1,
    geometry_thin_walled: true,
    specular_roughness: 0,
  }),
];

const MODELS: readonly HashCase[] = [
  { name: 'model Cornell box', scene: () => createCornellBox() },
  {
    name: 'model push-button',
    scene: () => {
      const scene = createPushButton({ level: 'low' });
      scene.environment = studioEnvironment();
      scene.cameras.push(frameCamera(scene, { aspect: 1 }));
      return scene;
    },
  },
];

/** Every flag of the kernels is on in at least one of these, and off in another where it can be; `hashes` checks it. */
export const HASH_CASES: readonly HashCase[] = [
  ...MATERIALS,
  ...SURFACES,
  ...LIGHTS,
  ...VIEWS,
  ...BIASED,
  ...LAYERS,
  ...MODELS,
];
