import { describe, expect, test } from 'vitest';
import {
  createScene,
  frameCameraSteps,
  inSlices,
  sceneBounds,
  sceneBoundsSteps,
  validationSteps,
  type Scene,
} from '../src/index';
import { studioEnvironment, studioSteps } from '../src/studio';

/**
 * More vertices and indices than are looked at in one step, with the extremes of one side each in steps of their own.
 */
function large(): Scene {
  const scene = createScene('large');
  const vertices = 200_001,
    positions = new Float32Array(3 * vertices).map((_, i) => Math.sin(i * i));
  const extremes = [
    [10, -3],
    [70_000, 4],
    [140_000, -5],
    [199_999, 6],
    [3, -7],
    [150_001, 8],
  ] as const;
  extremes.forEach(([vertex, value], k) => (positions[3 * vertex + (k >> 1)] = value));
  // The last one is used by no triangle.
  positions.fill(100, 3 * vertices - 3);
  scene.meshes.push({
    name: 'points',
    positions,
    indices: new Uint32Array(3 * (vertices - 3)).map((_, i) => Math.floor(i / 3) + (i % 3)),
  });
  scene.materials.push({ name: 'grey', parameters: {} });
  scene.instances.push({
    name: 'part',
    mesh: 0,
    material: 0,
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1],
  });
  return scene;
}

function drain<T>(steps: Generator<void, T>): { stops: number; value: T } {
  for (let stops = 0; ; stops++) {
    const step = steps.next();
    if (step.done) return { stops, value: step.value };
  }
}

describe('steps', () => {
  test('the box of a large mesh, in several steps', () => {
    const { stops, value } = drain(sceneBoundsSteps(large()));
    expect(value).toEqual({ min: [10 - 3, 20 - 5, 30 - 7], max: [10 + 4, 20 + 6, 30 + 8] });
    // 600,000 indices and 200,000 vertices by 65,536.
    expect(stops).toBeGreaterThanOrEqual(10 + 4);
    expect(sceneBounds(large())).toEqual(value);
  });

  test('every vertex of a large mesh lies in the frame', () => {
    const scene = large();
    const { stops, value: camera } = drain(frameCameraSteps(scene, { aspect: 1.5, margin: 0 }));
    expect(stops).toBeGreaterThanOrEqual(10 + 4 + 4);
    const m = camera.transform,
      ty = Math.tan(camera.yfov / 2),
      tx = 1.5 * ty;
    const { positions } = scene.meshes[0]!;
    let maximum = 0;
    for (let v = 0; v < positions.length - 3; v += 3) {
      const d = [0, 1, 2].map((k) => positions[v + k]! + [10, 20, 30][k]! - m[12 + k]!);
      const [x, y, z] = [0, 4, 8].map((at) => d[0]! * m[at]! + d[1]! * m[at + 1]! + d[2]! * m[at + 2]!) as [
        number,
        number,
        number,
      ];
      maximum = Math.max(maximum, Math.abs(x) / (-z * tx), Math.abs(y) / (-z * ty));
    }
    // Inside, and touching an edge: the nearest camera that sees all.
    expect(maximum).toBeCloseTo(1, 9);
  });

  test('the environment is checked in steps, to the last pixel', () => {
    const scene = createScene();
    const studio = studioEnvironment();
    scene.environment = studio;
    expect(drain(validationSteps(scene)).stops).toBeGreaterThanOrEqual(5);
    studio.data[studio.data.length - 1] = Number.NaN;
    expect(() => drain(validationSteps(scene))).toThrow(`${studio.data.length - 1}`);
  });

  test('the studio in steps is the studio', () => {
    const { stops, value } = drain(studioSteps({ width: 128 }));
    expect(stops).toBeGreaterThanOrEqual(8);
    expect(value).toEqual(studioEnvironment({ width: 128 }));
  });
});

describe('inSlices', () => {
  function* counting(to: number): Generator<void, number> {
    for (let i = 0; i < to; i++) yield;
    return to;
  }

  test('gives what the steps return, with others having their turn', async () => {
    let ticks = 0;
    let done = false;
    const tick = () => {
      ticks++;
      if (!done) setImmediate(tick);
    };
    setImmediate(tick);
    expect(await inSlices(counting(50), { sliceMs: 0 })).toBe(50);
    done = true;
    // Once for each yield, whatever the clock says.
    expect(ticks).toBeGreaterThanOrEqual(40);
  });

  test('stops when aborted, and passes errors on', async () => {
    const control = new AbortController(),
      reason = new Error('enough');
    let seen = 0;
    const steps = (function* (): Generator<void, void> {
      for (;;) {
        if (++seen === 3) control.abort(reason);
        yield;
      }
    })();
    await expect(inSlices(steps, { signal: control.signal, sliceMs: 0 })).rejects.toBe(reason);
    expect(seen).toBe(3);
    await expect(inSlices(counting(1), { signal: control.signal })).rejects.toBe(reason);
    await expect(inSlices(frameCameraSteps(createScene(), { aspect: 1 }))).rejects.toMatchObject({
      code: 'scene/empty',
    });
  });
});
