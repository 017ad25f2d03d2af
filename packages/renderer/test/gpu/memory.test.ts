import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Instance, Scene } from '@glanz/scene';
import { afterEach, describe, expect, it } from 'vitest';
import { PathTracer } from '../../src/index';
import { addQuad, addSphere, camera, createScene, lambert } from '../scenes';

afterEach(() => expectNoGpuErrors());

describe('memory', () => {
  it('is reported by purpose, and the parts add up', async () => {
    const device = await testDevice();
    const scene = createScene();
    addQuad(scene, 1, 0, lambert(0.5));
    scene.images.push({ name: 'p', width: 8, height: 4, data: new Uint8Array(8 * 4 * 4).fill(128) });
    scene.textures.push({ image: 0, color_space: 'srgb' });
    Object.assign(scene.materials[0] as object, { textures: { base_color: { texture: 0, channels: 'rgb' } } });
    scene.lights.push({ type: 'point', name: 'p', color: [1, 1, 1], intensity: 1, position: [0, 0, 1] });
    const tracer = await PathTracer.create(device, scene, { width: 10, height: 10, camera, pathsInFlight: 1024 });
    const { memory, gpuBytes } = tracer.statistics;
    const { shapes, lights, materials, textures, environment, paths, film, other } = memory;
    expect(shapes + lights + materials + textures + environment + paths + film + other).toBe(gpuBytes);
    for (const part of [shapes, lights, materials, textures, environment, paths, film, other])
      expect(part).toBeGreaterThan(0);
    // A path, its light sample, two queue places; a third of the texels again for mip levels; sums, moment, mean and
    // number.
    expect(memory.pathsInFlight).toBe(1024);
    expect(memory.perPath).toBeGreaterThan(100);
    expect(memory.perPath).toBeLessThan(200);
    expect(memory.perTexel).toBeGreaterThanOrEqual(4);
    expect(memory.perTexel).toBeLessThanOrEqual(4 * 1.5);
    expect(memory.perPixel).toBe(16 * 4 + 4);
    for await (const _ of tracer.render({ samples: 1 }));
    // With the coverage, which lies beside the albedo.
    await tracer.read('position');
    expect(tracer.statistics.memory.perPixel).toBe(16 * 6 + 4);
    tracer.destroy();
    expect(tracer.statistics.gpuBytes).toBe(0);
  });

  it('ten million triangles as instances render within WebGPU’s default limits, each in its place', async () => {
    const device = await testDevice({ defaultLimits: true });
    expect(device.limits.maxStorageBufferBindingSize).toBe(128 * 2 ** 20);
    const scene: Scene = createScene();
    addSphere(scene, 0.09, [0, 0, 0], lambert(0.7), 320);
    const ball = scene.instances[0] as Instance;
    scene.instances.length = 0;
    for (let y = 0; y < 10; y++)
      for (let x = 0; x < 10; x++)
        scene.instances.push({
          ...ball,
          transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.9 + 0.2 * x, 0.9 - 0.2 * y, 0, 1],
        });
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    const size = 40;
    const tracer = await PathTracer.create(device, scene, {
      width: size,
      height: size,
      camera: { type: 'orthographic', name: 'o', transform: camera.transform, xmag: 1, ymag: 1 },
      maxDepth: 3,
      pathsInFlight: 1 << 12,
    });
    const { triangles, instances, memory, gpuBytes } = tracer.statistics;
    expect(triangles * instances).toBeGreaterThan(10_000_000);
    expect(memory.perTriangle).toBeLessThan(200);
    expect(gpuBytes).toBeLessThan(64 * 2 ** 20);
    // One of 64 samples is some 0.1 pixels from each pixel's centre.
    for await (const _ of tracer.render({ samples: 64, maxSubmitMs: 1000 }));
    const ids = await tracer.read('objectId');
    for (let y = 0; y < size; y++) {
      for (let x = 0; x < size; x++) {
        // Four pixels to a cell; all of their centres are 0.035 or 0.079 from the ball's axis, under its radius.
        const [cx, cy] = [(x % 4) - 1.5, (y % 4) - 1.5];
        const inside = 0.05 * Math.hypot(cx, cy) < 0.088;
        if (inside) expect(ids[y * size + x]).toBe(10 * Math.floor(y / 4) + Math.floor(x / 4));
        else if (0.05 * Math.hypot(cx, cy) > 0.091) expect(ids[y * size + x]).toBe(0xffffffff);
      }
    }
    expect((await tracer.read('beauty')).every((value) => value >= 0 && value < 1.01)).toBe(true);
    tracer.destroy();
  });

  it('says in a sentence which limit an image exceeds', async () => {
    const device = await testDevice({ defaultLimits: true });
    const scene = createScene();
    addQuad(scene, 1, 0, lambert(0.5));
    await expect(PathTracer.create(device, scene, { width: 4096, height: 4096, camera })).rejects.toThrow(
      /^The buffer "film block" takes 256\.0 MiB, but this device's maxStorageBufferBindingSize is 128\.0 MiB: make the image smaller/,
    );
  });
});
