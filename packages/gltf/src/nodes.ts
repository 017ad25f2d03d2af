import type { Document, Node, Primitive, Scene as GltfScene } from '@gltf-transform/core';
import type { InstancedMesh, Light as GltfLight } from '@gltf-transform/extensions';
import type { Camera, Light, Scene, SceneWarning } from '@glanz/scene';
import { mat4, quat, type vec3 } from 'gl-matrix';
import { floatsOf, readPrimitive } from './attributes';
import { unitNormals } from './normals';
import { morphed, skinned } from './pose';

const matrix = (): mat4 => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const numbers = (m: mat4): number[] => Array.from(m);
const finite = (m: mat4) => numbers(m).every(Number.isFinite);

/** What the nodes are turned into a scene with. */
export interface NodeContext {
  readonly document: Document;
  /** Index of the scene's material of each of the document's; the last is the default. */
  readonly scene: Scene;
  readonly defaultMaterial: () => number;
}

/** World transforms of all nodes of a scene, parents before children. Nodes in a circle count once. */
function worldTransforms(roots: readonly Node[]): Map<Node, mat4> {
  const world = new Map<Node, mat4>();
  const stack = roots.toReversed().map((node) => ({ node, parent: matrix() }));
  for (let entry = stack.pop(); entry; entry = stack.pop()) {
    if (world.has(entry.node)) continue;
    const own = mat4.multiply(matrix(), entry.parent, entry.node.getMatrix() as unknown as mat4);
    world.set(entry.node, own);
    for (const child of entry.node.listChildren().toReversed()) stack.push({ node: child, parent: own });
  }
  return world;
}

/** The scene to show: the default one, else the first, else all nodes without a parent. */
function rootsOf(document: Document): readonly Node[] {
  const root = document.getRoot();
  const shown: GltfScene | undefined = root.getDefaultScene() ?? root.listScenes()[0];
  return shown ? shown.listChildren() : root.listNodes().filter((node) => !node.getParentNode());
}

/** Reads instances, meshes, cameras and lights into the scene, in the order of the node tree. */
export function readNodes({ document, scene, defaultMaterial }: NodeContext): void {
  const root = document.getRoot();
  const materials = new Map(root.listMaterials().map((material, index) => [material, index]));
  const meshIndices = new Map(root.listMeshes().map((mesh, index) => [mesh, index]));
  const world = worldTransforms(rootsOf(document));
  const shared = new Map<Primitive, number>();
  for (const [node, transform] of world) {
    const name = node.getName();
    if (!finite(transform)) {
      scene.warnings.push({ code: 'gltf/node', message: `Node "${name}" has a transform that is not finite; it is left out.` });
      continue;
    }
    readCamera(node, transform, scene);
    readLight(node, transform, scene);
    const mesh = node.getMesh();
    if (!mesh) continue;
    const meshIndex = meshIndices.get(mesh) ?? -1;
    const weights = (node.getWeights().length > 0 ? node.getWeights() : mesh.getWeights()).map((w) => (Number.isFinite(w) ? w : 0));
    const skin = node.getSkin();
    const posed = skin !== null || weights.some((w) => w !== 0);
    mesh.listPrimitives().forEach((primitive, index) => {
      const used = primitive.getMaterial();
      const material = used ? (materials.get(used) as number) : defaultMaterial();
      let at = posed ? undefined : shared.get(primitive);
      if (at === undefined) {
        const label = mesh.getName() || name || `mesh ${meshIndex}`;
        const several = mesh.listPrimitives().length > 1 ? ` ${index}` : '';
        const opaque = scene.materials[material]?.parameters.geometry_opacity === undefined;
        let made = readPrimitive(primitive, label + several, opaque, `/meshes/${meshIndex}/primitives/${index}`, scene.warnings);
        if (!made) return;
        if (weights.some((w) => w !== 0)) made = morphed(made, primitive, weights);
        if (skin) made = skinned(made, primitive, skin, world, scene.warnings);
        // Blended normals are shorter than 1, and may even cancel out.
        if (posed && made.normals) unitNormals(made.normals, made.positions, made.indices, (message) => scene.warnings.push({ code: 'gltf/primitive', message: `${label}: ${message}` }));
        at = scene.meshes.push(made) - 1;
        if (!posed) shared.set(primitive, at);
      }
      const places = skin ? [matrix()] : instancesOf(node, transform, scene.warnings);
      for (const place of places) scene.instances.push({ name: name || mesh.getName() || `node ${scene.instances.length}`, mesh: at, material, transform: numbers(place) });
    });
  }
}

/** The places of a node's mesh: one, or those of EXT_mesh_gpu_instancing. */
function instancesOf(node: Node, transform: mat4, warnings: SceneWarning[]): mat4[] {
  const extension = node.getExtension<InstancedMesh>('EXT_mesh_gpu_instancing');
  if (!extension) return [transform];
  const read = (semantic: string, size: number) => {
    const accessor = extension.getAttribute(semantic);
    return accessor ? floatsOf(accessor, size) : undefined;
  };
  const translations = read('TRANSLATION', 3), rotations = read('ROTATION', 4), scales = read('SCALE', 3);
  const count = Math.max((translations?.length ?? 0) / 3, (rotations?.length ?? 0) / 4, (scales?.length ?? 0) / 3);
  const places: mat4[] = [];
  let unturned = 0;
  for (let i = 0; i < count; i++) {
    const t = Array.from(translations?.subarray(3 * i, 3 * i + 3) ?? [0, 0, 0]) as unknown as vec3;
    const r = Array.from(rotations?.subarray(4 * i, 4 * i + 4) ?? [0, 0, 0, 1]) as unknown as quat;
    const turn = Math.hypot(...(r as number[]));
    if (turn > 1e-6) quat.scale(r, r, 1 / turn);
    else {
      quat.identity(r);
      unturned++;
    }
    const s = Array.from(scales?.subarray(3 * i, 3 * i + 3) ?? [1, 1, 1]) as unknown as vec3;
    const place = mat4.multiply(matrix(), transform, mat4.fromRotationTranslationScale(matrix(), r, t, s));
    if (finite(place)) places.push(place);
  }
  if (unturned > 0) warnings.push({ code: 'gltf/node', message: `${unturned} of ${count} instances at node "${node.getName()}" have a rotation of length 0; they are not turned.` });
  if (places.length < count) warnings.push({ code: 'gltf/node', message: `${count - places.length} of ${count} instances at node "${node.getName()}" have a place that is not finite; they are left out.` });
  return places;
}

/** How far the axes of a transform are from lying in a plane: the volume that they span over that of a box, 0 to 1. */
function spread(m: mat4): number {
  const lengths = Math.hypot(m[0], m[1], m[2]) * Math.hypot(m[4], m[5], m[6]) * Math.hypot(m[8], m[9], m[10]);
  const volume = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) + m[8] * (m[1] * m[6] - m[2] * m[5]);
  return lengths > 0 ? Math.abs(volume) / lengths : 0;
}

function readCamera(node: Node, transform: mat4, scene: Scene): void {
  const camera = node.getCamera();
  if (!camera) return;
  const common = { name: camera.getName() || node.getName() || `camera ${scene.cameras.length}`, transform: numbers(transform) };
  if (!(spread(transform) > 1e-5)) {
    scene.warnings.push({ code: 'gltf/camera', message: `Camera "${common.name}" is flattened by its node's scale; it is left out.` });
    return;
  }
  const yfov = camera.getYFov();
  let made: Camera;
  if (camera.getType() === 'perspective') {
    if (!(yfov > 0 && yfov < Math.PI)) {
      scene.warnings.push({ code: 'gltf/camera', message: `Camera "${common.name}" has a field of view of ${yfov} rad; it is left out.` });
      return;
    }
    const aspect = camera.getAspectRatio();
    made = { type: 'perspective', ...common, yfov, ...(aspect !== null && aspect > 0 ? { aspect } : {}) };
  } else {
    const xmag = Math.abs(camera.getXMag()), ymag = Math.abs(camera.getYMag());
    if (!(xmag > 0 && ymag > 0 && xmag < Infinity && ymag < Infinity)) {
      scene.warnings.push({ code: 'gltf/camera', message: `Camera "${common.name}" has a view of no size; it is left out.` });
      return;
    }
    made = { type: 'orthographic', ...common, xmag, ymag };
  }
  scene.cameras.push(made);
}

function readLight(node: Node, m: mat4, scene: Scene): void {
  const light = node.getExtension<GltfLight>('KHR_lights_punctual');
  if (!light) return;
  const name = light.getName() || node.getName() || `light ${scene.lights.length}`;
  const color = light.getColor() as [number, number, number];
  const intensity = light.getIntensity();
  const length = Math.hypot(m[8], m[9], m[10]);
  if (!(intensity >= 0 && intensity < Infinity) || !color.every((c) => c >= 0 && c < Infinity) || !(length > 0)) {
    scene.warnings.push({ code: 'gltf/light', message: `Light "${name}" has an intensity, colour or direction that makes no sense; it is left out.` });
    return;
  }
  const position = [m[12], m[13], m[14]] as const;
  // Lights shine along their −Z.
  const direction = [-m[8] / length, -m[9] / length, -m[10] / length] as const;
  const type = light.getType();
  let made: Light;
  if (type === 'point') made = { type, name, color, intensity, position };
  else if (type === 'directional') made = { type, name, color, intensity, direction };
  else {
    const outer_cone_angle = Math.min(Math.max(light.getOuterConeAngle(), 1e-4), Math.PI / 2);
    const inner_cone_angle = Math.min(Math.max(light.getInnerConeAngle(), 0), outer_cone_angle);
    made = { type: 'spot', name, color, intensity, position, direction, inner_cone_angle, outer_cone_angle };
  }
  scene.lights.push(made);
}
