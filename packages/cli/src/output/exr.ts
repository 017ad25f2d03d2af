import { encodeExr, type ExrLayer } from '@glanz/image/exr';
import { denoisedText, type RenderedImage } from './image';

/** One channel out of interleaved data. */
function plane(data: Float32Array, stride: number, offset: number): Float32Array {
  const out = new Float32Array(data.length / stride);
  for (let i = 0; i < out.length; i++) out[i] = data[i * stride + offset] as number;
  return out;
}

/** Linear radiance as R, G, B, A and the feature layers under their names, packed as OpenEXR with ZIP. */
export function exrFile(
  { width, height, beauty, denoised, layers, samples, software }: RenderedImage,
  bits: 16 | 32,
): Uint8Array {
  const type = bits === 32 ? 'float' : 'half';
  const rgba = (data: Float32Array, names: string) =>
    Object.fromEntries([...names].map((name, k) => [name, plane(data, 4, k)]));
  const list: ExrLayer[] = [{ name: '', type, channels: rgba(beauty, 'RGBA') }];
  if (denoised) list.push({ name: 'denoised', type, channels: rgba(denoised.data, 'RGBA') });
  const { albedo, normal, position, variance, depth, lights = [], objectId, materialId } = layers ?? {};
  if (albedo) list.push({ name: 'albedo', type, channels: rgba(albedo, 'RGB') });
  if (normal) list.push({ name: 'normal', type, channels: rgba(normal, 'XYZ') });
  // Halves have three digits: too few for a place or a distance, and too short a range for a variance.
  if (position) list.push({ name: 'position', type: 'float', channels: rgba(position, 'XYZ') });
  if (variance) list.push({ name: 'variance', type: 'float', channels: rgba(variance, 'RGB') });
  if (depth) list.push({ name: 'depth', type: 'float', channels: { Z: depth } });
  for (const { name, data } of lights)
    list.push({ name: `light.${name.replaceAll(/[^\w-]+/g, '_')}`, type, channels: rgba(data, 'RGB') });
  if (objectId) list.push({ name: 'objectId', channels: { id: objectId } });
  if (materialId) list.push({ name: 'materialId', channels: { id: materialId } });
  return encodeExr({
    width,
    height,
    layers: list,
    attributes: { software, samples: String(samples), ...denoisedText(denoised, 'denoised') },
  });
}
