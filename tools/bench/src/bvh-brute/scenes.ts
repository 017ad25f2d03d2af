import { randomDirection } from './random';

/** A mesh of a random scene. */
export interface RandomMesh {
  readonly kind: string;
  readonly positions: Float32Array<ArrayBuffer>;
  readonly indices: Uint32Array<ArrayBuffer>;
  /** No ray from a point near the middle gets out. */
  readonly closed: boolean;
}

/** A mesh, placed. */
export interface RandomInstance {
  readonly mesh: RandomMesh;
  /** Object to world, column-major 4×4; numbers that single precision holds. */
  readonly transform: Float32Array<ArrayBuffer>;
}

type Random = () => number;

const counted = (count: number) => Uint32Array.from({ length: count }, (_, i) => i);

/** Triangles of one size, or of all, around the origin; no two share a vertex. */
function strewn(random: Random): RandomMesh {
  const count = 1 + Math.floor(600 * random() ** 2),
    size = 10 ** (0.5 - 2.5 * random()),
    mixed = random() < 0.3;
  const positions = new Float32Array(9 * count);
  for (let i = 0; i < count; i++) {
    const own = mixed ? 10 ** (0.3 - 3 * random()) : size;
    for (let k = 0; k < 3; k++) {
      const center = 2 * random() - 1;
      for (let corner = 0; corner < 3; corner++) positions[9 * i + 3 * corner + k] = center + own * (random() - 0.5);
    }
  }
  return { kind: 'strewn', positions, indices: counted(3 * count), closed: false };
}

/** Triangles many times as long as wide. */
function slivers(random: Random): RandomMesh {
  const count = 1 + Math.floor(300 * random());
  const positions = new Float32Array(9 * count);
  for (let i = 0; i < count; i++) {
    const center = [0, 1, 2].map(() => 2 * random() - 1),
      along = randomDirection(random),
      across = randomDirection(random);
    const length = 3 * random(),
      width = length * 10 ** (-1 - 3 * random());
    for (let k = 0; k < 3; k++) {
      positions[9 * i + k] = center[k]! - length * along[k]!;
      positions[9 * i + 3 + k] = center[k]! + length * along[k]!;
      positions[9 * i + 6 + k] = center[k]! + length * (random() - 0.5) * along[k]! + width * across[k]!;
    }
  }
  return { kind: 'slivers', positions, indices: counted(3 * count), closed: false };
}

/** A welded ball, bumpy or smooth. */
function ball(random: Random): RandomMesh {
  const segments = 4 + 2 * Math.floor(16 * random()),
    rings = segments / 2,
    bumps = 0.3 * random();
  const positions: number[] = [],
    indices: number[] = [];
  const put = (theta: number, phi: number) => {
    const r = 1 + bumps * (random() - 0.5);
    positions.push(r * Math.sin(theta) * Math.cos(phi), r * Math.cos(theta), r * Math.sin(theta) * Math.sin(phi));
  };
  put(0, 0);
  for (let i = 1; i < rings; i++)
    for (let j = 0; j < segments; j++) put((i * Math.PI) / rings, (j * 2 * Math.PI) / segments);
  put(Math.PI, 0);
  const at = (i: number, j: number) => 1 + (i - 1) * segments + (j % segments),
    last = 1 + (rings - 1) * segments;
  for (let j = 0; j < segments; j++) {
    indices.push(0, at(1, j + 1), at(1, j));
    for (let i = 1; i < rings - 1; i++)
      indices.push(at(i, j), at(i, j + 1), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
    indices.push(last, at(rings - 1, j), at(rings - 1, j + 1));
  }
  return { kind: 'ball', positions: new Float32Array(positions), indices: new Uint32Array(indices), closed: true };
}

/** A box whose faces are grids: boxes of the tree touch in planes, along which rays go. */
function gridBox(random: Random): RandomMesh {
  const n = 1 + Math.floor(8 * random());
  const positions: number[] = [],
    indices: number[] = [];
  for (let axis = 0; axis < 3; axis++) {
    for (const side of [-1, 1]) {
      const base = positions.length / 3;
      for (let i = 0; i <= n; i++) {
        for (let j = 0; j <= n; j++) {
          const point = [0, 0, 0];
          point[axis] = side;
          point[(axis + 1) % 3] = (2 * i) / n - 1;
          point[(axis + 2) % 3] = (2 * j) / n - 1;
          positions.push(...point);
        }
      }
      for (let i = 0; i < n; i++) {
        for (let j = 0; j < n; j++) {
          const a = base + i * (n + 1) + j,
            b = a + n + 1;
          indices.push(a, b, b + 1, a, b + 1, a + 1);
        }
      }
    }
  }
  return {
    kind: 'box of grids',
    positions: new Float32Array(positions),
    indices: new Uint32Array(indices),
    closed: true,
  };
}

/** Layers of triangles in one plane, many of them the same. */
function stack(random: Random): RandomMesh {
  const count = 2 + Math.floor(400 * random()),
    kinds = 1 + Math.floor(5 * random()),
    gap = random() < 0.5 ? 0 : 1e-3;
  const shapes = Array.from({ length: kinds }, () => Array.from({ length: 6 }, () => 2 * random() - 1));
  const positions = new Float32Array(9 * count);
  for (let i = 0; i < count; i++) {
    const shape = shapes[Math.floor(kinds * random())]!;
    for (let corner = 0; corner < 3; corner++)
      positions.set([shape[2 * corner]!, gap * Math.floor(i / 7), shape[2 * corner + 1]!], 9 * i + 3 * corner);
  }
  return { kind: 'stack', positions, indices: counted(3 * count), closed: false };
}

/** Sizes and places that double from one triangle to the next: what makes trees deep. */
function doubling(random: Random): RandomMesh {
  const count = 10 + Math.floor(60 * random()),
    factor = 1.1 + random();
  const positions = new Float32Array(9 * count);
  const axis = Math.floor(3 * random());
  for (let i = 0; i < count; i++) {
    const x = factor ** (i - count);
    for (let corner = 0; corner < 3; corner++) {
      for (let k = 0; k < 3; k++)
        positions[9 * i + 3 * corner + k] =
          k === axis ? x * (1 + 0.01 * random()) : 0.5 * x * (random() - 0.5) * (random() < 0.5 ? 1 : 10);
    }
  }
  return { kind: 'doubling', positions, indices: counted(3 * count), closed: false };
}

/** Good triangles among points, segments, and triangles that are not finite. */
function spoilt(random: Random): RandomMesh {
  const mesh = strewn(random);
  const { positions } = mesh;
  for (let i = 0; i < positions.length; i += 9) {
    const fate = random();
    if (fate < 0.1) positions[i + Math.floor(9 * random())] = [NaN, Infinity, -Infinity][Math.floor(3 * random())]!;
    else if (fate < 0.2) positions.copyWithin(i + 3, i, i + 3);
    else if (fate < 0.25) {
      positions.copyWithin(i + 3, i, i + 3);
      positions.copyWithin(i + 6, i, i + 3);
    }
  }
  return { ...mesh, kind: 'spoilt' };
}

/** A surface of heights over a grid. */
function terrain(random: Random): RandomMesh {
  const n = 2 + Math.floor(20 * random()),
    height = 10 ** (-2 * random());
  const positions: number[] = [],
    indices: number[] = [];
  for (let i = 0; i <= n; i++)
    for (let j = 0; j <= n; j++) positions.push((2 * i) / n - 1, height * (random() - 0.5), (2 * j) / n - 1);
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      const a = i * (n + 1) + j,
        b = a + n + 1;
      indices.push(a, a + 1, b, a + 1, b + 1, b);
    }
  }
  return { kind: 'terrain', positions: new Float32Array(positions), indices: new Uint32Array(indices), closed: false };
}

const KINDS = [strewn, strewn, slivers, ball, ball, gridBox, stack, doubling, spoilt, terrain] as const;

/** The same mesh at another size and place: from 1 mm to 10 km, near and far from the origin. */
function placed(mesh: RandomMesh, random: Random): RandomMesh {
  const size = random() < 0.5 ? 1 : 10 ** (-3 + 7 * random()),
    far = random() < 0.3 ? size * 10 ** (2 * random()) : 0;
  const move = [0, 1, 2].map(() => far * (random() - 0.5));
  return { ...mesh, positions: mesh.positions.map((x, i) => x * size + move[i % 3]!) };
}

/** A mesh of any kind. */
export function randomMesh(random: Random): RandomMesh {
  return placed(KINDS[Math.floor(KINDS.length * random())]!(random), random);
}

/** Up to 20 instances of up to three meshes of size 1, turned, stretched, sheared and mirrored. */
export function randomInstances(random: Random): RandomInstance[] {
  const meshes = Array.from({ length: 1 + Math.floor(3 * random()) }, () =>
    KINDS[Math.floor(KINDS.length * random())]!(random),
  );
  return Array.from({ length: 1 + Math.floor(20 * random()) }, () => {
    const m = new Float32Array(16);
    m[15] = 1;
    let determinant = 0;
    while (Math.abs(determinant) < 0.02) {
      for (let c = 0; c < 3; c++) for (let r = 0; r < 3; r++) m[4 * c + r] = 1.4 * (random() - 0.5);
      determinant =
        m[0]! * (m[5]! * m[10]! - m[6]! * m[9]!) -
        m[4]! * (m[1]! * m[10]! - m[2]! * m[9]!) +
        m[8]! * (m[1]! * m[6]! - m[2]! * m[5]!);
    }
    for (let r = 0; r < 3; r++) m[12 + r] = 4 * (random() - 0.5);
    return { mesh: meshes[Math.floor(meshes.length * random())]!, transform: m };
  });
}

/**
 * Corners of triangles in the world, 9 numbers each, in double precision; those that are not finite are left out, as
 * the builders do.
 */
export interface Corners {
  readonly corners: Float64Array;
  /** Instance and triangle of the mesh, two numbers each. */
  readonly names: Uint32Array;
}

/** Every triangle of instances, in the world. */
export function cornersOf(instances: readonly RandomInstance[]): Corners {
  const corners: number[] = [],
    names: number[] = [];
  instances.forEach(({ mesh: { positions: p, indices }, transform: m }, instance) => {
    for (let t = 0; t < indices.length / 3; t++) {
      const own: number[] = [];
      let finite = true;
      for (let c = 0; c < 3; c++) {
        const v = 3 * indices[3 * t + c]!;
        finite &&= Number.isFinite(p[v]! + p[v + 1]! + p[v + 2]!);
        for (let r = 0; r < 3; r++)
          own.push(m[r]! * p[v]! + m[4 + r]! * p[v + 1]! + m[8 + r]! * p[v + 2]! + m[12 + r]!);
      }
      if (!finite) continue;
      corners.push(...own);
      names.push(instance, t);
    }
  });
  return { corners: Float64Array.from(corners), names: Uint32Array.from(names) };
}

/** Rays of a batch, and which of them cannot get out of a closed mesh. */
export interface RandomRays {
  /** 8 numbers each: origin, tMin, direction, tMax. */
  readonly rays: Float32Array<ArrayBuffer>;
  readonly enclosed: Uint8Array;
}

/**
 * Rays of all kinds: from around and from within, at anything and at points of the surface, at vertices and edges;
 * along axes; with directions of any length and with short intervals.
 */
export function randomRays(count: number, { corners }: Corners, closed: boolean, random: Random): RandomRays {
  const rays = new Float32Array(8 * count),
    enclosed = new Uint8Array(count);
  const min = [Infinity, Infinity, Infinity],
    max = [-Infinity, -Infinity, -Infinity];
  corners.forEach((x, i) => {
    min[i % 3] = Math.min(min[i % 3]!, x);
    max[i % 3] = Math.max(max[i % 3]!, x);
  });
  if (corners.length === 0) for (let k = 0; k < 3; k++) [min[k], max[k]] = [-1, 1];
  const center = min.map((x, k) => (x + max[k]!) / 2),
    half = min.map((x, k) => (max[k]! - x) / 2),
    radius = Math.hypot(...half);
  const aim = (sharp: boolean): number[] => {
    if (corners.length === 0) return center;
    const t = 9 * Math.floor((corners.length / 9) * random());
    let u = random(),
      v = random();
    if (u + v > 1) [u, v] = [1 - u, 1 - v];
    if (sharp) [u, v] = random() < 0.3 ? [0, 0] : random() < 0.5 ? [0, v] : [u, 1 - u];
    return [0, 1, 2].map(
      (k) =>
        corners[t + k]! + u * (corners[t + 3 + k]! - corners[t + k]!) + v * (corners[t + 6 + k]! - corners[t + k]!),
    );
  };
  for (let i = 0; i < count; i++) {
    const within = random() < 0.4;
    // Balls are bumpy: what is safely within is a tenth of the way out.
    const out = within ? 0.1 : 1 + 2 * random();
    const origin = randomDirection(random).map((x, k) => center[k]! + x * (within ? out * half[k]! : out * radius));
    const kind = random();
    let direction: number[];
    if (kind < 0.1) {
      direction = [0, 0, 0];
      direction[Math.floor(3 * random())] = random() < 0.5 ? -1 : 1;
      // Along a plane in which boxes touch, perhaps.
      if (random() < 0.5) aim(true).forEach((x, k) => direction[k] === 0 && !within && (origin[k] = x));
    } else if (kind < 0.3) direction = randomDirection(random);
    else if (kind < 0.4) direction = center.map((x, k) => x + half[k]! * (2 * random() - 1) - origin[k]!);
    else direction = aim(kind > 0.7).map((x, k) => x - origin[k]!);
    const length = random() < 0.7 ? 1 : 10 ** (6 * random() - 3);
    const short = !within && random() < 0.1;
    rays.set([...origin, 0, ...direction.map((x) => x * length), 3e38], 8 * i);
    if (short) {
      // Distances are about the size of things over the length of the direction.
      const unit = radius / Math.hypot(rays[8 * i + 4]!, rays[8 * i + 5]!, rays[8 * i + 6]!);
      rays[8 * i + 3] = unit * random();
      rays[8 * i + 7] = unit * (1 + 2 * random());
    }
    if (within && closed) enclosed[i] = 1;
    if (rays[8 * i + 4] === 0 && rays[8 * i + 5] === 0 && rays[8 * i + 6] === 0) rays[8 * i + 4] = 1;
  }
  return { rays, enclosed };
}
