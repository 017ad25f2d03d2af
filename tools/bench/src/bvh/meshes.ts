import { existsSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { TriangleMesh } from '@glanz/bvh';
import type { GpuMesh } from '@glanz/bvh/gpu';
import { createPushButton, type PushButtonLevel } from '@glanz/models';
import type { Scene } from '@glanz/scene';

/** One mesh to build over. */
export interface BenchMesh {
  readonly name: string;
  readonly positions: Float32Array<ArrayBuffer>;
  readonly indices: Uint32Array<ArrayBuffer>;
}

/** All visible triangles of a scene in one mesh, in the world. */
export function merged(name: string, scene: Scene): BenchMesh {
  const parts = scene.instances.map((instance) => ({ mesh: scene.meshes[instance.mesh]!, m: instance.transform }));
  const positions = new Float32Array(parts.reduce((sum, { mesh }) => sum + mesh.positions.length, 0));
  const indices = new Uint32Array(parts.reduce((sum, { mesh }) => sum + mesh.indices.length, 0));
  let vertex = 0,
    index = 0;
  for (const { mesh, m } of parts) {
    for (let i = 0; i < mesh.indices.length; i++) indices[index++] = mesh.indices[i]! + vertex;
    for (let v = 0; v < mesh.positions.length; v += 3, vertex++) {
      for (let r = 0; r < 3; r++)
        positions[3 * vertex + r] =
          m[r]! * mesh.positions[v]! +
          m[4 + r]! * mesh.positions[v + 1]! +
          m[8 + r]! * mesh.positions[v + 2]! +
          m[12 + r]!;
    }
  }
  return { name, positions, indices };
}

/** The meshes of a push-button, each by itself, as a scene has them. */
export function partsOf(level: PushButtonLevel): { readonly name: string; readonly meshes: readonly BenchMesh[] } {
  const meshes = createPushButton({ level }).meshes.map(({ name, positions, indices }) => ({
    name,
    positions: new Float32Array(positions),
    indices: new Uint32Array(indices),
  }));
  const triangles = meshes.reduce((sum, { indices }) => sum + indices.length / 3, 0);
  return { name: `push-button of ${triangles.toLocaleString('en')} triangles in ${meshes.length} meshes`, meshes };
}

/** A sphere of latitude-longitude quads whose radius varies by a smooth noise and a fine one. */
export function noisySphere(name: string, rings: number): BenchMesh {
  const segments = 2 * rings;
  const positions = new Float32Array((rings + 1) * (segments + 1) * 3);
  const indices = new Uint32Array(rings * segments * 6);
  let p = 0,
    q = 0;
  for (let i = 0; i <= rings; i++) {
    for (let j = 0; j <= segments; j++) {
      const theta = (i * Math.PI) / rings,
        phi = ((j % segments) * 2 * Math.PI) / segments;
      const x = Math.sin(theta) * Math.cos(phi),
        y = Math.cos(theta),
        z = Math.sin(theta) * Math.sin(phi);
      const radius =
        1 +
        0.08 * Math.sin(5 * x + 3 * y) * Math.cos(4 * z - 2 * y) +
        0.01 * Math.sin(61 * x) * Math.sin(53 * y) * Math.sin(47 * z);
      positions.set([x * radius, y * radius, z * radius], p);
      p += 3;
      if (i === rings || j === segments) continue;
      const a = i * (segments + 1) + j,
        b = a + segments + 1;
      indices.set([a, a + 1, b, a + 1, b + 1, b], q);
      q += 6;
    }
  }
  return { name, positions, indices };
}

/** Slivers of a length of about a third of the scene and a hundredth as wide, in every direction (seeded). */
export function thinTriangles(name: string, count: number): BenchMesh {
  let state = 12345;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  const positions = new Float32Array(count * 9);
  for (let i = 0; i < count; i++) {
    const at = [random(), random(), random()],
      along = [random() - 0.5, random() - 0.5, random() - 0.5],
      across = [random() - 0.5, random() - 0.5, random() - 0.5];
    for (let k = 0; k < 3; k++) {
      positions[9 * i + k] = at[k]!;
      positions[9 * i + 3 + k] = at[k]! + 0.6 * along[k]!;
      positions[9 * i + 6 + k] = at[k]! + 0.3 * along[k]! + 0.006 * across[k]!;
    }
  }
  return { name, positions, indices: Uint32Array.from({ length: count * 3 }, (_, i) => i) };
}

/**
 * An assembly of parts in a box, as a CAD program tessellates it: rods of all lengths along the axes, discs and plates,
 * each of `4 * segments` triangles, the long walls of rods in slivers (seeded).
 */
export function assembly(name: string, parts: number, segments: number): BenchMesh {
  let state = 4711;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  const rim = 2 * segments + 2;
  const positions = new Float32Array(parts * rim * 3);
  const indices = new Uint32Array(parts * segments * 12);
  let p = 0,
    q = 0;
  for (let part = 0; part < parts; part++) {
    const axis = Math.floor(3 * random());
    const scale = 1.5 / Math.cbrt(parts);
    const long = random() < 0.5;
    const radius = scale * (long ? 0.05 + 0.1 * random() : 0.2 + 0.4 * random()),
      length = scale * (long ? 0.5 + 3 * random() ** 2 : 0.02 + 0.3 * random());
    const middle = [2 * random() - 1, 2 * random() - 1, 2 * random() - 1];
    // Plates have four corners; their other vertices lie on the edges.
    const square = !long && random() < 0.5;
    const put = (r: number, angle: number, along: number) => {
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      const out = square ? r / Math.max(Math.abs(c), Math.abs(s)) : r;
      positions[p + axis] = middle[axis]! + along;
      positions[p + ((axis + 1) % 3)] = middle[(axis + 1) % 3]! + out * c;
      positions[p + ((axis + 2) % 3)] = middle[(axis + 2) % 3]! + out * s;
      p += 3;
    };
    const first = p / 3;
    for (const end of [-0.5, 0.5])
      for (let i = 0; i < segments; i++) put(radius, (2 * Math.PI * i) / segments, end * length);
    put(0, 0, -0.5 * length);
    put(0, 0, 0.5 * length);
    for (let i = 0; i < segments; i++) {
      const a = first + i,
        b = first + ((i + 1) % segments),
        c = a + segments,
        d = b + segments;
      indices.set([a, b, c, b, d, c, first + 2 * segments, b, a, first + 2 * segments + 1, c, d], q);
      q += 12;
    }
  }
  return { name, positions, indices };
}

/** A mesh in GPU buffers, as a builder on the GPU takes it, with what frees them. */
export function inMemory(device: GPUDevice, { positions, indices }: TriangleMesh): GpuMesh & { destroy(): void } {
  const upload = (data: Float32Array | Uint32Array | Uint16Array) => {
    const words = data instanceof Uint16Array ? new Uint32Array(data) : data;
    const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST;
    const buffer = device.createBuffer({ size: Math.max(4, words.byteLength), usage });
    device.queue.writeBuffer(buffer, 0, words.buffer, words.byteOffset, words.byteLength);
    return buffer;
  };
  const vertices = upload(positions),
    corners = indices && upload(indices);
  return {
    positions: vertices,
    vertexCount: positions.length / 3,
    indices: corners,
    triangleCount: (indices ? indices.length : positions.length / 3) / 3,
    destroy: () => [vertices, corners].forEach((buffer) => buffer?.destroy()),
  };
}

/** A folder of test models, `GLANZ_ASSETS` or `shared/assets` beside the checkout; undefined if it is missing. */
function assetsFolder(): string | undefined {
  const named = process.env['GLANZ_ASSETS'];
  if (named) return existsSync(named) ? named : undefined;
  for (let folder = dirname(fileURLToPath(import.meta.url)); ; folder = dirname(folder)) {
    const candidate = join(folder, 'shared/assets');
    if (existsSync(candidate)) return candidate;
    if (folder === dirname(folder)) return undefined;
  }
}

const ASSETS: readonly (readonly [name: string, folder: string])[] = [
  ['bunny', 'bunny-casual-effects'],
  ['dragon', 'stanford-dragon'],
  ['CAD engine', '2CylinderEngine'],
];

/** The paper's three sizes. */
export const PUSH_BUTTONS: readonly (readonly [PushButtonLevel, string])[] = [
  ['low', 'push-button 11k'],
  ['medium', 'push-button 107k'],
  ['high', 'push-button 1.07M'],
];

/** Every mesh of the benchmark, made when asked for. `quick`: only those under 200,000 triangles that need no files. */
export async function benchMeshes(quick: boolean, note: (line: string) => void): Promise<BenchMesh[]> {
  const meshes: BenchMesh[] = [];
  for (const [level, name] of PUSH_BUTTONS)
    if (!quick || level !== 'high') meshes.push(merged(name, createPushButton({ level })));
  meshes.push(noisySphere('noisy sphere 107k', 164), thinTriangles('thin triangles 100k', 100_000));
  if (quick) return meshes;
  meshes.push(noisySphere('noisy sphere 1.07M', 518));
  const folder = assetsFolder();
  if (!folder)
    note('bunny, dragon and CAD engine are left out: the test models are not here (set GLANZ_ASSETS to their folder)');
  else {
    const { loadGltfFile } = await import('@glanz/gltf/node');
    for (const [name, asset] of ASSETS) {
      const file = readdirSync(join(folder, asset)).find((candidate) => /\.gl(b|tf)$/.test(candidate));
      if (file)
        meshes.push(
          merged(
            name,
            await loadGltfFile(join(folder, asset, file), {
              decodeImage: async () => ({ width: 1, height: 1, data: new Uint8Array(4) }),
            }),
          ),
        );
    }
  }
  return meshes;
}
