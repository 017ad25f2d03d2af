import type { Camera } from './camera';
import type { Environment } from './environment';
import { SceneError } from './error';
import type { Light } from './light';
import type { Material } from './material';
import type { Mesh } from './mesh';
import type { Scene, SceneWarning } from './scene';

const fail = (code: 'reference' | 'length' | 'not-finite' | 'value', message: string): never => {
  throw new SceneError(`scene/${code}`, message);
};

function reference(index: number, list: readonly unknown[], what: string, kind: string): void {
  if (!(Number.isInteger(index) && index >= 0 && index < list.length)) fail('reference', `${what} refers to ${kind} ${index}; the scene has ${list.length}.`);
}

function finite(values: ArrayLike<number>, what: string): void {
  for (let i = 0; i < values.length; i++) {
    if (!Number.isFinite(values[i])) fail('not-finite', `${what} holds ${values[i]} at ${i}; every number must be finite.`);
  }
}

function length(values: ArrayLike<number>, expected: number, what: string): void {
  if (values.length !== expected) fail('length', `${what} has ${values.length} numbers; it must have ${expected}.`);
}

function checkMesh(mesh: Mesh, index: number, warnings: SceneWarning[]): void {
  const what = `Mesh ${index} ("${mesh.name}")`;
  const { positions, indices } = mesh;
  if (positions.length % 3 !== 0) fail('length', `${what}: positions has ${positions.length} numbers; it must have three a vertex.`);
  if (indices.length % 3 !== 0) fail('length', `${what}: indices has ${indices.length} entries; it must have three a triangle.`);
  const vertices = positions.length / 3;
  finite(positions, `${what}: positions`);
  let same = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const a = indices[i] as number, b = indices[i + 1] as number, c = indices[i + 2] as number;
    if (a >= vertices || b >= vertices || c >= vertices) fail('reference', `${what}: triangle ${i / 3} refers to vertex ${Math.max(a, b, c)}; the mesh has ${vertices}.`);
    if (a === b || b === c || a === c) same++;
  }
  if (same > 0) warnings.push({ code: 'scene/degenerate', message: `${what} has ${same} triangle${same === 1 ? '' : 's'} with two equal corners; nothing hits them.`, path: `/meshes/${index}` });
  const attribute = (values: Float32Array | undefined, stride: number, name: string) => {
    if (!values) return;
    length(values, stride * vertices, `${what}: ${name}`);
    finite(values, `${what}: ${name}`);
  };
  attribute(mesh.normals, 3, 'normals');
  attribute(mesh.tangents, 4, 'tangents');
  attribute(mesh.colors, 4, 'colors');
  mesh.uvs?.forEach((uv, set) => attribute(uv, 2, `uvs[${set}]`));
}

function checkMaterial(scene: Scene, material: Material, index: number): void {
  const what = `Material ${index} ("${material.name}")`;
  for (const [name, value] of Object.entries(material.parameters)) {
    if (typeof value === 'number') finite([value], `${what}: ${name}`);
    else if (Array.isArray(value)) finite(value as number[], `${what}: ${name}`);
  }
  for (const [name, binding] of Object.entries(material.textures ?? {})) {
    if (!binding) continue;
    reference(binding.texture, scene.textures, `${what}: ${name}`, 'texture');
    if (binding.transform) {
      length(binding.transform, 6, `${what}: the transform of ${name}`);
      finite(binding.transform, `${what}: the transform of ${name}`);
    }
  }
}

function checkTransform(transform: ArrayLike<number>, what: string): void {
  length(transform, 16, `${what}: transform`);
  finite(transform, `${what}: transform`);
}

function checkLight(light: Light, index: number): void {
  const what = `Light ${index} ("${light.name}")`;
  finite([light.intensity, ...light.color], what);
  if (light.intensity < 0 || light.color.some((c) => c < 0)) fail('value', `${what} has a negative intensity or colour.`);
  if (light.type !== 'directional') finite(light.position, `${what}: position`);
  if (light.type !== 'point') {
    finite(light.direction, `${what}: direction`);
    if (!(Math.hypot(...light.direction) > 0)) fail('value', `${what}: direction has no length.`);
  }
  if (light.type === 'spot' && !(light.inner_cone_angle >= 0 && light.inner_cone_angle <= light.outer_cone_angle && light.outer_cone_angle <= Math.PI / 2 + 1e-6)) {
    fail('value', `${what} has cone angles ${light.inner_cone_angle} and ${light.outer_cone_angle}; they must satisfy 0 ≤ inner ≤ outer ≤ π/2.`);
  }
}

function checkCamera(camera: Camera, index: number): void {
  const what = `Camera ${index} ("${camera.name}")`;
  checkTransform(camera.transform, what);
  if (camera.type === 'perspective') {
    if (!(camera.yfov > 0 && camera.yfov < Math.PI)) fail('value', `${what}: yfov is ${camera.yfov}; it must lie between 0 and π.`);
  } else if (!(camera.xmag > 0 && camera.ymag > 0)) fail('value', `${what}: xmag and ymag are ${camera.xmag} and ${camera.ymag}; they must be positive.`);
}

function checkEnvironment(environment: Environment): void {
  if (environment.type === 'constant') {
    finite(environment.radiance, 'The environment');
    if (environment.radiance.some((c) => c < 0)) fail('value', 'The environment has a negative radiance.');
    return;
  }
  const { width, height, data, intensity = 1, rotation = 0 } = environment;
  if (!(Number.isInteger(width) && Number.isInteger(height) && width > 0 && height > 0)) fail('value', `The environment has a size of ${width} × ${height}.`);
  length(data, 3 * width * height, `The environment of ${width} × ${height} pixels`);
  finite([intensity, rotation], 'The environment');
  for (let i = 0; i < data.length; i++) {
    if (!((data[i] as number) >= 0 && (data[i] as number) < Infinity)) fail('not-finite', `The environment holds ${data[i]} at ${i}; radiance must be finite and not negative.`);
  }
}

/**
 * Checks that the parts of a scene fit together: indices, lengths of arrays, finite numbers, ranges.
 *
 * @returns What is odd but harmless.
 * @throws {SceneError} at the first fault, saying where it is.
 */
export function validateScene(scene: Scene): SceneWarning[] {
  const warnings: SceneWarning[] = [];
  scene.meshes.forEach((mesh, index) => checkMesh(mesh, index, warnings));
  scene.images.forEach((image, index) => {
    const what = `Image ${index} ("${image.name}")`;
    if (!(Number.isInteger(image.width) && Number.isInteger(image.height) && image.width > 0 && image.height > 0)) fail('value', `${what} has a size of ${image.width} × ${image.height}.`);
    length(image.data, 4 * image.width * image.height, `${what} of ${image.width} × ${image.height} pixels`);
    if (image.data instanceof Float32Array) finite(image.data, what);
  });
  scene.textures.forEach((texture, index) => reference(texture.image, scene.images, `Texture ${index}`, 'image'));
  scene.materials.forEach((material, index) => checkMaterial(scene, material, index));
  scene.instances.forEach((instance, index) => {
    const what = `Instance ${index} ("${instance.name}")`;
    reference(instance.mesh, scene.meshes, what, 'mesh');
    reference(instance.material, scene.materials, what, 'material');
    checkTransform(instance.transform, what);
  });
  scene.lights.forEach(checkLight);
  scene.cameras.forEach(checkCamera);
  if (scene.environment) checkEnvironment(scene.environment);
  return warnings;
}
