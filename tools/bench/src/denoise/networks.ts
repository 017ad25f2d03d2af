/** Sizes of Open Image Denoise's networks. */
export type NetworkSize = 'small' | 'base' | 'large';

/** A layer as the benchmark counts its arithmetic. */
export interface LayerCount {
  readonly name: string;
  /** It computes 1/2^level of the pixels along each side. */
  readonly level: number;
  /** Channels of the upsampled source, 0 without one. */
  readonly up: number;
  /** Channels of the other source. */
  readonly direct: number;
  readonly out: number;
}

/** Name, level, channels from below (0: none), channels read as they are, channels computed. */
type Row = readonly [name: string, level: number, up: number, direct: number, out: number];

/** Output channels by size, and the graphs; the input has nine channels. */
const ROWS: Readonly<Record<NetworkSize, readonly Row[]>> = {
  small: [
    ['enc_conv0', 0, 0, 9, 32],
    ['enc_conv1', 0, 0, 32, 32],
    ['enc_conv2', 1, 0, 32, 32],
    ['enc_conv3', 2, 0, 32, 32],
    ['enc_conv4', 3, 0, 32, 32],
    ['enc_conv5a', 4, 0, 32, 32],
    ['enc_conv5b', 4, 0, 32, 32],
    ['dec_conv4a', 3, 32, 32, 64],
    ['dec_conv4b', 3, 0, 64, 64],
    ['dec_conv3a', 2, 64, 32, 64],
    ['dec_conv3b', 2, 0, 64, 64],
    ['dec_conv2a', 1, 64, 32, 64],
    ['dec_conv2b', 1, 0, 64, 32],
    ['dec_conv1a', 0, 32, 9, 32],
    ['dec_conv1b', 0, 0, 32, 32],
    ['dec_conv0', 0, 0, 32, 3],
  ],
  base: [
    ['enc_conv0', 0, 0, 9, 32],
    ['enc_conv1', 0, 0, 32, 32],
    ['enc_conv2', 1, 0, 32, 48],
    ['enc_conv3', 2, 0, 48, 64],
    ['enc_conv4', 3, 0, 64, 80],
    ['enc_conv5a', 4, 0, 80, 96],
    ['enc_conv5b', 4, 0, 96, 96],
    ['dec_conv4a', 3, 96, 64, 112],
    ['dec_conv4b', 3, 0, 112, 112],
    ['dec_conv3a', 2, 112, 48, 96],
    ['dec_conv3b', 2, 0, 96, 96],
    ['dec_conv2a', 1, 96, 32, 64],
    ['dec_conv2b', 1, 0, 64, 64],
    ['dec_conv1a', 0, 64, 9, 64],
    ['dec_conv1b', 0, 0, 64, 32],
    ['dec_conv0', 0, 0, 32, 3],
  ],
  large: [
    ['enc_conv1a', 0, 0, 9, 64],
    ['enc_conv1b', 0, 0, 64, 64],
    ['enc_conv2a', 1, 0, 64, 96],
    ['enc_conv2b', 1, 0, 96, 96],
    ['enc_conv3a', 2, 0, 96, 128],
    ['enc_conv3b', 2, 0, 128, 128],
    ['enc_conv4a', 3, 0, 128, 192],
    ['enc_conv4b', 3, 0, 192, 192],
    ['enc_conv5a', 4, 0, 192, 256],
    ['enc_conv5b', 4, 0, 256, 256],
    ['dec_conv4a', 3, 256, 128, 192],
    ['dec_conv4b', 3, 0, 192, 192],
    ['dec_conv3a', 2, 192, 96, 128],
    ['dec_conv3b', 2, 0, 128, 128],
    ['dec_conv2a', 1, 128, 64, 96],
    ['dec_conv2b', 1, 0, 96, 96],
    ['dec_conv1a', 0, 96, 9, 64],
    ['dec_conv1b', 0, 0, 64, 64],
    ['dec_conv1c', 0, 0, 64, 3],
  ],
};

/** The layers of a network, in the order of evaluation. */
export const layersOf = (size: NetworkSize): LayerCount[] =>
  ROWS[size].map(([name, level, up, direct, out]) => ({ name, level, up, direct, out }));

/**
 * Floating-point operations of a layer for an image: a multiplication and an addition each, where a 3×3 kernel on an
 * upsampled source is one of 2×2 on the small image.
 */
export function flopOf({ level, up, direct, out }: LayerCount, width: number, height: number): number {
  const pixels = (Math.ceil(width / 16) * 16 * Math.ceil(height / 16) * 16) / 4 ** level;
  return 2 * pixels * out * (9 * direct + 4 * up);
}

/** The same network with random weights, as a TZA archive: speed does not depend on what is computed. */
export function randomArchive(size: NetworkSize): Uint8Array<ArrayBuffer> {
  const tensors = layersOf(size).flatMap(({ name, up, direct, out }) => [
    { name: `${name}.weight`, shape: [out, up + direct, 3, 3] },
    { name: `${name}.bias`, shape: [out] },
  ]);
  const count = ({ shape }: { readonly shape: readonly number[] }) => shape.reduce((a, b) => a * b, 1);
  const align = (at: number) => Math.ceil(at / 64) * 64;
  let at = 64;
  const offsets = tensors.map((tensor) => {
    const offset = at;
    at = align(at + 4 * count(tensor));
    return offset;
  });
  const table = at;
  const entryBytes = tensors.map(({ name, shape }) => 2 + name.length + 1 + 5 * shape.length + 1 + 8);
  const bytes = new Uint8Array(table + 4 + entryBytes.reduce((a, b) => a + b, 0));
  const view = new DataView(bytes.buffer);
  view.setUint16(0, 0x41d7, true);
  view.setUint8(2, 2);
  view.setBigUint64(4, BigInt(table), true);
  view.setUint32(table, tensors.length, true);
  at = table + 4;
  let state = 1;
  const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
  for (const [i, { name, shape }] of tensors.entries()) {
    view.setUint16(at, name.length, true);
    bytes.set(new TextEncoder().encode(name), at + 2);
    at += 2 + name.length;
    view.setUint8(at++, shape.length);
    for (const length of shape) {
      view.setUint32(at, length, true);
      at += 4;
    }
    bytes.set(new TextEncoder().encode(`${shape.length === 4 ? 'oihw' : 'x'}f`), at);
    at += shape.length + 1;
    view.setBigUint64(at, BigInt(offsets[i]!), true);
    at += 8;
    // The variance that keeps activations at one size through layers with ReLU.
    const spread = shape.length === 4 ? Math.sqrt(24 / (9 * shape[1]!)) : 0;
    for (let k = 0; k < count({ shape }); k++) view.setFloat32(offsets[i]! + 4 * k, (random() - 0.5) * spread, true);
  }
  return bytes;
}
