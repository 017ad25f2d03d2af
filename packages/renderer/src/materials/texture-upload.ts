import { compressedBytes, type Image, type Scene } from '@glanz/scene';
import { GPU_TEXTURE_BINDING, GPU_TEXTURE_COPY_DST, GPU_TEXTURE_RENDER, type GpuMemory } from '../storage/buffers';
import { arrayBytes, resizePixels, texelBytes, type TextureArray, type TexturePlan } from './textures';

/** Each level is the box average of the one above; for sRGB textures the hardware averages linear light. */
const MIP_SHADER = /* wgsl */ `
@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var linear_sampler: sampler;
struct Corner { @builtin(position) position: vec4f, @location(0) uv: vec2f }
@vertex fn corner(@builtin(vertex_index) index: u32) -> Corner {
  let uv = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
  return Corner(vec4f(uv * vec2f(2.0, -2.0) + vec2f(-1.0, 1.0), 0.0, 1.0), uv);
}
@fragment fn average(in: Corner) -> @location(0) vec4f { return textureSampleLevel(source, linear_sampler, in.uv, 0.0); }
`;

const halfScratch = new Float32Array(1);
const halfBits = new Uint32Array(halfScratch.buffer);

/** IEEE half bits of a number, rounded to nearest even; beyond the range it saturates at the largest finite half. */
export function toHalf(value: number): number {
  halfScratch[0] = Math.max(-65504, Math.min(65504, Number.isNaN(value) ? 0 : value));
  const bits = halfBits[0] as number;
  const sign = (bits >>> 16) & 0x8000;
  const exponent = ((bits >>> 23) & 0xff) - 112;
  const mantissa = bits & 0x7fffff;
  if (exponent <= 0) {
    if (exponent < -10) return sign;
    const full = mantissa | 0x800000;
    const shift = 14 - exponent;
    const rounded = (full + (1 << (shift - 1)) - 1 + ((full >>> shift) & 1)) >>> shift;
    return sign | rounded;
  }
  return (
    sign +
    (((exponent << 10) | (mantissa >>> 13)) +
      ((mantissa & 0x1fff) > 0x1000 || ((mantissa & 0x1fff) === 0x1000 && (mantissa & 0x2000) !== 0) ? 1 : 0))
  );
}

/** The half bits of many numbers, as {@link toHalf} gives them one by one. */
export function toHalves(values: Float32Array): Uint16Array<ArrayBuffer> {
  const bits = new Uint32Array(values.buffer, values.byteOffset, values.length);
  const halves = new Uint16Array(values.length);
  for (let i = 0; i < halves.length; i++) {
    const word = bits[i] as number;
    const size = word & 0x7fffffff;
    // From the smallest normal half to where rounding would leave the range, halves are floats with bits cut off.
    halves[i] =
      size >= 0x38800000 && size < 0x477fe000
        ? ((word >>> 16) & 0x8000) | ((size - 0x38000000 + 0xfff + ((size >>> 13) & 1)) >>> 13)
        : toHalf(values[i] as number);
  }
  return halves;
}

function layerBytes(
  image: Image,
  array: TextureArray,
): Uint8Array<ArrayBuffer> | Uint8ClampedArray<ArrayBuffer> | Uint16Array<ArrayBuffer> {
  const data =
    image.width === array.width && image.height === array.height
      ? image.data
      : resizePixels(image.data, image.width, image.height, array.width, array.height);
  return data instanceof Float32Array ? toHalves(data) : data;
}

/** Creates, fills and mips the texture arrays of a plan. */
export function uploadTextures(
  device: GPUDevice,
  memory: GpuMemory,
  scene: Scene,
  plan: TexturePlan,
): { textures: GPUTexture[]; samplers: GPUSampler[] } {
  const samplers = plan.samplers.map((descriptor) => device.createSampler(descriptor));
  const textures = plan.arrays.map((array, index) => {
    const mipLevelCount = array.levels ?? 1 + Math.floor(Math.log2(Math.max(array.width, array.height)));
    const texel = texelBytes(array.format);
    const texture = memory.texture(
      {
        label: `glanz scene texture ${index}`,
        size: [array.width, array.height, array.layers.length],
        format: array.format,
        mipLevelCount,
        usage: GPU_TEXTURE_BINDING | GPU_TEXTURE_COPY_DST | (array.levels === undefined ? GPU_TEXTURE_RENDER : 0),
      },
      arrayBytes(array),
    );
    array.layers.forEach((index, layer) => {
      const image = scene.images[index] as Image;
      if (array.levels !== undefined) return writeBlocks(device, texture, image, layer);
      const { bitmap } = image;
      // A bitmap that was closed has no size.
      if (bitmap && bitmap.width === array.width && bitmap.height === array.height && array.format !== 'rgba16float') {
        device.queue.copyExternalImageToTexture(
          { source: bitmap },
          { texture, origin: [0, 0, layer], premultipliedAlpha: false, colorSpace: 'srgb' },
          [array.width, array.height],
        );
        return;
      }
      const data = layerBytes(image, array);
      device.queue.writeTexture(
        { texture, origin: [0, 0, layer] },
        data,
        { bytesPerRow: array.width * texel, rowsPerImage: array.height },
        [array.width, array.height, 1],
      );
    });
    return texture;
  });
  generateMips(device, plan, textures);
  return { textures, samplers };
}

/** Levels smaller than a block are written as the block they are kept in. */
function writeBlocks(
  device: GPUDevice,
  texture: GPUTexture,
  { width, height, compressed }: Image,
  layer: number,
): void {
  compressed?.levels.forEach((level, mipLevel) => {
    const [blocksX, blocksY] = [
      Math.ceil(Math.max(1, width >> mipLevel) / 4),
      Math.ceil(Math.max(1, height >> mipLevel) / 4),
    ];
    device.queue.writeTexture(
      { texture, mipLevel, origin: [0, 0, layer] },
      level,
      { bytesPerRow: compressedBytes(4 * blocksX, 4), rowsPerImage: blocksY },
      [4 * blocksX, 4 * blocksY, 1],
    );
  });
}

function generateMips(device: GPUDevice, plan: TexturePlan, textures: readonly GPUTexture[]): void {
  const made = textures
    .map((texture, index) => ({ texture, array: plan.arrays[index] as TextureArray }))
    .filter(({ texture, array }) => texture.mipLevelCount > 1 && array.levels === undefined);
  if (made.length === 0) return;
  const module = device.createShaderModule({ label: 'glanz mips', code: MIP_SHADER });
  const sampler = device.createSampler({ minFilter: 'linear', magFilter: 'linear' });
  const pipelines = new Map<string, GPURenderPipeline>();
  const encoder = device.createCommandEncoder({ label: 'glanz mips' });
  for (const {
    texture,
    array: { format, layers },
  } of made) {
    let pipeline = pipelines.get(format);
    if (!pipeline) {
      pipeline = device.createRenderPipeline({
        label: `glanz mips ${format}`,
        layout: 'auto',
        vertex: { module, entryPoint: 'corner' },
        fragment: { module, entryPoint: 'average', targets: [{ format }] },
      });
      pipelines.set(format, pipeline);
    }
    for (let layer = 0; layer < layers.length; layer++) {
      for (let level = 1; level < texture.mipLevelCount; level++) {
        const view = (baseMipLevel: number) =>
          texture.createView({
            dimension: '2d',
            baseMipLevel,
            mipLevelCount: 1,
            baseArrayLayer: layer,
            arrayLayerCount: 1,
          });
        const group = device.createBindGroup({
          layout: pipeline.getBindGroupLayout(0),
          entries: [
            { binding: 0, resource: view(level - 1) },
            { binding: 1, resource: sampler },
          ],
        });
        const pass = encoder.beginRenderPass({
          colorAttachments: [{ view: view(level), loadOp: 'clear', storeOp: 'store' }],
        });
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, group);
        pass.draw(3);
        pass.end();
      }
    }
  }
  device.queue.submit([encoder.finish()]);
}
