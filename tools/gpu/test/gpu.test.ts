import { afterEach, describe, expect, it } from 'vitest';
import { expectNoGpuErrors, runCompute, testDevice } from '../src/index';

afterEach(() => expectNoGpuErrors());

const SQUARE = /* wgsl */ `
@group(0) @binding(0) var<storage, read> a: array<f32>;
@group(0) @binding(1) var<storage, read> b: array<f32>;
@group(0) @binding(2) var<storage, read_write> result: array<f32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x < arrayLength(&a)) { result[id.x] = a[id.x] * a[id.x] + b[id.x]; }
}`;

describe('testDevice', () => {
  it('computes the same values as the CPU, over several workgroups', async () => {
    const device = await testDevice();
    const a = Float32Array.from({ length: 1000 }, (_, i) => i - 500);
    const b = Float32Array.from({ length: 1000 }, (_, i) => 3 * i);
    const result = new Float32Array(
      await runCompute(device, SQUARE, { inputs: [a, b], outputBytes: 4000, workgroups: Math.ceil(1000 / 64) }),
    );
    expect(Array.from(result)).toEqual(Array.from(a, (x, i) => x * x + b[i]!));
  });

  it('draws a triangle whose pixels are the ones it covers', async () => {
    const device = await testDevice();
    const size = 64;
    const code = /* wgsl */ `
      @vertex fn vs(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
        return vec4f(select(-1.0, 1.0, i == 1u), select(-1.0, 1.0, i == 2u), 0.0, 1.0);
      }
      @fragment fn fs() -> @location(0) vec4f { return vec4f(1.0, 0.5, 0.25, 1.0); }`;
    const module = device.createShaderModule({ code });
    const pipeline = await device.createRenderPipelineAsync({
      layout: 'auto',
      vertex: { module },
      fragment: { module, targets: [{ format: 'rgba8unorm' }] },
    });
    const texture = device.createTexture({
      size: [size, size],
      format: 'rgba8unorm',
      usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC,
    });
    const staging = device.createBuffer({
      size: size * size * 4,
      usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ,
    });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginRenderPass({
      colorAttachments: [{ view: texture.createView(), loadOp: 'clear', storeOp: 'store', clearValue: [0, 0, 0, 0] }],
    });
    pass.setPipeline(pipeline);
    pass.draw(3);
    pass.end();
    encoder.copyTextureToBuffer({ texture }, { buffer: staging, bytesPerRow: size * 4 }, [size, size]);
    device.queue.submit([encoder.finish()]);
    await staging.mapAsync(GPUMapMode.READ);
    const pixels = new Uint8Array(staging.getMappedRange().slice(0));
    staging.destroy();
    texture.destroy();
    const at = (x: number, y: number) => Array.from(pixels.subarray((y * size + x) * 4, (y * size + x) * 4 + 4));
    // Corners (−1,−1), (1,−1), (−1,1): the lower left half of the image.
    expect(at(8, 48)).toEqual([255, 128, 64, 255]);
    expect(at(2, 10)).toEqual([255, 128, 64, 255]);
    expect(at(60, 10)).toEqual([0, 0, 0, 0]);
    let covered = 0;
    for (let i = 3; i < pixels.length; i += 4) covered += pixels[i] === 255 ? 1 : 0;
    expect(Math.abs(covered - (size * size) / 2)).toBeLessThanOrEqual(size);
  });

  it('is shared within a process, and offers default limits apart', async () => {
    expect(await testDevice()).toBe(await testDevice());
    const plain = await testDevice({ defaultLimits: true });
    expect(plain).not.toBe(await testDevice());
    expect(plain.limits.maxStorageBuffersPerShaderStage).toBe(8);
    expect((await testDevice()).limits.maxStorageBuffersPerShaderStage).toBeGreaterThan(8);
  });

  it('reports errors that nobody captured', async () => {
    const device = await testDevice();
    device.createBuffer({ size: 4, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.MAP_WRITE }).destroy();
    await expect(expectNoGpuErrors()).rejects.toThrow(/1 GPU error/);
    await expect(expectNoGpuErrors()).resolves.toBeUndefined();
  });
});

describe('runCompute', () => {
  it('says where a shader does not compile', async () => {
    const device = await testDevice();
    await expect(
      runCompute(device, '@compute @workgroup_size(1) fn main() {\n  let x: u32 = 1.5;\n}', { outputBytes: 4 }),
    ).rejects.toThrow(/WGSL line 2.*let x: u32/s);
  });

  it('fails on bindings that do not match', async () => {
    const device = await testDevice();
    await expect(runCompute(device, SQUARE, { inputs: [new Float32Array(4)], outputBytes: 16 })).rejects.toThrow(
      /binding/i,
    );
  });
});
