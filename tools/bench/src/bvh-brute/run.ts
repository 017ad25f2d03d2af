import {
  buildBlas,
  buildTlas,
  type Blas,
  type BlasMesh,
  type BlasOptions,
  type Tlas,
  type TriangleMesh,
} from '@glanz/bvh';
import { refitBlas } from '@glanz/bvh/refit';
import { closestHitWide, widenBlas } from '@glanz/bvh/wide';
import { anyHitBatch, anyHitBatchInstances, closestHitBatch, closestHitBatchInstances } from '@glanz/bvh/batch';
import type { GpuTracer } from './gpu';
import { Oracle } from './oracle';
import { randomNumbers } from './random';
import {
  cornersOf,
  randomInstances,
  randomMesh,
  randomRays,
  type Corners,
  type RandomInstance,
  type RandomRays,
} from './scenes';

/** What builds the tree of a mesh. */
export type BuildTree = (mesh: TriangleMesh, options: BlasOptions) => Blas | Promise<Blas>;

/** What random scenes are tried with. */
export interface BruteOptions {
  readonly seed: number;
  readonly scenes: number;
  readonly raysPerScene: number;
  /** One of this many rays is traced on the GPU, too. */
  readonly gpuEvery: number;
  /** One for each layout. */
  readonly gpus?: readonly GpuTracer[];
  /** Ways to build, tried in turn. */
  readonly builders: readonly BlasOptions[];
  /** Default `buildBlas`. */
  readonly build?: BuildTree;
  log(line: string): void;
}

/** What was tried and found wrong. */
export interface BruteTotals {
  rays: number;
  hits: number;
  /**
   * Rays whose answer, on the CPU, is not between the oracle's bounds; anyHit that contradicts closestHit; rays out of
   * closed meshes.
   */
  wrong: number;
  /** Of them through the wide layout as well, for which the same holds. */
  wideRays: number;
  /**
   * Rays that the oracle could not bound: degenerate triangles in their way. They count as right only within its
   * bounds.
   */
  loose: number;
  gpuRays: number;
  /** The same for the GPU, within single precision. */
  gpuWrong: number;
  /** Rays past an edge so near that single precision may take either side. */
  gpuMarginal: number;
}

const IDENTITY = Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);

/** One of this many rays is traced in the wide layout, too. */
const WIDE_EVERY = 4;

/** A seed of one scene. */
const sceneSeed = (seed: number, scene: number): number =>
  (Math.imul(seed, 0x01000193) ^ Math.imul(scene + 1, 0x9e3779b1)) >>> 0;

interface Built {
  readonly instances: readonly RandomInstance[];
  readonly parts: readonly BlasMesh[];
  readonly tlas: Tlas;
  /** One mesh where it is: queries of one level. */
  readonly single: BlasMesh | undefined;
  readonly closed: boolean;
  readonly name: string;
}

async function build(
  scene: number,
  random: () => number,
  builders: readonly BlasOptions[],
  buildTree: BuildTree,
): Promise<Built> {
  const single = random() < 0.7;
  const instances = single ? [{ mesh: randomMesh(random), transform: IDENTITY }] : randomInstances(random);
  const options: BlasOptions = {
    ...builders[scene % builders.length],
    maxLeafTriangles: 1 + Math.floor(16 * random() ** 2),
  };
  const blases = new Map<object, Blas>();
  const refitted = random() < 0.15;
  for (const { mesh } of instances) {
    if (blases.has(mesh)) continue;
    let blas: Blas;
    if (refitted && mesh.positions.every(Number.isFinite)) {
      // Built elsewhere, then refitted to where it is.
      blas = await buildTree(
        { positions: mesh.positions.map((x, i) => x * (1 + 0.5 * Math.sin(i))), indices: mesh.indices },
        options,
      );
      refitBlas(blas, mesh);
    } else blas = await buildTree(mesh, options);
    blases.set(mesh, blas);
  }
  const parts = instances.map(({ mesh }) => ({ blas: blases.get(mesh)!, mesh }));
  const tlas = buildTlas(instances.map(({ mesh, transform }) => ({ bounds: blases.get(mesh)!.bounds, transform })));
  return {
    instances,
    parts,
    tlas,
    single: single ? parts[0] : undefined,
    closed: single && instances[0]!.mesh.closed,
    name: `${single ? '' : 'instances of '}${[...new Set(instances.map(({ mesh }) => mesh.kind))].join(', ')}${refitted ? ', refitted' : ''}`,
  };
}

function checkCpu(
  { single, tlas, parts, name }: Built,
  { corners }: Corners,
  { rays, enclosed }: RandomRays,
  totals: BruteTotals,
  complain: (line: string) => void,
): { t: Float64Array; triangle: Int32Array; instance: Int32Array } {
  const count = enclosed.length;
  const out = { t: new Float64Array(count), triangle: new Int32Array(count), instance: new Int32Array(count) };
  const any = new Uint8Array(count);
  // One mesh is queried through both levels in turn with through one.
  if (single) {
    closestHitBatch(single.blas, single.mesh, rays, { t: out.t, triangle: out.triangle });
    anyHitBatchInstances(tlas, parts, rays, any);
  } else {
    closestHitBatchInstances(tlas, parts, rays, out);
    anyHitBatchInstances(tlas, parts, rays, any);
  }
  if (single) {
    const one = new Uint8Array(count);
    anyHitBatch(single.blas, single.mesh, rays, one);
    if (one.some((hit, i) => hit !== any[i])) complain(`${name}: one level and two disagree`);
  }
  // Matrices of instances make the rounding of coordinates up to some hundred times larger, there and back.
  const oracle = new Oracle(corners, single ? 0 : 2 ** -42);
  const wide = single && widenBlas(single.blas);
  for (let i = 0; i < count; i++) {
    oracle.ask(rays, 8 * i);
    const t = out.t[i]!;
    totals.rays++;
    if (t < Infinity) totals.hits++;
    // A hit that is certain must be met, and none before it can be.
    if (oracle.low < oracle.high && oracle.high - oracle.low > 1e-6 * oracle.high) totals.loose++;
    let problem = '';
    if (t < oracle.low || t > oracle.high) problem = `t is ${t}, not from ${oracle.low} to ${oracle.high}`;
    else if ((any[i] === 1) !== t < Infinity) problem = `anyHit says ${any[i]}, closestHit ${t}`;
    else if (enclosed[i] && !(t < Infinity)) problem = 'a ray gets out of a closed mesh';
    if (!problem && single && wide && i % WIDE_EVERY === 0) {
      totals.wideRays++;
      const [ox, oy, oz, tMin, dx, dy, dz, tMax] = rays.subarray(8 * i, 8 * i + 8) as unknown as [
        number,
        number,
        number,
        number,
        number,
        number,
        number,
        number,
      ];
      const found =
        closestHitWide(wide, single.mesh, { origin: [ox, oy, oz], direction: [dx, dy, dz], tMin, tMax })?.t ?? Infinity;
      if (found !== t) problem = `the wide layout finds ${found}, the binary one ${t}`;
    }
    if (!problem) continue;
    totals.wrong++;
    complain(`${name}: ray ${i} (${[...rays.subarray(8 * i, 8 * i + 8)].join(', ')}): ${problem}`);
  }
  return out;
}

/**
 * A triangle as a ray sees it: the ray's distance from the edges, the cosine, and how far rounding of the edge
 * functions can move the hit along the triangle: far for one that looks thin.
 */
export function facing(
  corners: Float64Array,
  at: number,
  rays: Float32Array,
  ray: number,
  reach: number,
): { edges: number; cosine: number; tolerance: number } {
  const [ox, oy, oz, , dx, dy, dz] = rays.subarray(8 * ray, 8 * ray + 7) as unknown as [
    number,
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  const length = Math.hypot(dx, dy, dz);
  const n = [dx / length, dy / length, dz / length] as const;
  const flat = [0, 3, 6].map((k) => {
    const v = [corners[at + k]! - ox, corners[at + k + 1]! - oy, corners[at + k + 2]! - oz] as const;
    const along = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];
    return [v[0] - along * n[0], v[1] - along * n[1], v[2] - along * n[2]] as const;
  });
  let edges = Infinity,
    largest = 0;
  for (let k = 0; k < 3; k++) {
    const a = flat[k]!,
      b = flat[(k + 1) % 3]!;
    largest = Math.max(largest, Math.hypot(...a));
    const e = [b[0] - a[0], b[1] - a[1], b[2] - a[2]] as const;
    const squared = e[0] ** 2 + e[1] ** 2 + e[2] ** 2;
    const s = squared > 0 ? Math.min(1, Math.max(0, -(a[0] * e[0] + a[1] * e[1] + a[2] * e[2]) / squared)) : 0;
    edges = Math.min(edges, Math.hypot(a[0] + s * e[0], a[1] + s * e[1], a[2] + s * e[2]));
  }
  const [p, q, r] = flat as unknown as [number[], number[], number[]];
  const normal = (a: number, b: number) => (q[a]! - p[a]!) * (r[b]! - p[b]!) - (q[b]! - p[b]!) * (r[a]! - p[a]!);
  const area = Math.hypot(normal(0, 1), normal(1, 2), normal(2, 0));
  const e = [0, 1, 2].map((k) => corners[at + 3 + k]! - corners[at + k]!),
    f = [0, 1, 2].map((k) => corners[at + 6 + k]! - corners[at + k]!);
  const c = [e[1]! * f[2]! - e[2]! * f[1]!, e[2]! * f[0]! - e[0]! * f[2]!, e[0]! * f[1]! - e[1]! * f[0]!];
  return {
    edges,
    cosine: Math.abs(c[0]! * n[0] + c[1]! * n[1] + c[2]! * n[2]) / (Math.hypot(...c) || 1),
    // A point on the ray is where it is.
    tolerance: largest > 0 ? Math.min(largest, ((reach + 2 ** -20 * largest) * largest ** 2) / area) : 0,
  };
}

async function checkGpu(
  gpu: GpuTracer,
  { tlas, parts, single, name }: Built,
  { corners, names }: Corners,
  all: RandomRays,
  every: number,
  cpu: { t: Float64Array; triangle: Int32Array; instance: Int32Array },
  totals: BruteTotals,
  complain: (line: string) => void,
): Promise<void> {
  if (tlas.instanceOrder.length === 0) return;
  const picked: number[] = [];
  for (let i = 0; i < all.enclosed.length; i += every) picked.push(i);
  const rays = new Float32Array(8 * picked.length);
  picked.forEach((ray, i) => rays.set(all.rays.subarray(8 * ray, 8 * ray + 8), 8 * i));
  const hits = await gpu.trace(tlas, parts, rays);
  const where = new Map<number, number>();
  for (let i = 0; i < names.length; i += 2) where.set(names[i]! * 2 ** 24 + names[i + 1]!, (9 * i) / 2);
  const size = corners.reduce((max, x) => Math.max(max, Math.abs(x)), 0);
  picked.forEach((ray, i) => {
    const o = rays.subarray(8 * i, 8 * i + 3),
      d = rays.subarray(8 * i + 4, 8 * i + 7),
      tMin = rays[8 * i + 3]!,
      tMax = rays[8 * i + 7]!;
    const length = Math.hypot(...d);
    // Vertices, the origin, and what comes of them by a few operations are rounded to 2^-24 of themselves; matrices of
    // instances, whose numbers are up to some ten times larger the other way, make more of it.
    const reach = (size + Math.hypot(...o)) * (single ? 16 : 256) * 2 ** -24;
    totals.gpuRays++;
    const hit = hits.instance[i] !== 0xffffffff;
    const t = hits.t[i]!;
    let problem = '';
    if (hit !== (hits.any[i] === 1)) {
      // The two may differ where the first found would be the only one, by rounding.
      problem = `any hit says ${hits.any[i]}, closest hit ${t}`;
    } else if (all.enclosed[ray] && !hit) problem = 'a ray gets out of a closed mesh';
    else if (hit) {
      const at = where.get(hits.instance[i]! * 2 ** 24 + hits.triangle[i]!);
      if (at === undefined)
        problem = `hit triangle ${hits.triangle[i]} of instance ${hits.instance[i]}, which cannot be hit`;
      else {
        const u = hits.u[i]!,
          v = hits.v[i]!;
        const off = Math.hypot(
          ...[0, 1, 2].map(
            (k) =>
              (1 - u - v) * corners[at + k]! + u * corners[at + 3 + k]! + v * corners[at + 6 + k]! - o[k]! - t * d[k]!,
          ),
        );
        // What is beside the ray in the world is also before or behind in a sheared object's space.
        const rounding = reach + (single ? 1 : 8) * facing(corners, at, rays, i, reach).tolerance;
        if (!(off <= rounding) || !(u >= 0 && v >= 0 && u + v <= 1.000001))
          problem = `the hit (t ${t}, u ${u}, v ${v}) is ${off} off its triangle; ${rounding} would be rounding`;
        else if (!(t > tMin && t < tMax)) problem = `t ${t} is not between ${tMin} and ${tMax}`;
      }
    }
    const expected = cpu.t[ray]!;
    if (!problem && expected < Infinity && (!hit || t > expected)) {
      const at = where.get((single ? 0 : cpu.instance[ray]!) * 2 ** 24 + cpu.triangle[ray]!)!;
      const { edges, cosine } = facing(corners, at, rays, i, reach);
      const along = reach / Math.max(cosine, 1e-6) / length;
      if (!hit || t > expected + along) {
        // Either the GPU has lost a hit, or the ray passes within rounding of an edge, along the triangle, or an end.
        if (edges <= reach || cosine < 1e-3 || expected - along <= tMin || expected + along >= tMax)
          totals.gpuMarginal++;
        else
          problem = `t is ${hit ? t : 'a miss'}, not ${expected}; ${edges} from the edges, where ${reach} would be rounding`;
      }
    }
    if (!problem) return;
    totals.gpuWrong++;
    complain(
      `${name}, GPU, ${gpu.layout} layout: ray ${ray} (${[...rays.subarray(8 * i, 8 * i + 8)].join(', ')}): ${problem}`,
    );
  });
}

/** Tries rays through random scenes. The same options try the same. */
export async function tryScenes({
  seed,
  scenes,
  raysPerScene,
  gpuEvery,
  gpus = [],
  builders,
  build: buildTree = buildBlas,
  log,
}: BruteOptions): Promise<BruteTotals> {
  const totals: BruteTotals = {
    rays: 0,
    hits: 0,
    wrong: 0,
    wideRays: 0,
    loose: 0,
    gpuRays: 0,
    gpuWrong: 0,
    gpuMarginal: 0,
  };
  let complaints = 0;
  for (let scene = 0; scene < scenes; scene++) {
    const random = randomNumbers(sceneSeed(seed, scene));
    const built = await build(scene, random, builders, buildTree);
    const corners = cornersOf(built.instances);
    const rays = randomRays(raysPerScene, corners, built.closed, random);
    const complain = (line: string) => {
      if (complaints++ < 50) log(`seed ${seed}, scene ${scene}: ${line}`);
    };
    const cpu = checkCpu(built, corners, rays, totals, complain);
    for (const gpu of gpus) await checkGpu(gpu, built, corners, rays, gpuEvery, cpu, totals, complain);
    if ((scene + 1) % 100 === 0)
      log(
        `${scene + 1} of ${scenes} scenes, ${totals.rays} rays, ${totals.wrong} wrong; GPU ${totals.gpuRays} rays, ${totals.gpuWrong} wrong`,
      );
  }
  return totals;
}
