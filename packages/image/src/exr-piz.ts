import { bytesOf, interleavePlanes, type ExrBlock } from './exr-block';
import { unpackHuffman } from './exr-huffman';

/** One bit for each word that occurs. */
const BITMAP_BYTES = 8192;

/** OpenEXR's PIZ: words numbered by those that occur, a wavelet in each channel, Huffman's code. */
export function unpackPiz(packed: Uint8Array, block: ExrBlock): Uint8Array | undefined {
  if (packed.length < 4) return undefined;
  const view = new DataView(packed.buffer, packed.byteOffset, packed.byteLength);
  const low = view.getUint16(0, true),
    high = view.getUint16(2, true);
  if (high >= BITMAP_BYTES) return undefined;
  const bitmap = new Uint8Array(BITMAP_BYTES);
  let at = 4;
  if (low <= high) {
    bitmap.set(packed.subarray(at, at + high - low + 1), low);
    at += high - low + 1;
  }
  const words = new Uint16Array(65536);
  let known = 0;
  for (let word = 0; word < 65536; word++)
    if (word === 0 || (bitmap[word >> 3] as number) & (1 << (word & 7))) words[known++] = word;
  if (at + 4 > packed.length) return undefined;
  const length = view.getInt32(at, true);
  at += 4;
  if (length < 0 || at + length > packed.length) return undefined;
  const { channels, width, lines } = block;
  const wordsOf = (channel: (typeof channels)[number]) => bytesOf(channel) / 2;
  const data = unpackHuffman(
    packed.subarray(at, at + length),
    width * lines * channels.reduce((sum, channel) => sum + wordsOf(channel), 0),
  );
  if (!data) return undefined;
  const planes: Uint8Array[] = [];
  let from = 0;
  for (const channel of channels) {
    const size = wordsOf(channel);
    const plane = data.subarray(from, from + width * lines * size);
    for (let part = 0; part < size; part++) undoWavelet(plane, part, width, size, lines, width * size, known - 1);
    for (let i = 0; i < plane.length; i++) plane[i] = words[plane[i] as number] as number;
    planes.push(new Uint8Array(plane.buffer, plane.byteOffset, plane.byteLength));
    from += plane.length;
  }
  return interleavePlanes(block, planes);
}

/** Average and difference of two words back to the words; a Haar wavelet that stays within 16 bits. */
function pairOf14(l: number, h: number): readonly [number, number] {
  const high = (h << 16) >> 16;
  const a = ((l << 16) >> 16) + (high & 1) + (high >> 1);
  return [a & 0xffff, (a - high) & 0xffff];
}

function pairOf16(l: number, h: number): readonly [number, number] {
  const b = (l - (h >> 1)) & 0xffff;
  return [(h + b - 0x8000) & 0xffff, b];
}

/**
 * The two-dimensional wavelet, from the coarsest level down.
 * @param max The largest number: below 2^14 no sum overflows, which a simpler variant relies on.
 */
function undoWavelet(
  data: Uint16Array,
  start: number,
  nx: number,
  ox: number,
  ny: number,
  oy: number,
  max: number,
): void {
  const pair = max < 1 << 14 ? pairOf14 : pairOf16;
  const two = (i: number, j: number) => {
    const [a, b] = pair(data[i] as number, data[j] as number);
    data[i] = a;
    data[j] = b;
  };
  let p2 = 1;
  while (p2 <= Math.min(nx, ny)) p2 *= 2;
  for (p2 /= 2; p2 > 1; p2 /= 2) {
    const p = p2 / 2;
    let y = 0;
    for (; y <= ny - p2; y += p2) {
      let x = 0;
      for (; x <= nx - p2; x += p2) {
        const i00 = start + y * oy + x * ox,
          i01 = i00 + p * ox,
          i10 = i00 + p * oy,
          i11 = i10 + p * ox;
        two(i00, i10);
        two(i01, i11);
        two(i00, i01);
        two(i10, i11);
      }
      if (nx & p) two(start + y * oy + x * ox, start + (y + p) * oy + x * ox);
    }
    if (ny & p) for (let x = 0; x <= nx - p2; x += p2) two(start + y * oy + x * ox, start + y * oy + (x + p) * ox);
  }
}
