import type { Camera, Instance, Material, Mesh, Scene, Steps, TextureBinding } from '@glanz/scene';

/** Max triangles of an instance that are sampled, evenly spread. */
const TRIANGLES = 512;
/** Max samples of all instances, where each has at least one. */
const SAMPLES = 1 << 18;
/** Share of what is seen of a texture that may be finer than the estimate: poles of spheres, seams. */
const FINER = 0.05;

/** What a pixel covers: metres at a distance. */
function pixelSize(camera: Camera, height: number): (distance: number) => number {
  if (camera.type === 'orthographic') return () => (2 * camera.ymag) / height;
  const angle = camera.type === 'panorama' ? Math.PI / height : (2 * Math.tan(camera.yfov / 2)) / height;
  return (distance) => distance * angle;
}

/** A texture coordinate unit on screen, for a triangle: its size in pixels, and how much of the view it takes. */
interface Seen {
  readonly pixels: number;
  readonly weight: number;
}

/** The size on screen of the unit square of texture coordinates, at a sample of a mesh's triangles. */
function* seenTriangles(
  mesh: Mesh,
  transform: ArrayLike<number>,
  set: number,
  [a, b, c, d]: ArrayLike<number> & Iterable<number>,
  eye: readonly number[],
  pixelAt: (distance: number) => number,
  samples: number,
): Generator<Seen> {
  const uvs = mesh.uvs?.[set];
  if (!uvs) return;
  const triangles = Math.floor(mesh.indices.length / 3);
  const step = Math.max(1, Math.ceil(triangles / samples));
  const scale = Math.abs((a as number) * (d as number) - (b as number) * (c as number));
  const point = (vertex: number) =>
    [0, 1, 2].map(
      (row) =>
        [0, 1, 2].reduce(
          (sum, k) => sum + (transform[4 * k + row] as number) * (mesh.positions[3 * vertex + k] as number),
          transform[12 + row] as number,
        ) - (eye[row] as number),
    ) as [number, number, number];
  // From the middle of a step: meshes often begin at a pole.
  for (let t = step >> 1; t < triangles; t += step) {
    const [i, j, k] = [0, 1, 2].map((corner) => mesh.indices[3 * t + corner] as number) as [number, number, number];
    const u = (vertex: number) => uvs[2 * vertex] as number;
    const v = (vertex: number) => uvs[2 * vertex + 1] as number;
    const uvArea = scale * Math.abs((u(j) - u(i)) * (v(k) - v(i)) - (v(j) - v(i)) * (u(k) - u(i)));
    const [p, q, r] = [point(i), point(j), point(k)];
    const [e, f] = [q.map((x, n) => x - (p[n] as number)), r.map((x, n) => x - (p[n] as number))] as [
      number[],
      number[],
    ];
    const cross = [0, 1, 2].map((n) => {
      const [m, o] = [(n + 1) % 3, (n + 2) % 3];
      return (e[m] as number) * (f[o] as number) - (e[o] as number) * (f[m] as number);
    });
    const area = Math.hypot(...cross);
    if (!(uvArea > 0) || !(area > 0)) continue;
    // The nearest point is not nearer: of large triangles the part towards the camera counts.
    const centre = p.map((x, n) => (x + (q[n] as number) + (r[n] as number)) / 3);
    const radius = Math.max(
      ...[p, q, r].map((corner) => Math.hypot(...corner.map((x, n) => x - (centre[n] as number)))),
    );
    const toPlane = Math.abs(cross.reduce((sum, x, n) => sum + x * (p[n] as number), 0)) / area;
    const distance = Math.max(toPlane, Math.hypot(...centre) - radius);
    const pixel = Math.max(pixelAt(distance), 1e-12);
    yield { pixels: Math.sqrt(area / uvArea) / pixel, weight: area / pixel ** 2 };
  }
}

/**
 * For each texture, the size in pixels that its unit square has on screen where it is seen largest: for a texture of n
 * texels, log₂(n / size) is the level with texels as large as pixels. Seen face on, from `camera`, in an image of `height`
 * rows; occlusion, reflections and what lies behind the camera are not distinguished. Absent: no triangle shows it.
 */
export function* textureSizesOnScreen(scene: Scene, camera: Camera, height: number): Steps<Map<number, number>> {
  const pixelAt = pixelSize(camera, height);
  const eye = [12, 13, 14].map((i) => camera.transform[i] as number);
  const sizes = new Map<number, number>();
  const mappings = scene.materials.map(mappingsOf);
  const mapped = (instance: Instance) => materialsOf(instance).flatMap((material) => mappings[material] ?? []);
  const count = scene.instances.reduce((sum, instance) => sum + mapped(instance).length, 0);
  const samples = Math.max(1, Math.min(TRIANGLES, Math.floor(SAMPLES / count)));
  for (const instance of scene.instances) {
    const mesh = scene.meshes[instance.mesh] as Mesh;
    for (const { uv, transform, textures } of mapped(instance)) {
      const seen = [...seenTriangles(mesh, instance.transform, uv, transform, eye, pixelAt, samples)];
      seen.sort((x, y) => y.pixels - x.pixels);
      let left = FINER * seen.reduce((sum, { weight }) => sum + weight, 0);
      const largest = seen.find(({ weight }) => (left -= weight) < 0)?.pixels ?? 0;
      for (const texture of textures) sizes.set(texture, Math.max(sizes.get(texture) ?? 0, largest));
      yield;
    }
  }
  return sizes;
}

/** The material of an instance, and those of its variants. */
const materialsOf = ({ material, variants }: Instance): number[] => [
  ...new Set([material, ...Object.values(variants ?? {})]),
];

/** Textures that lie alike on a surface. */
interface Mapping {
  readonly uv: number;
  readonly transform: NonNullable<TextureBinding['transform']>;
  readonly textures: Set<number>;
}

/** The textures of a material; most materials map all of them alike. */
function mappingsOf({ textures }: Material): Mapping[] {
  const mappings = new Map<string, Mapping>();
  for (const binding of Object.values(textures ?? {}) as (TextureBinding | undefined)[]) {
    if (!binding) continue;
    const { texture, uv = 0, transform = [1, 0, 0, 1, 0, 0] } = binding;
    const key = `${uv} ${[...transform].slice(0, 4)}`;
    const mapping = mappings.get(key) ?? { uv, transform, textures: new Set() };
    mapping.textures.add(texture);
    mappings.set(key, mapping);
  }
  return [...mappings.values()];
}
