import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Light, Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { casesOf, samplesOf } from '../full';
import { addQuad, createScene, lambert } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterEach(() => expectNoGpuErrors());

const SIZE = 32;
/** Metres from the left to the right of the image. */
const WIDTH = 2;
const HEIGHT_OF_EDGE = 0.8;
const TAN_30 = Math.tan(Math.PI / 6);

const sun: Light = { type: 'directional', name: 'sun', color: [1, 1, 1], intensity: 3, direction: [0, 0, -1] };

/** A black card over the left half of a white floor in the plane z = 0, lit from straight above. */
function scene(catcher: boolean, light: Light = sun): Scene {
  const made = createScene();
  addQuad(made, 20, 0, lambert(0.5, 0.5, 0.5));
  addQuad(made, 5, HEIGHT_OF_EDGE, lambert(0, 0, 0), {
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -5, 0, 0, 1],
  });
  Object.assign(made.instances[0] as object, { catcher });
  made.lights.push(light);
  made.environment = { type: 'constant', radiance: [0, 0, 0] };
  return made;
}

/** From below the card: the camera looks straight down from between floor and card, and sees the floor alone. */
const options: PathTracerOptions = {
  width: SIZE,
  height: 4,
  camera: {
    type: 'orthographic',
    name: 'below',
    transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.4, 1],
    xmag: WIDTH / 2,
    ymag: (WIDTH / 2) * (4 / SIZE),
  },
  maxDepth: 2,
  background: 'transparent',
  pathsInFlight: 1 << 14,
  filter: 'box',
};

async function image(made: Scene, extra: Partial<PathTracerOptions> = {}, samples = 256): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, made, { ...options, ...extra });
  for await (const _ of tracer.render({ samples, maxSubmitMs: 1000 }));
  const pixels = await tracer.read('beauty');
  tracer.destroy();
  return pixels;
}

/** Share of a disc of radius 1 on the side below x. */
const discBelow = (x: number): number => {
  const t = Math.min(1, Math.max(-1, x));
  return 1 - (Math.acos(t) - t * Math.sqrt(1 - t * t)) / Math.PI;
};

/** Shadow of the edge at x = 0 in a pixel's column, averaged over the column: the disc reaches over the edge. */
function penumbra(column: number, radius: number): number {
  let sum = 0;
  for (let i = 0; i < 64; i++) {
    const x = ((column + (i + 0.5) / 64) / SIZE - 0.5) * WIDTH;
    sum += discBelow(-x / radius);
  }
  return sum / 64;
}

type Vector = readonly [number, number, number];

/** Uniform numbers of 32 bits. */
function mulberry(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

/** Around +Z, by the cosine. */
function cosineDirection(random: () => number): Vector {
  const [u, angle] = [random(), 2 * Math.PI * random()];
  return [Math.sqrt(u) * Math.cos(angle), Math.sqrt(u) * Math.sin(angle), Math.sqrt(1 - u)];
}

/** A direction turned to a point of a disc around it, by rejection; as it was where it would go below the floor. */
function turned(axis: Vector, radius: number, random: () => number): Vector {
  // Tangents of the sphere, downwards and sideways (spherical coordinates).
  const sine = Math.hypot(axis[0], axis[1]);
  const down: Vector = [(axis[0] * axis[2]) / sine, (axis[1] * axis[2]) / sine, -sine];
  const side: Vector = [-axis[1] / sine, axis[0] / sine, 0];
  for (;;) {
    const [a, b] = [2 * random() - 1, 2 * random() - 1];
    if (Math.hypot(a, b) > 1) continue;
    const result = axis.map(
      (value, k) => value + radius * (a * (down[k] as number) + b * (side[k] as number)),
    ) as unknown as Vector;
    return result[2] > 0 ? result : axis;
  }
}

/** Whether the card covers a direction from a place of the floor in the middle row. */
const isCovered = (x: number, [dx, dy, dz]: Vector): boolean => {
  const reach = HEIGHT_OF_EDGE / dz;
  const at = x + dx * reach;
  return at <= 0 && at >= -10 && Math.abs(dy * reach) <= 5;
};

describe('shadowSoftness', () => {
  it.each(casesOf(0.5, 0.25, 1))('at %f the edge of a card has the penumbra of a disc', async (shadowSoftness) => {
    const samples = samplesOf(256, 4);
    const pixels = await image(scene(true), { shadowSoftness }, samples);
    const radius = HEIGHT_OF_EDGE * shadowSoftness * TAN_30;
    for (let column = 0; column < SIZE; column++) {
      let alpha = 0;
      for (let row = 0; row < 4; row++) alpha += (pixels[4 * (row * SIZE + column) + 3] as number) / 4;
      const expected = penumbra(column, radius);
      // Four standard errors of independent samples, and the softness's 16 bits.
      const error = 4 * Math.sqrt((expected * (1 - expected)) / (4 * samples)) + 1e-4;
      expect(Math.abs(alpha - expected), `column ${column}`).toBeLessThanOrEqual(error);
    }
  });

  it('0 is the same image as none, bit for bit, and without a catcher any value is', async () => {
    const few = (catcher: boolean, extra: Partial<PathTracerOptions> = {}) => image(scene(catcher), extra, 16);
    const hard = await few(true);
    expect(await few(true, { shadowSoftness: 0 })).toEqual(hard);
    expect(await few(false, { shadowSoftness: 1 })).toEqual(await few(false));
    expect(await few(true, { shadowSoftness: 1 })).not.toEqual(hard);
  });

  it('under a sky: what turned directions find on the CPU, and no shadow where nothing stands on the floor', async () => {
    const made = scene(true);
    made.lights.length = 0;
    made.environment = { type: 'constant', radiance: [1, 1, 1] };
    const [samples, shadowSoftness] = [samplesOf(256, 4), 1];
    const pixels = await image(made, { shadowSoftness }, samples);
    const random = mulberry(3);
    for (const column of [2, 10, 16, 22, 29]) {
      let alpha = 0;
      for (let row = 0; row < 4; row++) alpha += (pixels[4 * (row * SIZE + column) + 3] as number) / 4;
      const count = samplesOf(100_000, 4);
      let hits = 0;
      for (let i = 0; i < count; i++) {
        const x = ((column + random()) / SIZE - 0.5) * WIDTH;
        if (isCovered(x, turned(cosineDirection(random), shadowSoftness * TAN_30, random))) hits++;
      }
      const expected = hits / count;
      const error = 4 * Math.sqrt(expected * (1 - expected) * (1 / (4 * samples) + 1 / count));
      expect(Math.abs(alpha - expected), `column ${column}: ${alpha}, ${expected}`).toBeLessThanOrEqual(error);
    }
    Object.assign(made.instances[1] as object, { visible: false });
    for (const value of await image(made, { shadowSoftness: 0.5 }, 64)) expect(Math.abs(value)).toBeLessThan(1e-6);
  });
});
