import { expect, test } from 'vitest';
import {
  createScene,
  defaultMaterial,
  frameCamera,
  type SceneError,
  type FrameCameraOptions,
  type Scene,
} from '../src/index';
import { points, sample } from './sample';

for (const options of [
  { aspect: 1 },
  { aspect: 3 },
  { aspect: 0.4, yfov: 1.2 },
  { aspect: 1.5, direction: [-3, 0.1, -1] },
  { aspect: 1, margin: 0.3 },
] satisfies FrameCameraOptions[]) {
  test(`every vertex is in the image, and fills it in one dimension: ${JSON.stringify(options)}`, () => {
    const scene = sample();
    const { transform: m, yfov, focus_distance } = frameCamera(scene, options);
    const tangent = Math.tan(yfov / 2);
    const project = (p: number[]) => {
      const d = p.map((x, k) => x - m[12 + k]!);
      const along = (column: number) =>
        d[0]! * m[4 * column]! + d[1]! * m[4 * column + 1]! + d[2]! * m[4 * column + 2]!;
      expect(along(2)).toBeLessThan(0);
      return [along(0) / -along(2) / (tangent * options.aspect), along(1) / -along(2) / tangent];
    };
    const seen = points(scene).map(project);
    const extent = (k: number) => [Math.min(...seen.map((p) => p[k]!)), Math.max(...seen.map((p) => p[k]!))] as const;
    const margin = 'margin' in options ? options.margin : 0.06;
    // One way it fills the frame less the margin on both sides, the other way it is within.
    for (const k of [0, 1]) {
      expect(extent(k)[1]).toBeLessThanOrEqual(1 - margin + 1e-9);
      expect(extent(k)[0]).toBeGreaterThanOrEqual(margin - 1 - 1e-9);
    }
    const [fullest] = [0, 1].sort((a, b) => extent(b)[1] - extent(b)[0] - (extent(a)[1] - extent(a)[0]));
    expect(extent(fullest!)[0]).toBeCloseTo(margin - 1, 9);
    expect(extent(fullest!)[1]).toBeCloseTo(1 - margin, 9);
    const depths = points(scene).map((p) => -[0, 1, 2].reduce((sum, k) => sum + (p[k]! - m[12 + k]!) * m[8 + k]!, 0));
    expect(focus_distance).toBeCloseTo((Math.min(...depths) + Math.max(...depths)) / 2, 9);
    // A rotation: right-handed, no scale.
    const dot = (a: number, b: number) => [0, 1, 2].reduce((sum, k) => sum + m[4 * a + k]! * m[4 * b + k]!, 0);
    for (const [a, b, value] of [
      [0, 0, 1],
      [1, 1, 1],
      [2, 2, 1],
      [0, 1, 0],
      [0, 2, 0],
      [1, 2, 0],
    ] as const)
      expect(dot(a, b)).toBeCloseTo(value, 12);
    expect(
      m[0]! * (m[5]! * m[10]! - m[6]! * m[9]!) -
        m[1]! * (m[4]! * m[10]! - m[6]! * m[8]!) +
        m[2]! * (m[4]! * m[9]! - m[5]! * m[8]!),
    ).toBeCloseTo(1, 12);
  });
}

test('what cannot be framed is refused', () => {
  const code = (scene: Scene, options: FrameCameraOptions) => {
    try {
      frameCamera(scene, options);
    } catch (error) {
      return (error as SceneError).code;
    }
    return undefined;
  };
  expect(code(createScene(), { aspect: 1 })).toBe('scene/empty');
  for (const options of [
    { aspect: 0 },
    { aspect: 1, yfov: 4 },
    { aspect: 1, direction: [0, 1, 0] as const },
    { aspect: 1, margin: 1 },
  ])
    expect(code(sample(), options)).toBe('scene/value');
});

test('a line seen from its end, and a point, are looked at from outside', () => {
  const scene = sample();
  scene.instances.length = 1;
  for (const [positions, distance] of [
    [[0, 0, -1, 0, 0, 1, 0, 0, 0], 3],
    [[7, 7, 7, 7, 7, 7, 7, 7, 7], 8],
  ] as const) {
    scene.meshes[0]!.positions = new Float32Array(positions);
    const { transform: m } = frameCamera(scene, { aspect: 1, direction: [0, 0, 1] });
    expect([m[12], m[13], m[14]]).toEqual([positions[0], positions[1], distance]);
  }
});

test('a cone that points at the camera is seen from outside, however numbers round', () => {
  for (let i = 0; i < 200; i++) {
    const [x, y] = [Math.sin(i), 0.3 * Math.cos(3 * i)];
    const length = Math.hypot(x, y, 1);
    // Its tip reaches 1 m, its base lies at the origin and is narrower than the view.
    const direction = [x / length, y / length, 1 / length] as const;
    const scene = createScene();
    const across = [direction[2], 0, -direction[0]] as const;
    const positions = [direction, across.map((c) => 0.05 * c), across.map((c) => -0.05 * c)].flat();
    scene.meshes.push({ name: 'cone', positions: Float32Array.from(positions), indices: Uint32Array.of(0, 1, 2) });
    scene.materials.push(defaultMaterial());
    scene.instances.push({
      name: 'cone',
      mesh: 0,
      material: 0,
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    });
    const { transform } = frameCamera(scene, { aspect: 1, direction });
    const eye = [transform[12]!, transform[13]!, transform[14]!] as const;
    expect(Math.hypot(eye[0] - direction[0], eye[1] - direction[1], eye[2] - direction[2])).toBeCloseTo(1, 4);
  }
});

test('a small part far from the origin is framed as one at the origin is', () => {
  const scene = sample();
  scene.instances.length = 1;
  scene.meshes[0]!.positions = new Float32Array([0, 0, 0, 0.002, 0, 0, 0, 0.001, 0.003]);
  const near = frameCamera(scene, { aspect: 1.5 });
  scene.instances[0]!.transform = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1000, -500, 2000, 1];
  const far = frameCamera(scene, { aspect: 1.5 });
  [1000, -500, 2000].forEach((offset, k) =>
    expect((far.transform[12 + k] as number) - offset).toBeCloseTo(near.transform[12 + k] as number, 9),
  );
});
