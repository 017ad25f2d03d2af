import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { OPENPBR_TABLES } from '@glanz/openpbr/tables';
import { bvhOffset } from '@glanz/bvh/wgsl';
import { openpbr } from '@glanz/openpbr';
import { finish, type Scene } from '@glanz/scene';
import { compose, wgslModule } from '@glanz/wgsl';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { environmentSteps } from '../../src/environment/environment';
import { prepareGeometry } from '../../src/geometry/prepare-geometry';
import lightAt from '../../src/lights/reservoirs/light_at.wesl';
import lightIds from '../../src/lights/reservoirs/light_ids.wesl';
import lights from '../../src/lights/lights.wesl';
import lightProfile from '../../src/lights/light_profile.wesl';
import { energyTextures } from '../../src/materials/energy-textures';
import energyHost from '../../src/materials/energy.wesl';
import { materialCases } from '../../src/materials/material-cases';
import { modulesOf } from '../../src/integrator/modules-of';
import { resolveOptions, type TracerSettings } from '../../src/option-checks';
import { kernelFeatures } from '../../src/preparation';
import { GpuScene } from '../../src/scene/gpu-scene';
import { packFrame } from '../../src/session/frame';
import { GpuMemory } from '../../src/storage/buffers';
import { batchStruct, LIGHT_ID_ENVIRONMENT, NONE } from '../../src/storage/layout';
import { readFloats } from '../../src/storage/read-buffer';
import {
  bindGroupLayouts,
  bindingModule,
  createBindGroup,
  kernelBindings,
  type ResourceName,
  type SceneBinding,
} from '../../src/storage/resources';
import { allLights } from '../light-scene';
import { camera } from '../scenes';
import { random, randomUnit } from '../tree-lights';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

/** Vectors of four numbers that a query has, and that a result has. */
const QUERY = 3;
const RESULT = 6;
const SIZE = { width: 8, height: 8 };

const RESOURCES: readonly ResourceName[] = [
  'frame',
  'batch',
  'triangles',
  'instances',
  'attributes',
  'materials',
  'lights',
  'light_index',
  'environment',
  'environment_table',
  'energy_dielectric',
  'energy_conductor',
  'energy_sampler',
];

/** Of each query: a light sample; the choice that it makes; what that gives by `light_at`. */
const MAIN = /* wgsl */ `
@group(2) @binding(0) var<storage, read> queries: array<vec4f>;
@group(2) @binding(1) var<storage, read_write> results: array<vec4f>;
fn write(at: u32, light: LightSample) {
  results[at] = vec4f(light.direction, light.distance);
  results[at + 1u] = vec4f(light.radiance, light.pdf);
}
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= arrayLength(&queries) / ${QUERY}u) { return; }
  let draws = queries[${QUERY}u * id.x];
  let position = queries[${QUERY}u * id.x + 1u].xyz;
  let normal = queries[${QUERY}u * id.x + 2u].xyz;
  let at = ${RESULT}u * id.x;
  // A choice among many lights draws again.
  random_begin(id.x, 0u, 0u, 1u);
  write(at, light_sample(draws.xy, position, normal));
  random_begin(id.x, 0u, 0u, 1u);
  var choice = light_choose(draws.xy, position, normal);
  // One that was remembered.
  if (draws.w != 0.0) {
    choice.id = u32(draws.z);
    choice.u = draws.xy;
  }
  results[at + 2u] = vec4f(f32(choice.id), choice.u, choice.probability);
  let light = light_at(light_of(choice.id), choice.u, position);
  let probability = light_probability(light_of(choice.id), position, normal);
  write(at + 3u, light);
  results[at + 5u] = vec4f(f32(light.extended), f32(light.group), probability, 0.0);
}`;

interface Query {
  readonly draws: readonly [number, number];
  readonly position: readonly number[];
  readonly normal: readonly number[];
  /** To ask for, in place of the one that is chosen. */
  readonly id?: number;
}

/** A scene on the GPU with the functions of its lights. */
class LightHost {
  readonly memory = new GpuMemory(device);

  private constructor(
    readonly scene: GpuScene,
    readonly options: TracerSettings,
    readonly geometry: Awaited<ReturnType<typeof prepareGeometry>>,
  ) {}

  static async create(scene: Scene, lightSampling: 'tree' | 'power' = 'tree'): Promise<LightHost> {
    const options = resolveOptions({ ...SIZE, camera, lightSampling }) as TracerSettings;
    const geometry = await prepareGeometry(scene);
    const memory = new GpuMemory(device);
    const shapes = new GpuScene(device, memory, scene, geometry, options);
    await shapes.fill();
    await shapes.light(finish(environmentSteps(scene.environment)), energyTextures(OPENPBR_TABLES));
    return new LightHost(shapes, options, geometry);
  }

  async ask(queries: readonly Query[]): Promise<Float32Array> {
    const { memory, scene, options, geometry } = this;
    const features = kernelFeatures(scene.features(), camera, options);
    const flags: Record<string, boolean> = {
      ...features.flags,
      BVH_FILTER: false,
      PASSES: features.lightPasses > 1,
    };
    const extra: SceneBinding[] = [
      ...Array.from({ length: features.textureCount }, (_, i) => [`scene_texture_${i}`, 'texture_2d_array'] as const),
      ...Array.from({ length: features.samplerCount }, (_, i) => [`scene_sampler_${i}`, 'sampler'] as const),
    ];
    const groups = kernelBindings(RESOURCES, extra);
    const cases = flags.TEXTURES && materialCases(features.samplings, features.textured, flags);
    const main = wgslModule('test/light-eval', MAIN, [
      bindingModule('test', groups, flags),
      bvhOffset,
      ...(cases ? [cases] : []),
      openpbr,
      energyHost,
      ...(flags.LIGHT_PROFILES ? [lightProfile] : []),
      lights,
      ...modulesOf(lights, ['environment', 'light-choice']),
      lightIds,
      lightAt,
    ]);
    const module = device.createShaderModule({ code: compose([main], { flags }).code });
    const own = { frame: packFrame(camera, SIZE, scene, geometry, options), batch: batchStruct.allocate() };
    const layouts = bindGroupLayouts(device, 'test', groups);
    const io = device.createBindGroupLayout({
      entries: (['read-only-storage', 'storage'] as const).map((type, binding) => ({
        binding,
        visibility: GPUShaderStage.COMPUTE,
        buffer: { type },
      })),
    });
    const pipeline = await device.createComputePipelineAsync({
      layout: device.createPipelineLayout({ bindGroupLayouts: [...layouts, io] }),
      compute: { module, entryPoint: 'main' },
    });
    const data = new Float32Array(queries.length * QUERY * 4);
    queries.forEach(({ draws, position, normal, id }, i) =>
      data.set([...draws, id ?? 0, id === undefined ? 0 : 1, ...position, 0, ...normal, 0], i * QUERY * 4),
    );
    const results = memory.buffer('results', 16 * RESULT * queries.length, 0x80 | 0x4);
    const find = (name: string) =>
      name === 'frame' || name === 'batch'
        ? { buffer: memory.upload(name, own[name], GPUBufferUsage.UNIFORM) }
        : scene.resource(name);
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    groups.forEach((group, index) => pass.setBindGroup(index, createBindGroup(device, layouts[index]!, group, find)));
    const queryBuffer = memory.upload('queries', data, GPUBufferUsage.STORAGE);
    pass.setBindGroup(
      groups.length,
      device.createBindGroup({
        layout: io,
        entries: [queryBuffer, results].map((buffer, binding) => ({ binding, resource: { buffer } })),
      }),
    );
    pass.dispatchWorkgroups(Math.ceil(queries.length / 64));
    pass.end();
    device.queue.submit([encoder.finish()]);
    return readFloats(device, results);
  }
}

const at = (results: Float32Array, query: number, part: number) =>
  results.subarray(4 * (RESULT * query + part), 4 * (RESULT * query + part) + 4);
const idOf = (results: Float32Array, query: number) => at(results, query, 2)[0]!;

function randomQueries(count: number, seed: number): Query[] {
  const next = random(seed);
  return Array.from({ length: count }, (_, i) => ({
    draws: [next(), next()] as const,
    position: [3 * next() - 1.5, 3 * next() - 1.5, 2.5 * next() - 0.9],
    normal: i % 3 === 0 ? [0, 0, 0] : randomUnit(next),
  }));
}

/** The scene with a texture on one of its emitters. */
function withEmissionTexture(): Scene {
  const scene = allLights();
  const data = new Uint8Array(4 * 16).map((_, i) => (i * 53) & 255);
  const image = scene.images.push({ name: 'glow', width: 4, height: 4, data }) - 1;
  const texture = scene.textures.push({ image, color_space: 'srgb' } as Scene['textures'][number]) - 1;
  const { material } = scene.instances[1]!;
  scene.materials[material] = {
    ...scene.materials[material]!,
    textures: { emission_color: { texture, channels: 'rgb' } },
  };
  return scene;
}

describe('light_at', () => {
  it.each([
    ['tree', () => allLights()],
    ['power', () => allLights()],
    ['tree', () => allLights(false)],
    ['tree', withEmissionTexture],
  ] as const)('of the light that a sample chose gives what the sample gave (%s)', async (sampling, make) => {
    const scene = make();
    const host = await LightHost.create(scene, sampling);
    const queries = randomQueries(6000, 31);
    const results = await host.ask(queries);
    const seen = new Set<number>();
    for (let i = 0; i < queries.length; i++) {
      const [id, , , probability] = [idOf(results, i), ...at(results, i, 2).subarray(1)];
      const pdf = at(results, i, 1)[3]!;
      // The same numbers, but for the order of the density's factors: two roundings.
      expect([...at(results, i, 3)]).toEqual([...at(results, i, 0)]);
      expect([...at(results, i, 4).subarray(0, 3)]).toEqual([...at(results, i, 1).subarray(0, 3)]);
      expect(Math.abs(at(results, i, 4)[3]! * probability! - pdf)).toBeLessThanOrEqual(pdf * 2 ** -22);
      // The probability is found again.
      if (pdf > 0) expect(Math.abs(at(results, i, 5)[2]! / probability! - 1)).toBeLessThan(1e-4);
      if (pdf > 0) seen.add(id);
    }
    // Lights of all kinds were among them.
    const table = host.scene.lightIds;
    for (let light = 0; light < scene.lights.length; light++)
      expect(seen.has(table.ofLight(light)), `${light}`).toBe(true);
    for (const instance of [1, 2, 3, 4]) {
      const count = scene.meshes[scene.instances[instance]!.mesh]!.indices.length / 3;
      const first = table.ofTriangles(instance, count);
      expect(
        Array.from({ length: count }, (_, i) => first + i).some((id) => seen.has(id)),
        `${instance}`,
      ).toBe(true);
    }
    expect(seen.has(LIGHT_ID_ENVIRONMENT)).toBe(scene.environment !== undefined);
  });

  it('answers from other places, and after edits, for the light that is remembered', async () => {
    const scene = allLights();
    const host = await LightHost.create(scene);
    const ids = host.scene.lightIds;
    const instance = 2;
    const first = ids.ofTriangles(instance, 2);
    const position = [0.2, -0.1, 2];
    const query = (id: number): Query => ({ draws: [0.4, 0.3], position, normal: [0, 0, 0], id });
    /** Where the light was seen, as a point. */
    const point = (results: Float32Array, i: number) =>
      [0, 1, 2].map((k) => position[k]! + (at(results, i, 3)[k]! * at(results, i, 3)[3]!) / (1 - 1e-4));
    const asked = [...[0, 1].map((i) => query(first + i)), query(ids.ofLight(0)), query(NONE), query(ids.end + 5)];
    const before = await host.ask(asked);
    for (const i of [0, 1]) {
      // On the square of the instance: |x − 1| and |y − 0.5| ≤ 0.2 at z = 1.
      const [x, y, z] = point(before, i);
      expect(Math.abs(x! - 1)).toBeLessThan(0.2001);
      expect(Math.abs(y! - 0.5)).toBeLessThan(0.2001);
      expect(z).toBeCloseTo(1, 4);
    }
    for (const i of [3, 4]) expect(at(before, i, 4)[3]).toBe(0);

    // What comes before them in the table goes, they move, and the floor glows.
    scene.instances[1] = { ...scene.instances[1]!, visible: false };
    scene.instances[instance] = {
      ...scene.instances[instance]!,
      transform: Array.from(scene.instances[instance]!.transform).map((x, i) => (i === 13 ? x - 0.7 : x)),
    };
    scene.lights[0] = { ...scene.lights[0]!, position: [0.2, -0.1, 3] } as Scene['lights'][number];
    host.geometry.placement.update(scene, host.geometry.blas, [1, instance], true);
    host.scene.updatePlacement(host.geometry);
    const after = await host.ask([...asked, query(ids.ofTriangles(1, 2))]);
    for (const i of [0, 1]) {
      const [x, y, z] = point(after, i);
      expect(Math.abs(x! - 1)).toBeLessThan(0.2001);
      expect(Math.abs(y! + 0.2)).toBeLessThan(0.2001);
      expect(z).toBeCloseTo(1, 4);
      // The same place on the light.
      expect(x).toBeCloseTo(point(before, i)[0]!, 4);
      expect(y! + 0.7).toBeCloseTo(point(before, i)[1]!, 4);
    }
    // A point light a metre above: its intensity over the square of the distance.
    expect([...at(after, 2, 3)]).toEqual([0, 0, 1, 1]);
    expect(at(after, 2, 4)[0]).toBeCloseTo(2, 5);
    expect(at(after, 2, 4)[3]).toBe(1);
    // The one that was hidden is dark.
    expect(at(after, 5, 4)[3]).toBe(0);
  });
});
