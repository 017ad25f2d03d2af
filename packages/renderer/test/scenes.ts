import { createScene, type Material, type PerspectiveCamera, type Scene } from '@glanz/scene';

/** Two triangles from (−half, −half) to (half, half) in the xy plane, facing +z; uv (0, 0) at the upper left. */
export function addQuad(
  scene: Scene,
  half: number,
  z: number,
  material: Material,
  options: { readonly flip?: boolean; readonly transform?: readonly number[] } = {},
): number {
  const mesh = scene.meshes.push({
    name: `quad ${scene.meshes.length}`,
    positions: new Float32Array([-half, -half, z, half, -half, z, half, half, z, -half, half, z]),
    indices: options.flip ? new Uint32Array([0, 2, 1, 0, 3, 2]) : new Uint32Array([0, 1, 2, 0, 2, 3]),
    uvs: [new Float32Array([0, 1, 1, 1, 1, 0, 0, 0])],
  });
  const index = scene.materials.push(material) - 1;
  scene.instances.push({
    name: `quad ${mesh - 1}`,
    mesh: mesh - 1,
    material: index,
    transform: options.transform ?? [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  });
  return index;
}

/** A box between two corners, facing outwards. */
export function addBox(
  scene: Scene,
  low: readonly [number, number, number],
  high: readonly [number, number, number],
  material: Material,
): void {
  const positions = Array.from({ length: 8 }, (_, i) =>
    [0, 1, 2].map((k) => ((i >> k) & 1 ? high : low)[k] as number),
  ).flat();
  const faces = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
  ] as const;
  scene.meshes.push({
    name: 'box',
    positions: new Float32Array(positions),
    indices: new Uint32Array(faces.flatMap(([a, b, c, d]) => [a, b, c, a, c, d])),
  });
  scene.materials.push(material);
  scene.instances.push({
    name: 'box',
    mesh: scene.meshes.length - 1,
    material: scene.materials.length - 1,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  });
}

/** A sphere of latitude-longitude quads with smooth normals, wound outwards. */
export function addSphere(
  scene: Scene,
  radius: number,
  center: readonly [number, number, number],
  material: Material,
  segments = 48,
): void {
  const positions: number[] = [];
  const normals: number[] = [];
  const indices: number[] = [];
  for (let i = 0; i <= segments / 2; i++) {
    for (let j = 0; j <= segments; j++) {
      const theta = (i * 2 * Math.PI) / segments;
      const phi = (j * 2 * Math.PI) / segments;
      const n = [Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi)] as const;
      normals.push(...n);
      positions.push(...n.map((x, k) => x * radius + (center[k] as number)));
      if (i < segments / 2 && j < segments) {
        const a = i * (segments + 1) + j;
        const b = a + segments + 1;
        if (i > 0) indices.push(a, a + 1, b);
        if (i < segments / 2 - 1) indices.push(a + 1, b + 1, b);
      }
    }
  }
  scene.meshes.push({
    name: 'sphere',
    positions: new Float32Array(positions),
    normals: new Float32Array(normals),
    indices: new Uint32Array(indices),
  });
  scene.materials.push(material);
  scene.instances.push({
    name: 'sphere',
    mesh: scene.meshes.length - 1,
    material: scene.materials.length - 1,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  });
}

/** At (0, 0, 3), looking at the origin along −z. */
export const camera: PerspectiveCamera = {
  type: 'perspective',
  name: 'camera',
  transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 3, 1],
  yfov: 2 * Math.atan(1 / 3),
};

/**
 * A camera that sees the middle of another's image: `part` of its width and height. Where a test measures a region, the
 * pixels around it cost time and tell nothing.
 */
export const middle = (part: number, of: PerspectiveCamera = camera): PerspectiveCamera => ({
  ...of,
  yfov: 2 * Math.atan(part * Math.tan(of.yfov / 2)),
});

export const lambert = (r: number, g = r, b = r): Material => ({
  name: 'lambert',
  parameters: { base_color: [r, g, b], specular_weight: 0 },
});

export { createScene };

/** Mean of the RGB of an RGBA image over a rectangle of pixels. */
export function meanOf(
  pixels: Float32Array,
  width: number,
  x0: number,
  y0: number,
  x1: number,
  y1: number,
): [number, number, number] {
  const sum: [number, number, number] = [0, 0, 0];
  for (let y = y0; y < y1; y++)
    for (let x = x0; x < x1; x++)
      for (const c of [0, 1, 2] as const) sum[c] += pixels[4 * (y * width + x) + c] as number;
  const n = (x1 - x0) * (y1 - y0);
  return [sum[0] / n, sum[1] / n, sum[2] / n];
}
