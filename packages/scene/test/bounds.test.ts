import { expect, test } from 'vitest';
import { createScene, frameCamera, sceneBounds, type Scene } from '../src/index';
import { points, sample } from './sample';

test('the box of the used, visible vertices in the world', () => {
  const scene = sample();
  const all = points(scene);
  const { min, max } = sceneBounds(scene);
  for (const k of [0, 1, 2] as const) {
    expect(min[k]).toBeCloseTo(Math.min(...all.map((p) => p[k]!)), 12);
    expect(max[k]).toBeCloseTo(Math.max(...all.map((p) => p[k]!)), 12);
  }
  scene.instances[1]!.visible = false;
  expect(sceneBounds(scene)).toEqual({ min: [0, 0, 0], max: [2, 1, 3] });
});

test('a turned box is measured by its vertices, not by its turned box', () => {
  const scene = sample();
  const s = Math.SQRT1_2;
  scene.meshes[0]!.positions = new Float32Array([1, 0, 0, 0, 1, 0, -1, 0, 0]);
  scene.instances = [
    { name: 'turned', mesh: 0, material: 0, transform: [s, s, 0, 0, -s, s, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] },
  ];
  const { min, max } = sceneBounds(scene);
  // (1,0) → (s,s), (0,1) → (−s,s), (−1,0) → (−s,−s); the box of the unturned box would reach 2s.
  for (const [value, expected] of [
    [min[0], -s],
    [min[1], -s],
    [max[0], s],
    [max[1], s],
  ] as const)
    expect(value).toBeCloseTo(expected, 12);
});

test('an empty scene has an inverted box', () => {
  expect(sceneBounds(createScene())).toEqual({
    min: [Infinity, Infinity, Infinity],
    max: [-Infinity, -Infinity, -Infinity],
  });
});

const visiblePoints = (scene: Scene) =>
  points({ ...scene, instances: scene.instances.filter(({ visible }) => visible !== false) });

/** 4,096 turned, uneven balls of 200 vertices, strewn over a cube. */
function strewn(): Scene {
  const scene = createScene();
  const positions = Float32Array.from({ length: 600 }, (_, i) => Math.sin(12.9898 * i) * (1 + 0.3 * Math.cos(0.7 * i)));
  scene.meshes.push({ name: 'ball', positions, indices: Uint32Array.from({ length: 198 }, (_, i) => i) });
  scene.materials.push({ name: 'any', parameters: {} });
  for (let i = 0; i < 4096; i++) {
    const [c, s] = [Math.cos(i), Math.sin(i)];
    scene.instances.push({
      name: `ball ${i}`,
      mesh: 0,
      material: 0,
      visible: i % 7 !== 0,
      transform: [
        c,
        s,
        0,
        0,
        -s,
        c,
        0.1,
        0,
        0,
        0.2,
        1,
        0,
        5 * (i % 16),
        5 * (Math.floor(i / 16) % 16),
        5 * Math.floor(i / 256),
        1,
      ],
    });
  }
  return scene;
}

test('of many instances only those at the border are measured vertex by vertex, and the box is exact', () => {
  const scene = strewn();
  const all = visiblePoints(scene);
  let reads = 0;
  const { positions } = scene.meshes[0]!;
  scene.meshes[0]!.positions = new Proxy(positions, {
    get(array, key) {
      if (typeof key === 'string' && /^\d+$/.test(key)) reads++;
      return Reflect.get(array, key) as unknown;
    },
  });
  const { min, max } = sceneBounds(scene);
  for (const k of [0, 1, 2] as const) {
    expect(min[k]).toBeCloseTo(
      all.reduce((minimum, p) => Math.min(minimum, p[k]!), Infinity),
      12,
    );
    expect(max[k]).toBeCloseTo(
      all.reduce((maximum, p) => Math.max(maximum, p[k]!), -Infinity),
      12,
    );
  }
  // All vertices of all instances: 2.5 million numbers.
  expect(reads).toBeGreaterThan(600);
  expect(reads).toBeLessThan(500_000);
});

test('the frame around many instances holds every vertex and touches the margin', () => {
  const scene = strewn();
  const { transform: m, yfov } = frameCamera(scene, { aspect: 1, margin: 0 });
  let widest = 0;
  for (const p of visiblePoints(scene)) {
    const d = p.map((x, k) => x - m[12 + k]!);
    const along = (column: number) => d[0]! * m[4 * column]! + d[1]! * m[4 * column + 1]! + d[2]! * m[4 * column + 2]!;
    widest = Math.max(widest, Math.abs(along(0)) / -along(2), Math.abs(along(1)) / -along(2));
  }
  expect(widest / Math.tan(yfov / 2)).toBeCloseTo(1, 9);
});

test('framing many instances reads few transforms more than once, whatever the directions', () => {
  const scene = strewn();
  const framed = frameCamera(scene, { aspect: 1 });
  let reads = 0;
  scene.instances = scene.instances.map((instance) => ({
    ...instance,
    get transform() {
      reads++;
      return instance.transform;
    },
  }));
  const visible = scene.instances.filter((instance) => instance.visible !== false).length;
  expect(frameCamera(scene, { aspect: 1 })).toEqual(framed);
  // Along twelve directions in all.
  expect(reads).toBeGreaterThanOrEqual(visible + 12);
  expect(reads).toBeLessThan(3 * visible);
});
