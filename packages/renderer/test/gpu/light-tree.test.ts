import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import { finish, type Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { LIGHT_NODE_DISTANT, LIGHT_NODE_LEAF, lightStruct } from '../../src/storage/layout';
import lightTree from '../../src/lights/light_tree.wesl';
import pathCone from '../../src/path/path_cone.wesl';
import { lightTreeSteps } from '../../src/lights/light-tree';
import { addQuad, camera, createScene, lambert, meanOf } from '../scenes';
import { random, randomLights, randomUnit, treeNodes } from '../tree-lights';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const COUNT = 40;
const PLACES = 48;
const DRAWS = 4096;

describe('the choice by the light tree', () => {
  it('has the probability that is asked for, and leaves out no light that shines on the place', async () => {
    const lights = randomLights(COUNT, 77);
    const tree = finish(lightTreeSteps(lights, [...Array(COUNT - 4).keys()], [36, 37, 38]));
    const records = lightStruct.allocate(COUNT + tree.count);
    for (let i = 0; i < COUNT; i++)
      lightStruct.write(records, i, { other: tree.trails[i]!, probability: i < 39 ? 1 : 0 });
    treeNodes(tree).forEach(({ center, radius, axis, cosSpread, cosReach, energy, light, child, distant }, i) =>
      lightStruct.write(records, COUNT + i, {
        a: center,
        kind: (light === undefined ? 0 : LIGHT_NODE_LEAF) | (distant ? LIGHT_NODE_DISTANT : 0),
        b: axis,
        probability: radius,
        c: [cosSpread, cosReach, energy],
        other: light ?? COUNT + child!,
      }),
    );
    const next = random(4);
    const places = Array.from({ length: PLACES }, (_, i) => ({
      p: [0, 1, 2].map(() => 3 * next() - 1.5),
      n: i % 4 === 0 ? ([0, 0, 0] as const) : randomUnit(next),
    }));
    const host = wgslModule(
      'test/host',
      `struct TestFrame { light_count: u32 }
var<private> frame = TestFrame(${COUNT}u);
@group(0) @binding(0) var<storage, read> lights: array<Light>;
@group(0) @binding(1) var<storage, read> places: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> result: array<f32>;
// One place a workgroup: for each light the probability, then how often it is drawn and the largest difference of probabilities;
// behind them the sum of what is left of the draws.
@compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3u) {
  let p = places[2u * id.x].xyz;
  let n = cone_normal(cone_pack(1.0, places[2u * id.x + 1u].xyz));
  let at = id.x * ${3 * COUNT + 2}u;
  for (var i = 0u; i < ${COUNT}u; i++) { result[at + i] = light_tree_probability(i, p, n); }
  for (var i = 0u; i < ${DRAWS}u; i++) {
    let pick = light_tree_pick((f32(i) + 0.5) / ${DRAWS}.0, p, n);
    if (pick.probability == 0.0) { result[at + ${2 * COUNT}u] += 1.0; continue; }
    result[at + ${COUNT}u + pick.light] += 1.0;
    result[at + ${2 * COUNT + 2}u + pick.light] += pick.rest;
    result[at + ${2 * COUNT + 1}u] = max(result[at + ${2 * COUNT + 1}u], abs(pick.probability / result[at + pick.light] - 1.0));
  }
}`,
      [lightStruct.module, lightTree, pathCone],
    );
    const { code } = compose([host], { flags: { SOBOL: false, SCREEN_NOISE: false, LIGHT_TREE: true } });
    const input = Float32Array.from(places.flatMap(({ p, n }) => [...p, 0, ...n, 0]));
    const numbers = new Float32Array(
      await runCompute(device, code, {
        inputs: [records, input],
        outputBytes: PLACES * (3 * COUNT + 2) * 4,
        workgroups: PLACES,
      }),
    );
    let culled = 0;
    places.forEach(({ p, n }, place) => {
      const row = numbers.subarray(place * (3 * COUNT + 2), (place + 1) * (3 * COUNT + 2));
      const probabilities = row.subarray(0, COUNT);
      const total = probabilities.reduce((a, b) => a + b, 0);
      // Where a walk may end in the dark it does so as often as the sum lacks.
      expect(Math.abs(total + row[2 * COUNT]! / DRAWS - 1)).toBeLessThan((2 / DRAWS) * COUNT);
      expect(row[2 * COUNT + 1]).toBeLessThan(1e-3);
      // Evenly spread draws: each light's share to within the ends of its interval.
      for (let i = 0; i < COUNT; i++)
        expect(Math.abs(row[COUNT + i]! / DRAWS - probabilities[i]!)).toBeLessThanOrEqual(3 / DRAWS);
      // What is left of them is spread as evenly, from 0 to 1.
      for (let i = 0; i < COUNT; i++) {
        const drawn = row[COUNT + i]!;
        if (drawn > 0) expect(Math.abs(row[2 * COUNT + 2 + i]! / drawn - 0.5)).toBeLessThanOrEqual(1 / drawn + 1e-3);
      }
      for (const i of [39]) expect(probabilities[i]).toBe(0);
      for (let i = 0; i < 36; i++) {
        if (probabilities[i]! > 0) continue;
        culled++;
        // Points of its box: none sees the side that shines.
        for (let k = 0; k < 64; k++) {
          const q = [0, 1, 2].map(
            (c) =>
              lights.bounds[6 * i + c]! + next() * (lights.bounds[6 * i + 3 + c]! - lights.bounds[6 * i + c]!) - p[c]!,
          );
          const cosine = -[0, 1, 2].reduce((sum, c) => sum + lights.axes[3 * i + c]! * q[c]!, 0) / Math.hypot(...q);
          expect(Math.acos(cosine)).toBeGreaterThan(lights.spreads[i]! + lights.reaches[i]! - 1e-3);
        }
      }
      if (n.every((c) => c === 0)) for (const i of [36, 37, 38]) expect(probabilities[i]).toBeGreaterThan(0);
    });
    // The test sees some.
    expect(culled).toBeGreaterThan(20);
  });
});

const SIZE = 16;

async function image(scene: Scene, samples: number, options: Partial<PathTracerOptions>): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera, ...options });
  try {
    for await (const progress of tracer.render({ samples })) void progress;
    return await tracer.read('beauty');
  } finally {
    tracer.destroy();
  }
}

/** A glossy floor below many small panes that face all ways, some from both sides, with lamps and a sun among them. */
function manyLights(count: number): Scene {
  const scene = createScene();
  addQuad(scene, 2, -0.5, lambert(0.6));
  scene.materials[0] = { name: 'floor', parameters: { base_color: [0.6, 0.6, 0.6], specular_roughness: 0.4 } };
  const next = random(21);
  for (let i = 0; i < count; i++) {
    const z = randomUnit(next);
    const x = randomUnit(next);
    const dot = x[0] * z[0] + x[1] * z[1] + x[2] * z[2];
    const flat = x.map((c, k) => c - dot * z[k]!);
    const length = Math.hypot(...flat);
    const u = flat.map((c) => (0.05 * c) / length);
    const v = [z[1] * u[2]! - z[2] * u[1]!, z[2] * u[0]! - z[0] * u[2]!, z[0] * u[1]! - z[1] * u[0]!];
    const sign = i % 5 === 0 ? -1 : 1;
    const place = [3 * next() - 1.5, 3 * next() - 1.5, 0.2 + next()];
    addQuad(
      scene,
      1,
      0,
      {
        name: `pane ${i}`,
        parameters: {
          base_weight: 0,
          specular_weight: 0,
          emission_luminance: 2 + 30 * next() ** 2,
          emission_color: [next(), next(), next()],
        },
        double_sided: i % 3 === 0,
      },
      { transform: [...u, 0, ...v, 0, ...z.map((c) => sign * c), 0, ...place, 1] },
    );
  }
  scene.lights.push(
    { type: 'point', name: 'point', color: [1, 1, 1], intensity: 0.1, position: [0.5, 0.5, 0.2] },
    {
      type: 'spot',
      name: 'spot',
      color: [1, 1, 1],
      intensity: 0.5,
      position: [-0.5, 0.5, 0.5],
      direction: [0, 0, -1],
      inner_cone_angle: 0.2,
      outer_cone_angle: 0.5,
    },
    { type: 'directional', name: 'sun', color: [1, 0.9, 0.8], intensity: 0.3, direction: [0.3, 0.2, -0.9] },
    { type: 'directional', name: 'from below', color: [1, 0.9, 0.8], intensity: 0.3, direction: [0.3, 0.2, 0.9] },
  );
  return scene;
}

/** Below the panes, looking at the floor: edges of panes in the image would be noise of their own. */
const below = { ...camera, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.1, 1], yfov: 1.5 };

/** Mean and its standard error over runs, of blocks of 4 × 4 pixels. */
function blocks(runs: readonly Float32Array[]): { mean: number; error: number }[] {
  const out: { mean: number; error: number }[] = [];
  for (let y = 0; y < SIZE; y += 4) {
    for (let x = 0; x < SIZE; x += 4) {
      const values = runs.map((pixels) => meanOf(pixels, SIZE, x, y, x + 4, y + 4).reduce((a, b) => a + b) / 3);
      const mean = values.reduce((a, b) => a + b) / values.length;
      out.push({
        mean,
        error: Math.sqrt(values.reduce((sum, v) => sum + (v - mean) ** 2, 0) / (values.length - 1) / values.length),
      });
    }
  }
  return out;
}

describe('many lights', () => {
  it('by the tree and by power give the same image, the tree with less noise', async () => {
    const scene = manyLights(400);
    const runs = async (lightSampling: 'tree' | 'power', samples: number) => {
      const images: Float32Array[] = [];
      for (let seed = 0; seed < 6; seed++)
        images.push(
          await image(scene, samples, {
            lightSampling,
            seed: seed + 50,
            maxDepth: 3,
            sampler: 'independent',
            camera: below,
          }),
        );
      return blocks(images);
    };
    const samples = process.env['GLANZ_FULL'] === undefined ? 48 : 256;
    const [tree, power] = [await runs('tree', samples), await runs('power', samples)];
    let chi = 0;
    tree.forEach(({ mean, error }, i) => (chi += (mean - power[i]!.mean) ** 2 / (error ** 2 + power[i]!.error ** 2)));
    // 16 blocks; errors estimated from six runs each make the sum heavier-tailed than χ²(16), of which 39 is the 99.9 %
    // point.
    expect(chi).toBeLessThan(60);
    const noise = (list: typeof tree) => list.reduce((sum, { error }) => sum + error ** 2, 0);
    expect(noise(power) / noise(tree)).toBeGreaterThan(2);
  }, 120_000);
});
