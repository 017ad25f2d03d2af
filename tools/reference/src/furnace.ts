import { createScene, type Material, type Mesh, type Scene } from '@glanz/scene';
import { renderImage } from './render';

/**
 * A ball of flat triangles, radius 1: an icosahedron with each edge halved `levels` times. Flat shading is on purpose:
 * a convex polyhedron returns exactly its albedo in a furnace, whereas interpolated normals would add their own error.
 */
export function icosphere(levels: number): Mesh {
  const t = (1 + Math.sqrt(5)) / 2;
  let points = [
    [-1, t, 0],
    [1, t, 0],
    [-1, -t, 0],
    [1, -t, 0],
    [0, -1, t],
    [0, 1, t],
    [0, -1, -t],
    [0, 1, -t],
    [t, 0, -1],
    [t, 0, 1],
    [-t, 0, -1],
    [-t, 0, 1],
  ].map((p) => p.map((x) => x / Math.hypot(...p)));
  let faces = [
    [0, 11, 5],
    [0, 5, 1],
    [0, 1, 7],
    [0, 7, 10],
    [0, 10, 11],
    [1, 5, 9],
    [5, 11, 4],
    [11, 10, 2],
    [10, 7, 6],
    [7, 1, 8],
    [3, 9, 4],
    [3, 4, 2],
    [3, 2, 6],
    [3, 6, 8],
    [3, 8, 9],
    [4, 9, 5],
    [2, 4, 11],
    [6, 2, 10],
    [8, 6, 7],
    [9, 8, 1],
  ];
  for (let level = 0; level < levels; level++) {
    const middles = new Map<string, number>();
    const middle = (a: number, b: number) => {
      const key = a < b ? `${a},${b}` : `${b},${a}`;
      let index = middles.get(key);
      if (index === undefined) {
        const m = points[a]!.map((x, k) => x + points[b]![k]!);
        index = points.push(m.map((x) => x / Math.hypot(...m))) - 1;
        middles.set(key, index);
      }
      return index;
    };
    points = [...points];
    faces = faces.flatMap(([a, b, c]) => {
      const [ab, bc, ca] = [middle(a!, b!), middle(b!, c!), middle(c!, a!)];
      return [
        [a!, ab, ca],
        [b!, bc, ab],
        [c!, ca, bc],
        [ab, bc, ca],
      ];
    });
  }
  return { name: 'ball', positions: Float32Array.from(points.flat()), indices: Uint32Array.from(faces.flat()) };
}

/** A ball of one material under light of radiance 1 from everywhere. A white one vanishes: every pixel is 1. */
export function furnaceScene(parameters: Material['parameters']): Scene {
  const scene = createScene('white furnace');
  scene.meshes.push(icosphere(4));
  scene.materials.push({ name: 'white', parameters });
  scene.instances.push({
    name: 'ball',
    mesh: 0,
    material: 0,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
  });
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  // Far off and narrow, so that view directions are nearly parallel; the ball fills 96 % of the height.
  scene.cameras.push({
    type: 'perspective',
    name: 'front',
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 20, 1],
    yfov: 2 * Math.asin(1 / 20 / 0.96),
    aspect: 1,
  });
  return scene;
}

/** Kinds of white material that {@link measureFurnace} knows. */
export const FURNACE_MATERIALS = {
  /** Oren–Nayar-like base alone; the roughness is that of the base. */
  diffuse: (roughness: number): Material['parameters'] => ({
    base_color: [1, 1, 1],
    base_weight: 1,
    base_diffuse_roughness: roughness,
    specular_weight: 0,
  }),
  metal: (roughness: number): Material['parameters'] => ({
    base_color: [1, 1, 1],
    base_weight: 1,
    base_metalness: 1,
    specular_color: [1, 1, 1],
    specular_roughness: roughness,
  }),
  /** A clear gloss of index 1.5 over a white base. */
  dielectric: (roughness: number): Material['parameters'] => ({
    base_color: [1, 1, 1],
    base_weight: 1,
    specular_roughness: roughness,
  }),
} as const;

/** Names of {@link FURNACE_MATERIALS}. */
export type FurnaceMaterial = keyof typeof FURNACE_MATERIALS;

/** What {@link measureFurnace} found, one value for each independent run. */
export interface FurnaceMeasurement {
  /** Mean over the ball. */
  readonly whole: readonly number[];
  /** Mean over its rim, where the view is more than 60° off the normal: the hardest part. */
  readonly rim: readonly number[];
}

/** Options for {@link measureFurnace}. */
export interface FurnaceOptions {
  readonly size?: number;
  readonly samples?: number;
  /** Independent runs, for an interval. */
  readonly runs?: number;
  readonly multipleScattering?: boolean;
}

/**
 * Renders a white ball in a white furnace and averages over it. Energy is kept where the mean is 1.
 *
 * @param roughness 0..1, in the parameter that the material has.
 */
export async function measureFurnace(
  device: GPUDevice,
  material: FurnaceMaterial,
  roughness: number,
  options: FurnaceOptions = {},
): Promise<FurnaceMeasurement> {
  const { size = 64, samples = 64, runs = 4, multipleScattering = true } = options;
  const scene = furnaceScene(FURNACE_MATERIALS[material](roughness));
  const whole: number[] = [];
  const rim: number[] = [];
  const radius = (size / 2) * 0.96;
  for (let run = 0; run < runs; run++) {
    const image = await renderImage(device, scene, {
      width: size,
      height: size,
      samples,
      seed: run + 1,
      maxDepth: 8,
      multipleScattering,
    });
    let [sum, count, rimSum, rimCount] = [0, 0, 0, 0];
    for (let y = 0; y < size; y++) {
      for (let x = 0; x < size; x++) {
        // Pixels wholly on the ball; the facets make it a little smaller than its radius.
        const distance = Math.hypot(x + 0.5 - size / 2, y + 0.5 - size / 2) + 0.75;
        if (distance > radius * 0.997) continue;
        const i = (y * size + x) * 3;
        const value = (image[i]! + image[i + 1]! + image[i + 2]!) / 3;
        sum += value;
        count++;
        if (distance - 0.75 > radius * Math.sin((60 * Math.PI) / 180)) {
          rimSum += value;
          rimCount++;
        }
      }
    }
    whole.push(sum / count);
    rim.push(rimSum / rimCount);
  }
  return { whole, rim };
}
