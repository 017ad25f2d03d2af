import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import {
  TONE_MAPS,
  ToneMapPass,
  ToneMapError,
  srgbEncode,
  toneMapOperator,
  toneMapPixels,
  tonemapSrgb,
} from '../src/index';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

/**
 * Colours from deep shadow to far beyond white, every mixture of odd values, and random ones; seed in the name of the
 * test.
 */
function testColours(seed: number): Float32Array<ArrayBuffer> {
  const odd = [0, -0, NaN, Infinity, -Infinity, -1, 1e-45, 1e-12, 0.04, 0.08, 0.76, 0.8, 1, 16, 3.4e38, 1e6];
  const list: number[] = [];
  for (const r of odd) for (const g of odd) for (const b of odd) list.push(r, g, b, 1);
  let state = seed;
  const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
  for (let i = 0; i < 4096; i++) {
    const level = 2 ** (random() * 30 - 15);
    list.push(random() * level, random() * level, random() * level, 1);
  }
  return new Float32Array(list);
}

async function onGpu(input: Float32Array<ArrayBuffer>, name: string): Promise<Float32Array> {
  const kernel = wgslModule(
    'test/kernel',
    `@group(0) @binding(0) var<storage, read> source: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> result: array<vec4f>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x < arrayLength(&source)) { result[id.x] = vec4f(tonemap_srgb_encode(tonemap_${name}(source[id.x].rgb)), 1.0); }
}`,
    [toneMapOperator(name as 'aces').wgsl, tonemapSrgb],
  );
  const pipeline = await device.createComputePipelineAsync({
    layout: 'auto',
    compute: { module: device.createShaderModule({ code: compose([kernel]).code }) },
  });
  const source = device.createBuffer({ size: input.byteLength, usage: 0x80 | 0x8 });
  const result = device.createBuffer({ size: input.byteLength, usage: 0x80 | 0x4 });
  const staging = device.createBuffer({ size: input.byteLength, usage: 0x1 | 0x8 });
  device.queue.writeBuffer(source, 0, input);
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(
    0,
    device.createBindGroup({
      layout: pipeline.getBindGroupLayout(0),
      entries: [
        { binding: 0, resource: { buffer: source } },
        { binding: 1, resource: { buffer: result } },
      ],
    }),
  );
  pass.dispatchWorkgroups(Math.ceil(input.length / 4 / 64));
  pass.end();
  encoder.copyBufferToBuffer(result, 0, staging, 0, input.byteLength);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(1);
  const out = new Float32Array(staging.getMappedRange().slice(0));
  for (const buffer of [source, result, staging]) buffer.destroy();
  return out;
}

describe('the WGSL and the CPU twin agree to 1/512 of the encoded range (seed 20261121)', () => {
  const colours = testColours(20261121);
  it.each(TONE_MAPS)('%s', async (name) => {
    const gpu = await onGpu(colours, name);
    const { map } = toneMapOperator(name);
    let worst = 0;
    for (let i = 0; i < colours.length; i += 4) {
      const input = [colours[i], colours[i + 1], colours[i + 2]] as [number, number, number];
      const cpu = map(input);
      for (const k of [0, 1, 2] as const) {
        const difference = Math.abs((gpu[i + k] as number) - srgbEncode(cpu[k]));
        // NaN fails this comparison too.
        if (!(difference <= 1 / 512))
          expect.fail(`${name}(${input})[${k}]: GPU ${gpu[i + k]}, CPU ${srgbEncode(cpu[k])}`);
        worst = Math.max(worst, difference);
      }
    }
    expect(worst).toBeLessThanOrEqual(1 / 512);
  });
});

describe('ToneMapPass', () => {
  /** Row pitch of 256 bytes, so images of 64 pixels width copy without padding. */
  const SIZE = 64;
  const image = (width: number, height: number, pixel: (x: number, y: number) => number[]) => {
    const data = new Float32Array(width * height * 4);
    for (let y = 0; y < height; y++) for (let x = 0; x < width; x++) data.set(pixel(x, y), (y * width + x) * 4);
    return data;
  };
  const upload = (data: Float32Array<ArrayBuffer>) => {
    const buffer = device.createBuffer({ size: data.byteLength, usage: 0x80 | 0x8 });
    device.queue.writeBuffer(buffer, 0, data);
    return buffer;
  };
  async function drawn(
    pass: ToneMapPass,
    source: GPUBuffer,
    size: [number, number],
    format: GPUTextureFormat = 'rgba8unorm',
  ): Promise<Uint8Array> {
    const texture = device.createTexture({ size: [SIZE, SIZE], format, usage: 0x10 | 0x1 });
    const staging = device.createBuffer({ size: SIZE * SIZE * 4, usage: 0x1 | 0x8 });
    const encoder = device.createCommandEncoder();
    pass.draw(encoder, source, size, texture.createView(), [SIZE, SIZE]);
    encoder.copyTextureToBuffer({ texture }, { buffer: staging, bytesPerRow: SIZE * 4 }, [SIZE, SIZE]);
    device.queue.submit([encoder.finish()]);
    await staging.mapAsync(1);
    const out = new Uint8Array(staging.getMappedRange().slice(0));
    staging.destroy();
    texture.destroy();
    return out;
  }
  const ramp = image(SIZE, SIZE, (x, y) => {
    const alpha = (y + 1) / SIZE;
    return [(x / 16) * alpha, (y / 40) * alpha, 0.2 * alpha, alpha];
  });

  it('draws what toneMapPixels computes, premultiplied, within one code', async () => {
    const pass = await ToneMapPass.create(device, { format: 'rgba8unorm', toneMap: 'neutral', exposure: 0.5 });
    const source = upload(ramp);
    const gpu = await drawn(pass, source, [SIZE, SIZE]);
    const cpu = toneMapPixels(ramp, SIZE, SIZE, { toneMap: 'neutral', exposure: 0.5, output: 'float' });
    for (let i = 0; i < gpu.length; i++) {
      const alpha = cpu[i | 3] as number;
      const expected = (i & 3) === 3 ? alpha * 255 : (cpu[i] as number) * alpha * 255;
      if (!(Math.abs((gpu[i] as number) - expected) <= 1)) expect.fail(`byte ${i}: GPU ${gpu[i]}, CPU ${expected}`);
    }
    pass.destroy();
    source.destroy();
  });

  it('leaves the encoding to an -srgb target', async () => {
    const grey = image(SIZE, SIZE, () => [0.18, 0.18, 0.18, 1]);
    const source = upload(grey);
    const pass = await ToneMapPass.create(device, { format: 'rgba8unorm-srgb', toneMap: 'linear' });
    expect([...(await drawn(pass, source, [SIZE, SIZE], 'rgba8unorm-srgb')).subarray(0, 4)]).toEqual([
      118, 118, 118, 255,
    ]);
    pass.destroy();
    source.destroy();
  });

  it('puts the top row at the top, and magnifies by nearest or bilinear reading', async () => {
    // Two by two: red and green above, blue and white below.
    const source = upload(new Float32Array([1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1]));
    const pass = await ToneMapPass.create(device, { format: 'rgba8unorm', toneMap: 'linear', filter: 'nearest' });
    const at = (image: Uint8Array, x: number, y: number) => [
      ...image.subarray((y * SIZE + x) * 4, (y * SIZE + x) * 4 + 3),
    ];
    const nearest = await drawn(pass, source, [2, 2]);
    expect(at(nearest, 0, 0)).toEqual([255, 0, 0]);
    expect(at(nearest, 31, 31)).toEqual([255, 0, 0]);
    expect(at(nearest, 32, 31)).toEqual([0, 255, 0]);
    expect(at(nearest, 31, 32)).toEqual([0, 0, 255]);
    await pass.setOptions({ filter: 'bilinear' });
    const bilinear = await drawn(pass, source, [2, 2]);
    expect(at(bilinear, 0, 0)).toEqual([255, 0, 0]);
    // Pixel 32 sits at 32.5/64 × 2 − 0.5 = 0.515625 between the texels, in both directions.
    const t = 0.515625;
    const expected = [(1 - t) * (1 - t) + t * t, t, t].map((v) => Math.round(srgbEncode(v) * 255));
    at(bilinear, 32, 32).forEach((v, k) => expect(Math.abs(v - (expected[k] as number))).toBeLessThanOrEqual(1));
    pass.destroy();
    source.destroy();
  });

  it('changes tone map and exposure, the last request winning', async () => {
    const source = upload(image(SIZE, SIZE, () => [0.5, 0.25, 0.1, 1]));
    const pass = await ToneMapPass.create(device, { format: 'rgba8unorm' });
    const first = pass.setOptions({ toneMap: 'agx' });
    const second = pass.setOptions({ toneMap: 'aces', exposure: 1 });
    await Promise.all([first, second]);
    const gpu = await drawn(pass, source, [SIZE, SIZE]);
    const cpu = toneMapPixels(new Float32Array([0.5, 0.25, 0.1, 1]), 1, 1, { toneMap: 'aces', exposure: 1 });
    for (let k = 0; k < 4; k++) expect(Math.abs((gpu[k] as number) - (cpu[k] as number))).toBeLessThanOrEqual(1);
    await expect(pass.setOptions({ toneMap: 'film' as 'agx' })).rejects.toThrow(ToneMapError);
    expect(pass.settings.toneMap).toBe('aces');
    pass.destroy();
    source.destroy();
  });

  it('reports a shader that does not compile by a typed error, and keeps the curve that does', async () => {
    const source = upload(image(SIZE, SIZE, () => [0.5, 0.25, 0.1, 1]));
    let broken = '';
    const driver = new Proxy(device, {
      get(target, name) {
        if (name === 'createRenderPipelineAsync' && broken)
          return (given: GPURenderPipelineDescriptor) =>
            given.label?.includes(broken)
              ? Promise.reject(new Error('internal compiler error'))
              : target.createRenderPipelineAsync(given);
        const value = Reflect.get(target, name, target) as unknown;
        return typeof value === 'function' ? (value as (...all: unknown[]) => unknown).bind(target) : value;
      },
    });
    const refused = expect.objectContaining({
      name: 'ToneMapError',
      code: 'tonemap/pipeline',
      cause: expect.objectContaining({ message: 'internal compiler error' }) as unknown,
    });
    const pass = await ToneMapPass.create(driver, { format: 'rgba8unorm' });
    broken = 'agx';
    await expect(pass.setOptions({ toneMap: 'agx', exposure: 1 })).rejects.toEqual(refused);
    expect(pass.settings).toMatchObject({ toneMap: 'neutral', exposure: 1 });
    const gpu = await drawn(pass, source, [SIZE, SIZE]);
    const cpu = toneMapPixels(new Float32Array([0.5, 0.25, 0.1, 1]), 1, 1, { toneMap: 'neutral', exposure: 1 });
    for (let k = 0; k < 4; k++) expect(Math.abs((gpu[k] as number) - (cpu[k] as number))).toBeLessThanOrEqual(1);
    // Not for ever.
    broken = '';
    await pass.setOptions({ toneMap: 'agx' });
    expect(pass.settings.toneMap).toBe('agx');
    broken = 'aces';
    await expect(ToneMapPass.create(driver, { format: 'rgba8unorm', toneMap: 'aces' })).rejects.toEqual(refused);
    for (const exposure of [NaN, Infinity, 1e30, '1' as never]) {
      await expect(pass.setOptions({ exposure, toneMap: 'linear' })).rejects.toMatchObject({
        code: 'tonemap/exposure',
      });
      await expect(ToneMapPass.create(driver, { format: 'rgba8unorm', exposure })).rejects.toMatchObject({
        code: 'tonemap/exposure',
      });
    }
    expect(pass.settings).toMatchObject({ toneMap: 'agx', exposure: 1 });
    pass.destroy();
    source.destroy();
  });

  it('opaque ignores coverage; pixels that are not numbers come out as defined ones', async () => {
    const source = upload(image(SIZE, SIZE, (x) => (x < 32 ? [NaN, Infinity, 0.5, NaN] : [0.5, 0.5, 0.5, 0])));
    const pass = await ToneMapPass.create(device, { format: 'rgba8unorm', toneMap: 'linear', alpha: 'opaque' });
    const opaque = await drawn(pass, source, [SIZE, SIZE]);
    expect([...opaque.subarray(0, 4)]).toEqual([0, 255, 188, 255]);
    expect([...opaque.subarray(160, 164)]).toEqual([188, 188, 188, 255]);
    await pass.setOptions({ alpha: 'premultiplied' });
    const premultiplied = await drawn(pass, source, [SIZE, SIZE]);
    expect([...premultiplied.subarray(0, 4)]).toEqual([0, 0, 0, 0]);
    expect([...premultiplied.subarray(160, 164)]).toEqual([0, 0, 0, 0]);
    pass.destroy();
    source.destroy();
  });

  it('refuses impossible sizes and use after destroy, and may be destroyed twice', async () => {
    const source = upload(new Float32Array(16));
    const pass = await ToneMapPass.create(device, { format: 'rgba8unorm' });
    await expect(drawn(pass, source, [3, 3])).rejects.toThrow(/3×3 pixels of 16 bytes from 64 bytes/);
    await expect(drawn(pass, source, [0, 2])).rejects.toThrow(ToneMapError);
    pass.destroy();
    pass.destroy();
    await expect(drawn(pass, source, [2, 2])).rejects.toThrow(/destroyed/);
    await expect(ToneMapPass.create(device, { format: 'rgba8unorm', toneMap: 'none' as 'agx' })).rejects.toThrow(
      ToneMapError,
    );
    source.destroy();
  });
});
