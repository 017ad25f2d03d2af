import type { Camera, PerspectiveCamera } from './camera';
import type { Environment } from './environment';
import { SceneError } from './error';
import type { Light, LightProfile } from './light';
import type { Material } from './material';
import type { Mesh } from './mesh';
import type { Instance, Scene } from './scene';
import { finish, STEP, type Steps } from './slices';
import { compressedBytes, type CompressedImage, type Image } from './texture';
import { fail, finite, finiteSteps, length, reference, textOf, type What } from './validate-values';

/** Checks the vertices that the triangles among the indices from `from` up to `end` refer to. */
function checkIndices({ positions, indices }: Mesh, from: number, end: number, what: string): void {
  const vertices = positions.length / 3;
  for (let i = from; i < end; i += 3) {
    const max = Math.max(indices[i] as number, indices[i + 1] as number, indices[i + 2] as number);
    if (max >= vertices)
      fail('reference', `${what}: triangle ${i / 3} refers to vertex ${max}; the mesh has ${vertices}.`);
  }
}

function* meshSteps(mesh: Mesh, index: number): Generator<void> {
  const what = `Mesh ${index} ("${mesh.name}")`;
  const { positions, indices } = mesh;
  if (positions.length % 3 !== 0)
    fail('length', `${what}: positions has ${positions.length} numbers; it must have three a vertex.`);
  if (indices.length % 3 !== 0)
    fail('length', `${what}: indices has ${indices.length} entries; it must have three a triangle.`);
  const vertices = positions.length / 3;
  yield* finiteSteps(positions, `${what}: positions`);
  for (let from = 0; from < indices.length; from += 3 * STEP) {
    checkIndices(mesh, from, Math.min(indices.length, from + 3 * STEP), what);
    yield;
  }
  const attributes: readonly (readonly [values: Float32Array | undefined, stride: number, name: string])[] = [
    [mesh.normals, 3, 'normals'],
    [mesh.tangents, 4, 'tangents'],
    [mesh.colors, 4, 'colors'],
    ...(mesh.uvs ?? []).map((uv, set) => [uv, 2, `uvs[${set}]`] as const),
  ];
  for (const [values, stride, name] of attributes) {
    if (!values) continue;
    length(values, stride * vertices, `${what}: ${name}`);
    yield* finiteSteps(values, `${what}: ${name}`);
  }
}

function checkMaterial(scene: Scene, material: Material, index: number): void {
  const what = `Material ${index} ("${material.name}")`;
  for (const [name, value] of Object.entries(material.parameters)) {
    if (typeof value === 'number') finite([value], `${what}: ${name}`);
    else if (Array.isArray(value)) finite(value as number[], `${what}: ${name}`);
  }
  const { dielectric_priority: priority = 0 } = material;
  if (!Number.isInteger(priority) || priority < 0 || priority > 255)
    throw new SceneError(
      'scene/value',
      `${what}: dielectric_priority is ${priority}; it must be a whole number from 0 to 255.`,
    );
  for (const [name, binding] of Object.entries(material.textures ?? {})) {
    if (!binding) continue;
    reference(binding.texture, scene.textures, `${what}: ${name}`, 'texture');
    if (binding.transform) {
      length(binding.transform, 6, `${what}: the transform of ${name}`);
      finite(binding.transform, `${what}: the transform of ${name}`);
    }
    if (binding.range) {
      length(binding.range, 2, `${what}: the range of ${name}`);
      finite(binding.range, `${what}: the range of ${name}`);
    }
  }
}

function checkTransform(transform: ArrayLike<number>, what: What): void {
  const own = () => `${textOf(what)}: transform`;
  length(transform, 16, own);
  finite(transform, own);
}

/** Of the linear part of a 4 × 4 matrix, column-major. */
export function determinant(m: ArrayLike<number>): number {
  const at = (k: number) => m[k] as number;
  return (
    at(0) * (at(5) * at(10) - at(6) * at(9)) -
    at(4) * (at(1) * at(10) - at(2) * at(9)) +
    at(8) * (at(1) * at(6) - at(2) * at(5))
  );
}

/**
 * Determinant of the linear part over the product of its columns' lengths: 0 if the space is flattened, ±1 if at most
 * scaled.
 */
function spread(m: ArrayLike<number>): number {
  const lengths = [0, 4, 8].reduce((product, k) => product * Math.hypot(...Array.from(m).slice(k, k + 3)), 1);
  return lengths > 0 ? determinant(m) / lengths : 0;
}

function checkProfile({ vertical, horizontal, intensities }: LightProfile, what: string): void {
  const rising = (angles: Float32Array) => angles.every((angle, i) => i === 0 || angle > (angles[i - 1] as number));
  for (const values of [vertical, horizontal, intensities]) finite(values, `${what}: profile`);
  if (
    vertical.length < 2 ||
    !rising(vertical) ||
    (vertical[0] as number) < 0 ||
    (vertical.at(-1) as number) > Math.PI + 1e-5
  )
    fail('value', `${what}: the profile's vertical angles must be at least two and rise within 0..π.`);
  if (
    horizontal.length < 1 ||
    !rising(horizontal) ||
    horizontal[0] !== 0 ||
    (horizontal.at(-1) as number) >= 2 * Math.PI
  )
    fail('value', `${what}: the profile's horizontal angles must rise from 0 and stay below 2π.`);
  length(
    intensities,
    vertical.length * horizontal.length,
    `${what}: profile of ${vertical.length} × ${horizontal.length} angles`,
  );
  if (intensities.some((value) => value < 0)) fail('value', `${what}: the profile has a negative intensity.`);
}

function checkLight(light: Light, index: number): void {
  const what = `Light ${index} ("${light.name}")`;
  finite([light.intensity, ...light.color], what);
  if (light.intensity < 0 || light.color.some((c) => c < 0))
    fail('value', `${what} has a negative intensity or colour.`);
  if (light.type !== 'directional') finite(light.position, `${what}: position`);
  if (light.type !== 'point' && light.type !== 'sphere') {
    finite(light.direction, `${what}: direction`);
    if (!(Math.hypot(...light.direction) > 0))
      fail('value', `${what}: direction has no length; it must be a unit vector.`);
  }
  if (
    light.type === 'spot' &&
    !(
      light.inner_cone_angle >= 0 &&
      light.inner_cone_angle <= light.outer_cone_angle &&
      light.outer_cone_angle <= Math.PI / 2 + 1e-6
    )
  ) {
    fail(
      'value',
      `${what} has cone angles ${light.inner_cone_angle} and ${light.outer_cone_angle}; they must satisfy 0 ≤ inner ≤ outer ≤ π/2.`,
    );
  }
  const sizes =
    light.type === 'rectangle'
      ? [light.width, light.height]
      : light.type === 'disk' || light.type === 'sphere'
        ? [light.radius]
        : [];
  finite(sizes, `${what}: size`);
  if (sizes.some((size) => !(size > 0)))
    fail('value', `${what} has a size of ${sizes.join(' × ')}; it must be above 0.`);
  if (light.type === 'profile') checkProfile(light.profile, what);
  if ((light.type === 'rectangle' || light.type === 'profile') && light.tangent) {
    finite(light.tangent, `${what}: tangent`);
    const [d, t] = [light.direction, light.tangent];
    if (!(Math.hypot(d[1] * t[2] - d[2] * t[1], d[2] * t[0] - d[0] * t[2], d[0] * t[1] - d[1] * t[0]) > 0))
      fail('value', `${what}: tangent is parallel to direction; it must not be.`);
  }
}

/** Maximum distance of a camera from the origin and maximum size of its view, metres: a limit of single precision. */
const MAX_DISTANCE = 1e12;

function checkCamera(camera: Camera, index: number): void {
  const what = `Camera ${index} ("${camera.name}")`;
  checkTransform(camera.transform, what);
  if (!(Math.abs(spread(camera.transform)) > 1e-6))
    fail('value', `${what}: transform cannot be inverted: its axes have no length or lie in one plane.`);
  const far = [12, 13, 14]
    .map((k) => Math.abs(camera.transform[k] as number))
    .find((distance) => distance > MAX_DISTANCE);
  if (far !== undefined)
    fail('value', `${what} is ${far} m away from the origin; it must be within ${MAX_DISTANCE} m.`);
  switch (camera.type) {
    case 'perspective':
      return checkPerspective(camera, what);
    case 'orthographic': {
      const { xmag, ymag } = camera;
      const usable = [xmag, ymag].every((half) => half > 0 && half <= MAX_DISTANCE);
      if (!usable)
        fail(
          'value',
          `${what}: xmag and ymag are ${xmag} and ${ymag}; they must be above 0 and at most ${MAX_DISTANCE} m.`,
        );
      return;
    }
    case 'panorama':
      return;
    default:
      fail(
        'value',
        `${what} has the unknown type "${String((camera as Camera).type)}"; it must be perspective, orthographic or panorama.`,
      );
  }
}

function checkPerspective(camera: PerspectiveCamera, what: string): void {
  const { yfov, aspect = 1, lens_radius = 0, focus_distance = 1, lens_blades = 0, lens_rotation = 0 } = camera;
  if (!(yfov > 0 && yfov < Math.PI)) fail('value', `${what}: yfov is ${yfov}; it must lie between 0 and π.`);
  finite([aspect], `${what}: aspect`);
  if (!(aspect > 0)) fail('value', `${what}: aspect is ${aspect}; it must be above 0.`);
  finite([lens_radius, focus_distance, lens_blades, lens_rotation], `${what}: lens`);
  if (!(lens_radius >= 0 && lens_radius <= MAX_DISTANCE))
    fail('value', `${what}: lens_radius is ${lens_radius}; it must lie between 0 and ${MAX_DISTANCE} m.`);
  if (!(focus_distance > 0)) fail('value', `${what}: focus_distance is ${focus_distance}; it must be above 0.`);
  if (!(lens_blades >= 0)) fail('value', `${what}: lens_blades is ${lens_blades}; it must be at least 0.`);
}

function* environmentSteps(environment: Environment): Generator<void> {
  if (environment.type === 'constant') {
    finite(environment.radiance, 'The environment');
    if (environment.radiance.some((c) => c < 0)) fail('value', 'The environment has a negative radiance.');
    return;
  }
  const { width, height, data, intensity = 1, rotation = 0 } = environment;
  if (!(Number.isInteger(width) && Number.isInteger(height) && width > 0 && height > 0))
    fail('value', `The environment has a size of ${width} × ${height}.`);
  length(data, 3 * width * height, `The environment of ${width} × ${height} pixels`);
  finite([intensity, rotation], 'The environment');
  if (intensity < 0) fail('value', `The environment has a negative intensity, ${intensity}.`);
  for (let from = 0; from < data.length; from += STEP) {
    radiances(data, from, Math.min(data.length, from + STEP));
    yield;
  }
}

function radiances(data: Float32Array, from: number, end: number): void {
  for (let i = from; i < end; i++) {
    if (!((data[i] as number) >= 0 && (data[i] as number) < Infinity))
      fail('not-finite', `The environment holds ${data[i]} at ${i}; radiance must be finite and not negative.`);
  }
}

function checkCompressed({ width, height }: Image, { format, levels }: CompressedImage, what: string): void {
  if (!['bc7-rgba-unorm', 'astc-4x4-unorm', 'etc2-rgba8unorm'].includes(format))
    fail(
      'value',
      `${what} is compressed as "${String(format)}"; it must be bc7-rgba-unorm, astc-4x4-unorm or etc2-rgba8unorm.`,
    );
  const maxLevels = 1 + Math.floor(Math.log2(Math.max(width, height)));
  if (levels.length < 1 || levels.length > maxLevels)
    fail(
      'length',
      `${what} of ${width} × ${height} pixels has ${levels.length} compressed levels, instead of 1 to ${maxLevels}.`,
    );
  levels.forEach((level, index) =>
    length(
      level,
      compressedBytes(Math.max(1, width >> index), Math.max(1, height >> index)),
      `${what}, compressed level ${index}`,
    ),
  );
}

/**
 * Checks that the parts of a scene fit together: indices, lengths of arrays, finite numbers, ranges (also those of
 * `Camera`). One pass over the data: 5 milliseconds for a million triangles. `validateScene` also finds suspicious parts.
 *
 * @throws {SceneError} at the first fault, with its place: `scene/reference`, `scene/length`, `scene/not-finite`,
 * `scene/value`.
 */
export function checkScene(scene: Scene): void {
  finish(checkSceneSteps(scene));
}

/**
 * The same as {@link checkScene} in steps of about a millisecond, for `inSlices`. The scene must not change until the
 * last step.
 *
 * @throws {SceneError} as {@link checkScene}, at the first step or a later one.
 * @example
 * await inSlices(checkSceneSteps(scene), { signal });
 */
export function* checkSceneSteps(scene: Scene): Steps<void> {
  for (const [index, mesh] of scene.meshes.entries()) yield* meshSteps(mesh, index);
  scene.images.forEach((image, index) => {
    const what = `Image ${index} ("${image.name}")`;
    if (!(Number.isInteger(image.width) && Number.isInteger(image.height) && image.width > 0 && image.height > 0))
      fail('value', `${what} has a size of ${image.width} × ${image.height}.`);
    if (image.compressed) checkCompressed(image, image.compressed, what);
    if (image.bitmap) {
      // Do not read `data`: that would copy the pixels back from the browser.
      if (image.bitmap.width !== image.width || image.bitmap.height !== image.height)
        fail(
          'length',
          `${what} of ${image.width} × ${image.height} pixels has a bitmap of ${image.bitmap.width} × ${image.bitmap.height}.`,
        );
      return;
    }
    // Do not read `data`: that would decompress it.
    if (image.compressed) return;
    length(image.data, 4 * image.width * image.height, `${what} of ${image.width} × ${image.height} pixels`);
    if (image.data instanceof Float32Array) finite(image.data, what);
  });
  scene.textures.forEach((texture, index) => reference(texture.image, scene.images, `Texture ${index}`, 'image'));
  scene.materials.forEach((material, index) => checkMaterial(scene, material, index));
  const seen = new Set<object>();
  for (let index = 0; index < scene.instances.length; index++) {
    if (index % 4096 === 4095) yield;
    const instance = scene.instances[index] as Instance;
    const what = () => `Instance ${index} ("${instance.name}")`;
    reference(instance.mesh, scene.meshes, what, 'mesh');
    reference(instance.material, scene.materials, what, 'material');
    // Instances of one mesh share the list.
    if (instance.variants && !seen.has(instance.variants)) {
      seen.add(instance.variants);
      for (const [variant, material] of Object.entries(instance.variants)) {
        reference(Number(variant), scene.variants ?? [], what, 'variant');
        reference(material, scene.materials, what, 'material');
      }
    }
    checkTransform(instance.transform, what);
  }
  scene.lights.forEach(checkLight);
  scene.cameras.forEach(checkCamera);
  if (scene.environment) yield* environmentSteps(scene.environment);
}
