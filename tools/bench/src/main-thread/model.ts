import { sceneToGlb } from '@glanz/models/gltf';
import { createScene } from '@glanz/scene';
import { noisySphere } from '../bvh/meshes';

/** Smooth normals: the sum of the cross products around each vertex, normalised. */
function smoothNormals(positions: Float32Array, indices: Uint32Array): Float32Array<ArrayBuffer> {
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i]!, 3 * indices[i + 1]!, 3 * indices[i + 2]!];
    const e = [0, 1, 2].map((k) => positions[b + k]! - positions[a + k]!),
      f = [0, 1, 2].map((k) => positions[c + k]! - positions[a + k]!);
    const n = [e[1]! * f[2]! - e[2]! * f[1]!, e[2]! * f[0]! - e[0]! * f[2]!, e[0]! * f[1]! - e[1]! * f[0]!];
    for (const v of [a, b, c]) for (let k = 0; k < 3; k++) normals[v + k]! += n[k]!;
  }
  for (let v = 0; v < normals.length; v += 3) {
    const length = Math.hypot(normals[v]!, normals[v + 1]!, normals[v + 2]!) || 1;
    for (let k = 0; k < 3; k++) normals[v + k]! /= length;
  }
  return normals;
}

/** A sphere of `4 * rings²` triangles as a .glb file: one mesh, with normals if asked for. */
export async function sphereFile(
  rings: number,
  normals: boolean,
): Promise<{ readonly bytes: Uint8Array<ArrayBuffer>; readonly triangles: number }> {
  const { positions, indices } = noisySphere('sphere', rings);
  const scene = createScene('Sphere');
  scene.meshes.push({
    name: 'sphere',
    positions,
    indices,
    ...(normals ? { normals: smoothNormals(positions, indices) } : {}),
  });
  scene.materials.push({ name: 'grey', parameters: { base_color: [0.6, 0.6, 0.6] } });
  scene.instances.push({
    name: 'sphere',
    mesh: 0,
    material: 0,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  });
  return { bytes: await sceneToGlb(scene), triangles: indices.length / 3 };
}
