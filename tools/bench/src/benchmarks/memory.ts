import { createPushButton } from '@glanz/models';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { createScene, type Instance, type Scene } from '@glanz/scene';
import { timed, type Benchmark, type Figure } from '../benchmark';

/** Bindings that every WebGPU device has. */
const DEFAULT_BINDING = 128 * 2 ** 20;

/** The push-button of medium resolution, a hundred times. */
function instanced(): Scene {
  const scene = createPushButton({ level: 'medium' });
  const parts = scene.instances;
  const instances: Instance[] = [];
  for (let z = 0; z < 10; z++) {
    for (let x = 0; x < 10; x++) {
      // Five centimetres apart, as the button is some three wide.
      for (const part of parts)
        instances.push({
          ...part,
          transform: Array.from(
            part.transform,
            (value, i) => value + (i === 12 ? 0.05 * (x - 4.5) : i === 14 ? -0.05 * z : 0),
          ),
        });
    }
  }
  return { ...scene, instances };
}

/** Sixty squares, each with an image of its own as base colour: of eight sizes, 8 bits a channel or half floats. */
function textured(data: (length: number) => Uint8Array<ArrayBuffer> | Float32Array<ArrayBuffer>): Scene {
  const scene = createScene('sixty textures');
  scene.meshes.push({
    name: 'square',
    positions: Float32Array.of(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0),
    indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
    uvs: [Float32Array.of(0, 1, 1, 1, 1, 0, 0, 0)],
  });
  for (let i = 0; i < 60; i++) {
    const [width, height] = [64 << (i % 4), 64 << (i % 2)];
    scene.images.push({ name: `image ${i}`, width, height, data: data(4 * width * height) });
    scene.textures.push({ image: i, color_space: i % 3 === 0 ? 'linear' : 'srgb' });
    scene.materials.push({
      name: `material ${i}`,
      parameters: {},
      textures: { base_color: { texture: i, channels: 'rgb' } },
    });
    scene.instances.push({
      name: `square ${i}`,
      mesh: 0,
      material: i,
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 2.1 * (i % 10), 2.1 * Math.floor(i / 10), 0, 1],
    });
  }
  return scene;
}

/**
 * Whether large scenes run within WebGPU's default limits, and what a path, a triangle, a pixel and a texel cost in
 * bytes.
 */
export const benchmark: Benchmark = {
  description:
    "GPU memory by purpose within WebGPU's default limits: a model of 1.07 million triangles, 10 million as instances, and 60 textures",
  async run({ log, quick, gpu }) {
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const device = await requestDevice({ gpu: api, defaultLimits: true });
    const size = software || quick ? 64 : 512;
    const figures: Figure[] = [];
    const one = (name: string, unit: string, value: number, target?: Figure['target']) =>
      figures.push(timed(name, unit, [value], target));
    const cases: readonly (readonly [string, () => Scene])[] = [
      ['push-button high', () => createPushButton({ level: 'high' })],
      ['100 push-buttons medium', instanced],
      ['60 textures of 8 bits', () => textured((length) => new Uint8Array(length).fill(128))],
      ['60 textures of floats', () => textured((length) => new Float32Array(length).fill(0.5))],
    ];
    for (const [name, make] of cases) {
      log(`${name}: building the model`);
      const scene = make();
      scene.environment = { type: 'constant', radiance: [1, 1, 1] };
      const tracer = await PathTracer.create(device, scene, { width: size, height: size, maxDepth: 5 });
      const start = performance.now();
      for await (const progress of tracer.render({ samples: quick ? 1 : 4, maxSubmitMs: 500 })) void progress;
      const pixels = await tracer.read('beauty');
      const renderMs = performance.now() - start;
      if (!pixels.every((value) => value >= 0 && value < Infinity))
        throw new Error(`${name}: the image holds values that are no radiance`);
      const { triangles, memory, gpuBytes, badSamples } = tracer.statistics;
      const visible = scene.instances.reduce((sum, { mesh }) => sum + (scene.meshes[mesh]?.indices.length ?? 0) / 3, 0);
      if (memory.textures > 0) {
        // Of a scene that is all textures the rest says nothing.
        one(`${name}: textures`, 'MiB', memory.textures / 2 ** 20);
        one(`${name}: bytes per texel, with smaller levels`, 'B', memory.perTexel);
        tracer.destroy();
        continue;
      }
      one(`${name}: triangles seen`, '1', visible);
      one(`${name}: triangles stored`, '1', triangles);
      one(`${name}: GPU memory`, 'MiB', gpuBytes / 2 ** 20);
      one(`${name}: shapes`, 'MiB', memory.shapes / 2 ** 20);
      one(`${name}: bytes per stored triangle`, 'B', memory.perTriangle);
      one(`${name}: bytes per path in flight`, 'B', memory.perPath);
      one(`${name}: bytes per pixel`, 'B', memory.perPixel);
      one(`${name}: samples that were no numbers`, '1', badSamples, {
        value: 0,
        relation: '<=',
        source: 'a healthy film',
      });
      one(`${name}: rendering`, 'ms', renderMs);
      log(`${name}: ${(visible / 1e6).toFixed(2)} M triangles in ${(gpuBytes / 2 ** 20).toFixed(0)} MiB`);
      tracer.destroy();
    }
    const limit = device.limits.maxStorageBufferBindingSize;
    device.destroy();
    return {
      settings: {
        width: size,
        height: size,
        maxDepth: 5,
        maxStorageBufferBindingSize: limit,
        defaultLimit: DEFAULT_BINDING,
      },
      gpu: { name: adapterName, software },
      figures,
    };
  },
};
