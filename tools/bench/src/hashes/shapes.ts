import type { Image, Material, Mesh, Scene } from '@glanz/scene';

/** Column-major 4 × 4 matrix that moves by a vector. */
export const translation = (x: number, y: number, z: number): number[] => [
  1,
  0,
  0,
  0,
  0,
  1,
  0,
  0,
  0,
  0,
  1,
  0,
  x,
  y,
  z,
  1,
];

/** A sphere of latitude-longitude quads, radius 1, with normals, texture coordinates and tangents along +u. */
export function sphere(segments = 24): Mesh {
  const positions: number[] = [];
  const tangents: number[] = [];
  const uvs: number[] = [];
  const indices: number[] = [];
  const rings = segments / 2;
  for (let i = 0; i <= rings; i++) {
    for (let j = 0; j <= segments; j++) {
      const theta = (i * Math.PI) / rings;
      const phi = (j * 2 * Math.PI) / segments;
      positions.push(Math.sin(theta) * Math.cos(phi), Math.cos(theta), -Math.sin(theta) * Math.sin(phi));
      tangents.push(-Math.sin(phi), 0, -Math.cos(phi), 1);
      uvs.push(j / segments, i / rings);
      if (i === rings || j === segments) continue;
      const a = i * (segments + 1) + j;
      const b = a + segments + 1;
      if (i > 0) indices.push(a, b, a + 1);
      if (i < rings - 1) indices.push(a + 1, b, b + 1);
    }
  }
  const coordinates = Float32Array.from(positions);
  return {
    name: 'sphere',
    positions: coordinates,
    normals: coordinates.slice(),
    tangents: Float32Array.from(tangents),
    uvs: [Float32Array.from(uvs)],
    indices: Uint32Array.from(indices),
  };
}

/** A square of side 2 in the xy plane that faces +z, without normals. */
export function square(): Mesh {
  return {
    name: 'square',
    positions: Float32Array.of(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0),
    uvs: [Float32Array.of(0, 1, 1, 1, 1, 0, 0, 0)],
    indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
  };
}

/** Adds a mesh with a material of its own and returns the index of the instance. */
export function place(scene: Scene, mesh: Mesh, material: Material, transform: readonly number[]): number {
  scene.meshes.push(mesh);
  scene.materials.push(material);
  return (
    scene.instances.push({
      name: material.name,
      mesh: scene.meshes.length - 1,
      material: scene.materials.length - 1,
      transform,
    }) - 1
  );
}

/** An 8-bit image whose texels are a function of their place. */
export function image(
  name: string,
  size: number,
  texel: (x: number, y: number) => readonly [number, number, number, number],
): Image {
  const data = new Uint8Array(4 * size * size);
  for (let y = 0; y < size; y++) for (let x = 0; x < size; x++) data.set(texel(x, y), 4 * (y * size + x));
  return { name, width: size, height: size, data };
}

/** Adds an image with one texture of it and returns the index of the texture. */
export function addTexture(scene: Scene, pixels: Image, colorSpace: 'srgb' | 'linear'): number {
  scene.images.push(pixels);
  return scene.textures.push({ image: scene.images.length - 1, color_space: colorSpace }) - 1;
}
