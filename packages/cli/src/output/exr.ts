import { encodeExr, type ExrLayer } from '@glanz/image/exr';
import type { Picture } from './picture';

/** One channel out of interleaved data. */
function plane(data: Float32Array, stride: number, offset: number): Float32Array {
  const out = new Float32Array(data.length / stride);
  for (let i = 0; i < out.length; i++) out[i] = data[i * stride + offset] as number;
  return out;
}

/** Linear radiance as R, G, B, A and the feature layers under their names, packed as OpenEXR with ZIP. */
export function exrFile({ width, height, beauty, layers, samples, software }: Picture, bits: 16 | 32): Uint8Array {
  const type = bits === 32 ? 'float' : 'half';
  const rgba = (data: Float32Array, names: string) =>
    Object.fromEntries([...names].map((name, k) => [name, plane(data, 4, k)]));
  const list: ExrLayer[] = [{ name: '', type, channels: rgba(beauty, 'RGBA') }];
  if (layers) {
    list.push(
      { name: 'albedo', type, channels: rgba(layers.albedo, 'RGB') },
      { name: 'normal', type, channels: rgba(layers.normal, 'XYZ') },
      // Halves have three digits: too few for a place or a distance, and too short a range for a variance.
      { name: 'position', type: 'float', channels: rgba(layers.position, 'XYZ') },
      { name: 'variance', type: 'float', channels: rgba(layers.variance, 'RGB') },
      { name: 'depth', type: 'float', channels: { Z: layers.depth } },
      ...layers.lights.map(({ name, data }): ExrLayer => ({
        name: `light.${name.replaceAll(/[^\w-]+/g, '_')}`,
        type,
        channels: rgba(data, 'RGB'),
      })),
      { name: 'objectId', channels: { id: layers.objectId } },
      { name: 'materialId', channels: { id: layers.materialId } },
    );
  }
  return encodeExr({ width, height, layers: list, attributes: { software, samples: String(samples) } });
}
