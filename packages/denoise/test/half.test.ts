import { expectNoGpuErrors, nullDevice, testDevice } from '@glanz/gpu';
import { compose } from '@glanz/wgsl/compose';
import { afterEach, describe, expect, it } from 'vitest';
import { Denoiser } from '../src/index';
import tensor from '../src/kernels/tensor.wesl';
import { denoiseOnGpu } from './gpu';
import { CHECKED_CASES, differences, imagesOf, tolerances, weightsOf } from './oracle';
import { randomImages, randomNetwork } from './random-network';

afterEach(() => expectNoGpuErrors());

describe('half precision as a type of its own', () => {
  it('is used where the device has the feature, and only there', () => {
    const text = (DENOISE_HALF: boolean, DENOISE_F16: boolean) =>
      compose([tensor], { flags: { DENOISE_HALF, DENOISE_F16 } }).code;
    expect(text(true, true)).toMatch(/^\s*enable f16;[^]*alias DenoiseTexel = vec4h;/);
    for (const plain of [text(true, false), text(false, false)]) expect(plain).not.toMatch(/f16;|vec4h/);
  });

  it('is valid WGSL in every kernel', async () => {
    const { device, errors } = await nullDevice(['shader-f16']);
    const texts: string[] = [];
    const createShaderModule = device.createShaderModule.bind(device);
    device.createShaderModule = (descriptor) => {
      texts.push(descriptor.code);
      return createShaderModule(descriptor);
    };
    const denoiser = await Denoiser.create(device, randomNetwork(9), { webAssembly: false });
    await denoiser.prepare(64, 48);
    denoiser.destroy();
    expect(texts.filter((text) => text.includes('enable f16;')).length).toBeGreaterThan(5);
    expect(errors).toEqual([]);
    device.destroy();
  });
});

describe('half precision of the device against the oracle', async () => {
  const device = await testDevice({ features: ['shader-f16'] });
  const offered = device.features.has('shader-f16');
  const why = offered ? '' : ': the GPU has no shader-f16';
  // Compiling takes longest: the small networks, with GLANZ_FULL all.
  for (const oracle of CHECKED_CASES.filter(
    ({ net }) => process.env['GLANZ_FULL'] !== undefined || /tiny|small/.test(net),
  ))
    it.skipIf(!offered)(`${oracle.case}${why}`, async () => {
      const { expected, input, ...images } = imagesOf(oracle);
      const { rgb } = await denoiseOnGpu(weightsOf(oracle.net), images, { input, storage: 'f16' }, device);
      const found = differences(rgb, expected);
      for (const [kind, limit] of Object.entries(tolerances(oracle, 'f16')))
        expect(found[kind as keyof typeof found], kind).toBeLessThanOrEqual(limit);
    });

  it.skipIf(!offered)(`single precision does not change${why}`, async () => {
    const images = randomImages(50, 34);
    const options = { input: 'hdr', storage: 'f32' } as const;
    const [a, b] = [
      await denoiseOnGpu(randomNetwork(9, 'even'), images, options, device),
      await denoiseOnGpu(randomNetwork(9, 'even'), images, options),
    ];
    expect(a.rgba).toEqual(b.rgba);
  });
});
