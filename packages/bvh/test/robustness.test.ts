import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { compose, wgslModule } from '@glanz/wgsl';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { best, bestSplit } from '../src/builders/best';
import { fast } from '../src/builders/fast';
import { allHits } from '../src/cpu/all-hits';
import {
  anyHit,
  BLAS_MAX_DEPTH,
  buildBlas,
  buildTlas,
  closestHit,
  type BlasOptions,
  type TriangleMesh,
} from '../src/index';
import { bvhStatistics } from '../src/statistics';
import { widenBlas, widenTlas } from '../src/wide/index';
import { bvhBuffers, bvhClosestHit, bvhOffset, packHierarchy } from '../src/wgsl/index';
import { bvhClosestHit as bvhClosestHitWide } from '../src/wgsl/wide/index';
import { bruteForce, direction, randomNumbers, sphere } from './shapes';

const BUILDERS: readonly (readonly [string, BlasOptions])[] = [
  ['fast', { builder: fast }],
  ['balanced', {}],
  ['best', { builder: best }],
  ['best-split', { builder: bestSplit }],
];

/** Triangles by formula: nine numbers each. */
const triangles = (count: number, corners: (i: number) => readonly number[]): TriangleMesh => ({
  positions: Float32Array.from(Array.from({ length: count }, (_, i) => corners(i)).flat()),
});

/** Inputs that make trees deep, flat or degenerate, each with rays that must hit certain triangles. */
function adversaries(): [string, TriangleMesh][] {
  const random = randomNumbers(301);
  const flat = (x: number, size: number) => [x, 0, 0, x + size, 0, 0, x, size, 0];
  const shuffled = Array.from({ length: 200 }, (_, i) => i).sort(() => random() - 0.5);
  return [
    ['places that double', triangles(200, (i) => flat(2 ** (i / 2 - 50), 2 ** (i / 2 - 52)))],
    [
      'places that double, shuffled',
      triangles(200, (i) => flat(2 ** (shuffled[i]! / 2 - 50), 2 ** (shuffled[i]! / 2 - 52))),
    ],
    ['places that halve', triangles(200, (i) => flat(2 ** (50 - i / 2), 2 ** (48 - i / 2)))],
    ['one in another', triangles(120, (i) => [-1, -1, 0, 3, -1, 0, -1, 3, 0].map((x) => x * 1.5 ** (i - 60)))],
    [
      'one in another, in three directions',
      triangles(300, (i) =>
        [-1, -1, 0, 3, -1, 0, -1, 3, 0].map(
          (_, k, all) => all[3 * Math.floor(k / 3) + ((k + i) % 3)]! * 1.3 ** (Math.floor(i / 3) - 50),
        ),
      ),
    ],
    ['a stairway of tenths', triangles(500, (i) => flat(1 - 10 ** (-i / 80), 10 ** (-i / 80)))],
    ['10,000 identical ones', triangles(10_000, () => [0, 0, 0, 1, 0, 0, 0, 1, 0])],
    ['5,000 in two places', triangles(5_000, (i) => flat(i % 2 ? 1000 : 0, 1))],
    ['points on a line', triangles(1_000, (i) => [i, i, i, i, i, i, i, i, i])],
    ['tiny ones among huge ones', triangles(400, (i) => (i % 2 ? flat(i * 1e-6, 1e-7) : flat(-1e6, 2e6 + i)))],
    [
      'a fan around one vertex',
      triangles(600, (i) => [
        0,
        0,
        0,
        Math.cos(i / 95),
        Math.sin(i / 95),
        0.1,
        Math.cos((i + 1) / 95),
        Math.sin((i + 1) / 95),
        0.1,
      ]),
    ],
  ];
}

describe.each(BUILDERS)('%s', (_, options) => {
  test.each(adversaries())('bounded in depth, nothing lost: %s', (_name, mesh) => {
    const count = mesh.positions.length / 9;
    for (const maxLeafTriangles of [1, 4]) {
      const blas = buildBlas(mesh, { ...options, maxLeafTriangles });
      const { depth, leafSizes } = bvhStatistics(blas);
      expect(depth).toBeLessThanOrEqual(BLAS_MAX_DEPTH);
      expect(leafSizes.slice(maxLeafTriangles + 1).every((n) => n === 0)).toBe(true);
      expect(new Set(blas.triangleIndices).size).toBe(count);
      for (let i = 0; i < count; i += Math.ceil(count / 40)) {
        const p = mesh.positions.subarray(9 * i, 9 * i + 9);
        const size = Math.max(
          ...[0, 1, 2].map((k) => Math.max(p[k]!, p[3 + k]!, p[6 + k]!) - Math.min(p[k]!, p[3 + k]!, p[6 + k]!)),
        );
        const inside = [0, 1, 2].map((k) => 0.5 * p[k]! + 0.3 * p[3 + k]! + 0.2 * p[6 + k]!);
        const e = [0, 1, 2].map((k) => (p[3 + k]! - p[k]!) / (size || 1)),
          f = [0, 1, 2].map((k) => (p[6 + k]! - p[k]!) / (size || 1));
        const n = [e[1]! * f[2]! - e[2]! * f[1]!, e[2]! * f[0]! - e[0]! * f[2]!, e[0]! * f[1]! - e[1]! * f[0]!];
        const down = size > 0 ? n.map((x) => -x * size) : [0, 0, -1];
        const ray = { origin: inside.map((x, k) => x - down[k]!), direction: down };
        const hit = closestHit(blas, mesh, ray),
          expected = bruteForce(mesh, ray.origin, ray.direction);
        if (expected) expect(hit!.t).toBeCloseTo(expected.t, 9);
        // Points and lines may be met, nothing must.
        if (size > 0) expect(allHits(blas, mesh, ray).map(({ triangle }) => triangle)).toContain(i);
      }
    }
  });

  test('empty, one point, and only what is not finite', () => {
    for (const positions of [
      [],
      new Array<number>(9).fill(2),
      new Array<number>(18).fill(NaN),
      [Infinity, 0, 0, 1, 0, 0, 0, 1, 0],
    ]) {
      const mesh = { positions: new Float32Array(positions) };
      const blas = buildBlas(mesh, options);
      for (const d of [
        [0, 0, -1],
        [1, 1, 1],
        [-1, 0.5, 0],
      ])
        expect(anyHit(blas, mesh, { origin: [0.1, 0.2, 3], direction: d })).toBe(false);
    }
  });
});

describe('on the GPU', () => {
  let device: GPUDevice;
  beforeAll(async () => {
    device = await testDevice();
  });
  afterAll(() => expectNoGpuErrors());

  /** Paths of this many segments. */
  const BOUNCES = 12;

  /**
   * Paths inside closed meshes: from hit to hit, each segment from the offset origin on. Counts, of each path, the
   * hits; and how often a segment ends where it began.
   */
  async function bounce(
    mesh: TriangleMesh & { indices: Uint32Array },
    center: readonly number[],
    options: BlasOptions,
    layout: 'binary' | 'wide',
    paths: number,
    seed: number,
  ): Promise<{ short: number; repeated: number }> {
    const blas = buildBlas(mesh, options);
    const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    const binary = buildTlas([{ bounds: blas.bounds, transform: identity }]);
    const [tlas, tree] = layout === 'wide' ? [widenTlas(binary), widenBlas(blas)] : [binary, blas];
    const packed = packHierarchy(tlas, [{ blas: tree, mesh }]);
    const magnitude = mesh.positions.reduce((max, x) => Math.max(max, Math.abs(x)), 0);
    const host = wgslModule(
      'test/bounce',
      /* wgsl */ `
@group(0) @binding(3) var<storage, read_write> result: array<vec2u>;
var<private> state: u32;
fn random() -> f32 {
  state = state * 747796405u + 2891336453u;
  let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return f32(((word >> 22u) ^ word) >> 8u) / 16777216.0;
}
fn random_direction() -> vec3f {
  let z = 2.0 * random() - 1.0;
  let phi = 6.2831853 * random();
  return vec3f(sqrt(1.0 - z * z) * vec2f(cos(phi), sin(phi)), z);
}
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= ${paths}u) { return; }
  state = id.x * 9781u + ${seed}u;
  let center = vec3f(${center.map((x) => x.toExponential()).join(', ')});
  var origin = center;
  var direction = random_direction();
  var hits = 0u;
  var repeated = 0u;
  var last = 0xffffffffu;
  for (var i = 0u; i < ${BOUNCES}u; i++) {
    let hit = bvh_closest_hit(origin, direction, 0.0, 3e38);
    if (hit.instance == BVH_MISS) { break; }
    hits++;
    // The walls are flat or bent outward: none is met twice in a row.
    if (hit.triangle == last) { repeated++; }
    last = hit.triangle;
    let t = bvh_triangle(hit.triangle);
    let position = (1.0 - hit.u - hit.v) * t.v0 + hit.u * t.v1 + hit.v * t.v2;
    var normal = normalize(cross(t.v1 - t.v0, t.v2 - t.v0));
    if (dot(normal, direction) > 0.0) { normal = -normal; }
    origin = bvh_offset_origin(position, normal, ${magnitude.toExponential()});
    // Grazing ones, too.
    direction = random_direction();
    if (i % 3u == 0u) { direction -= 0.999 * dot(direction, normal) * normal; }
    if (dot(direction, normal) < 0.0) { direction -= 2.0 * dot(direction, normal) * normal; }
  }
  result[id.x] = vec2u(hits, repeated);
}`,
      [layout === 'wide' ? bvhClosestHitWide : bvhClosestHit, bvhBuffers(), bvhOffset],
    );
    const { code } = compose([host], { flags: { BVH_FILTER: false } });
    const result = new Uint32Array(
      await runCompute(device, code, {
        inputs: [packed.nodes, packed.triangles, packed.instances],
        outputBytes: 8 * paths,
        workgroups: Math.ceil(paths / 64),
      }),
    );
    let short = 0,
      repeated = 0;
    for (let i = 0; i < paths; i++) {
      if (result[2 * i] !== BOUNCES) short++;
      repeated += result[2 * i + 1]!;
    }
    return { short, repeated };
  }

  /** A box of six grids. */
  function room(size: number, center: readonly number[], n: number): { positions: Float32Array; indices: Uint32Array } {
    const positions: number[] = [],
      indices: number[] = [];
    for (let axis = 0; axis < 3; axis++)
      for (const side of [-1, 1]) {
        const base = positions.length / 3;
        for (let i = 0; i <= n; i++)
          for (let j = 0; j <= n; j++) {
            const point = [0, 0, 0];
            point[axis] = side;
            point[(axis + 1) % 3] = (2 * i) / n - 1;
            point[(axis + 2) % 3] = (2 * j) / n - 1;
            positions.push(...point.map((x, k) => (x * size) / 2 + center[k]!));
          }
        for (let i = 0; i < n; i++)
          for (let j = 0; j < n; j++) {
            const a = base + i * (n + 1) + j,
              b = a + n + 1;
            indices.push(a, b, b + 1, a, b + 1, a + 1);
          }
      }
    return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
  }

  for (const [scale, size, center] of [
    ['1 mm', 1e-3, [0, 0, 0]],
    ['1 mm, 3 mm from the origin', 1e-3, [0.003, -0.001, 0.002]],
    ['1 m', 1, [0.3, 0, 2]],
    ['10 km', 1e4, [0, 0, 0]],
    ['10 km, far out', 1e4, [3e4, -8e3, 1e4]],
  ] as const) {
    test(`paths in closed meshes of ${scale} never get out and never hit where they start (seed 302)`, async () => {
      for (const [i, [name, options]] of BUILDERS.entries()) {
        for (const [kind, mesh] of [
          ['room', room(size, center, 5)],
          ['ball', sphere(24, size / 2, center)],
        ] as const) {
          // Each compiles a pipeline.
          if (kind === 'ball' && i !== 1) continue;
          const found = await bounce(mesh, center, options, i % 2 ? 'wide' : 'binary', 1024, 302);
          expect({ name, kind, ...found }).toEqual({ name, kind, short: 0, repeated: 0 });
        }
      }
    });
  }
});

test('no ray aimed at vertices and edges gets out, by any builder, at 1 mm and 10 km, on the CPU (seed 303)', () => {
  const random = randomNumbers(303);
  for (const [size, center] of [
    [1e-3, [0.1, 0.02, -0.05]],
    [1e4, [3e4, 0, -8e3]],
  ] as const) {
    const mesh = sphere(24, size, center);
    for (const [, options] of BUILDERS) {
      const blas = buildBlas(mesh, options);
      for (let i = 0; i < mesh.indices.length; i++) {
        const [a, b] = [3 * mesh.indices[i]!, 3 * mesh.indices[i % 3 === 2 ? i - 2 : i + 1]!];
        const s = i % 2 ? 0 : random();
        const origin = direction(random).map((x, k) => 0.3 * size * x + center[k]!);
        expect(
          anyHit(blas, mesh, {
            origin,
            direction: origin.map((x, k) => (1 - s) * mesh.positions[a + k]! + s * mesh.positions[b + k]! - x),
          }),
        ).toBe(true);
      }
    }
  }
});
