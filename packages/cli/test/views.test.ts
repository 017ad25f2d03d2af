import { createScene, type Camera, type Scene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { cameraOf, parseView, turntable } from '../src/views';

/** A box of 2 × 1 × 0.5 m about a point, as its eight corners in twelve triangles. */
function box(center: readonly [number, number, number]): Scene {
  const positions = new Float32Array(
    Array.from({ length: 8 }, (_, i) => [
      center[0] + (i & 1 ? 1 : -1),
      center[1] + (i & 2 ? 0.5 : -0.5),
      center[2] + (i & 4 ? 0.25 : -0.25),
    ]).flat(),
  );
  const indices = new Uint32Array([
    0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7, 0, 2, 4, 2, 6, 4, 1, 5, 3, 3, 5, 7, 0, 4, 1, 1, 4, 5, 2, 3, 6, 3, 7, 6,
  ]);
  return {
    ...createScene('box'),
    meshes: [{ name: 'box', positions, indices }],
    materials: [{ name: 'm', parameters: {} }],
    instances: [{ name: 'box', mesh: 0, material: 0, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }],
  };
}

const CENTER = [3, 1, -2] as const;
const eye = ({ transform: m }: Camera) => [m[12]!, m[13]!, m[14]!] as const;
const towards = (camera: Camera) => {
  const v = eye(camera).map((x, k) => x - CENTER[k]!);
  const length = Math.hypot(...v);
  return v.map((x) => x / length);
};

/** Where a point falls in the image: −1 to 1 within its frame. */
function projected(camera: Camera, point: readonly number[], aspect: number): [number, number] {
  if (camera.type !== 'perspective') throw new Error(camera.type);
  const m = camera.transform;
  const d = point.map((x, k) => x - m[12 + k]!);
  const along = (column: number) => d[0]! * m[4 * column]! + d[1]! * m[4 * column + 1]! + d[2]! * m[4 * column + 2]!;
  const t = Math.tan(camera.yfov / 2);
  return [along(0) / (-along(2) * t * aspect), along(1) / (-along(2) * t)];
}

describe('views', () => {
  it.each([
    ['front', [0, 0, 1]],
    ['back', [0, 0, -1]],
    ['right', [1, 0, 0]],
    ['left', [-1, 0, 0]],
    ['top', [0, 1, 0]],
    ['bottom', [0, -1, 0]],
    ['iso', [1, 1, 1].map((x) => x / Math.sqrt(3))],
    ['90,45', [Math.SQRT1_2, Math.SQRT1_2, 0]],
    ['-90, 0', [-1, 0, 0]],
    ['front-right', [0.6, 0.45, 1].map((x) => x / Math.hypot(0.6, 0.45, 1))],
  ] as const)('%s looks from there', async (text, direction) => {
    const camera = await cameraOf(parseView(text), box(CENTER), 1.5, '.');
    // Backwards along the camera's z axis; cameras stand aside by what their images gain.
    const back = [8, 9, 10].map((i) => camera.transform[i]!);
    direction.forEach((x, k) => expect(back[k]).toBeCloseTo(x, 2));
    for (let i = 0; i < 8; i++) {
      const [x, y] = projected(
        camera,
        [CENTER[0] + (i & 1 ? 1 : -1), CENTER[1] + (i & 2 ? 0.5 : -0.5), CENTER[2] + (i & 4 ? 0.25 : -0.25)],
        1.5,
      );
      expect(Math.max(Math.abs(x), Math.abs(y))).toBeLessThanOrEqual(0.95);
    }
  });

  it('names that can be parts of files', () => {
    expect(
      ['iso', '30,20', '-90, 0', 'shots/hero cam.json', '{"position":[0,0,1]}', 'Küche / Süd'].map(
        (text) => parseView(text).name,
      ),
    ).toEqual(['iso', '30_20', '-90_0', 'hero_cam', 'camera', 'Süd']);
  });

  it('a camera of the model', async () => {
    const scene: Scene = {
      ...box(CENTER),
      cameras: [
        { type: 'perspective', name: 'hero', transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 9, 1], yfov: 0.5 },
      ],
    };
    expect(await cameraOf(parseView('hero'), scene, 1, '.')).toBe(scene.cameras[0]);
    await expect(cameraOf(parseView('villain'), scene, 1, '.')).rejects.toMatchObject({ code: 'cli/camera' });
  });
});

describe('a turntable', () => {
  it('goes round once, at one height and distance, its middle in the middle, and everything is in all images', async () => {
    const views = turntable(12, 25);
    expect(views.map(({ name }) => name)).toEqual(
      Array.from({ length: 12 }, (_, i) => `turntable-${String(i).padStart(3, '0')}`),
    );
    const cameras = await Promise.all(views.map((view) => cameraOf(view, box(CENTER), 0.8, '.')));
    const distances = cameras.map((camera) => Math.hypot(...eye(camera).map((x, k) => x - CENTER[k]!)));
    for (const distance of distances) expect(distance).toBeCloseTo(distances[0]!, 9);
    let largest = 0;
    cameras.forEach((camera, i) => {
      const [x, y, z] = towards(camera) as [number, number, number];
      expect(y).toBeCloseTo(Math.sin((25 * Math.PI) / 180), 9);
      expect((Math.atan2(x, z) * 180) / Math.PI).toBeCloseTo(i <= 6 ? 30 * i : 30 * i - 360, 6);
      projected(camera, CENTER, 0.8).forEach((p) => expect(p).toBeCloseTo(0, 6));
      for (let corner = 0; corner < 8; corner++)
        largest = Math.max(
          largest,
          ...projected(
            camera,
            [
              CENTER[0] + (corner & 1 ? 1 : -1),
              CENTER[1] + (corner & 2 ? 0.5 : -0.5),
              CENTER[2] + (corner & 4 ? 0.25 : -0.25),
            ],
            0.8,
          ).map(Math.abs),
        );
    });
    expect(largest).toBeLessThanOrEqual(1);
    // And not from much further away than that needs.
    expect(largest).toBeGreaterThan(0.7);
  });
});
