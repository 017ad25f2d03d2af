import { srgbDecode, toneMapPixels } from '@glanz/tonemap';
import type { Layer } from './layers';

const NO_SURFACE = 0xffffffff;

/** A colour that distinguishes neighbouring numbers: hues a golden angle from each other. */
function colourOf(id: number): readonly [number, number, number] {
  const hue = (id * 0.618033988749895) % 1;
  const light = 0.75 + 0.25 * ((id * 0.7548776662466927) % 1);
  const channel = (offset: number) =>
    light * (0.25 + 0.75 * Math.min(Math.max(Math.abs(((hue + offset) % 1) * 6 - 3) - 1, 0), 1));
  return [channel(0), channel(2 / 3), channel(1 / 3)];
}

/**
 * A layer as a linear RGBA image to be shown without a curve: normals as codes 0..1 from −1..1, depth from near
 * (light) to far (dark), ids as colours.
 *
 * @param data What `PathTracer.read(layer)` gave.
 */
export function layerImage(
  layer: Exclude<Layer, 'beauty'>,
  data: Float32Array | Uint32Array,
): Float32Array<ArrayBuffer> {
  if (layer === 'albedo') return Float32Array.from(data as Float32Array, (value, i) => (i % 4 === 3 ? 1 : value));
  const pixels = layer === 'normal' ? data.length / 4 : data.length;
  const image = new Float32Array(pixels * 4);
  let near = Infinity;
  let far = 0;
  if (layer === 'depth') {
    for (const metres of data) {
      if (metres <= 0) continue;
      near = Math.min(near, metres);
      far = Math.max(far, metres);
    }
  }
  for (let i = 0; i < pixels; i++) {
    let rgb: readonly [number, number, number] = [0, 0, 0];
    if (layer === 'normal') {
      const [x, y, z] = [data[4 * i] as number, data[4 * i + 1] as number, data[4 * i + 2] as number];
      if (x !== 0 || y !== 0 || z !== 0)
        rgb = [srgbDecode(0.5 + 0.5 * x), srgbDecode(0.5 + 0.5 * y), srgbDecode(0.5 + 0.5 * z)];
    } else if (layer === 'depth') {
      const metres = data[i] as number;
      const grey = metres > 0 ? srgbDecode(1 - 0.85 * (far > near ? (metres - near) / (far - near) : 0)) : 0;
      rgb = [grey, grey, grey];
    } else if (data[i] !== NO_SURFACE) rgb = colourOf(data[i] as number);
    image.set([...rgb, 1], 4 * i);
  }
  return image;
}

/** A layer as it is put on a canvas, opaque; see {@link layerImage}. */
export const layerPixels = (
  layer: Exclude<Layer, 'beauty'>,
  data: Float32Array | Uint32Array,
  width: number,
  height: number,
): ImageData =>
  new ImageData(
    toneMapPixels(layerImage(layer, data), width, height, { toneMap: 'linear', alpha: 'opaque' }),
    width,
    height,
  );
