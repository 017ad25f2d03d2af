import { bytesOf, interleavePlanes, type ExrBlock } from './exr-block';
import { fromHalf, toHalf } from './half';

/** Where the 16 halves of a square come from: each is one before it plus six bits of the packed bytes. */
const ORDER: readonly (readonly [index: number, base: number])[] = [
  [4, 0],
  [8, 4],
  [12, 8],
  [1, 0],
  [5, 4],
  [9, 8],
  [13, 12],
  [2, 1],
  [6, 5],
  [10, 9],
  [14, 13],
  [3, 2],
  [7, 6],
  [11, 10],
  [15, 14],
];

/** Halves in an order that grows with their value, back to their bits. */
const fromOrdered = (value: number) => (value & 0x8000 ? value & 0x7fff : ~value & 0xffff);

/**
 * OpenEXR's B44 and B44A: squares of 4 × 4 halves in 14 bytes, or in 3 if all are the same. Other numbers are left as
 * they are. Lossy.
 */
export function unpackB44(packed: Uint8Array, block: ExrBlock): Uint8Array | undefined {
  const { width, lines } = block;
  const square = new Uint16Array(16);
  let at = 0;
  const planes: Uint8Array[] = [];
  for (const channel of block.channels) {
    const length = width * lines * bytesOf(channel);
    if (channel.type !== 'half') {
      if (at + length > packed.length) return undefined;
      planes.push(packed.subarray(at, at + length));
      at += length;
      continue;
    }
    const plane = new Uint8Array(length);
    const view = new DataView(plane.buffer);
    for (let y = 0; y < lines; y += 4) {
      for (let x = 0; x < width; x += 4) {
        const used = unpackSquare(packed, at, square);
        if (used === 0) return undefined;
        at += used;
        for (let j = 0; j < Math.min(4, lines - y); j++) {
          for (let i = 0; i < Math.min(4, width - x); i++) {
            const bits = square[4 * j + i] as number;
            view.setUint16(2 * ((y + j) * width + x + i), channel.linear ? logarithm(bits) : bits, true);
          }
        }
      }
    }
    planes.push(plane);
  }
  return at === packed.length ? interleavePlanes(block, planes) : undefined;
}

/** Linear channels are packed by their exponentials. */
function logarithm(bits: number): number {
  const value = fromHalf(bits);
  return value > 0 && value < Infinity ? toHalf(8 * Math.log(value)) : 0;
}

/** @returns Bytes used; 0 if there are not enough. */
function unpackSquare(packed: Uint8Array, at: number, square: Uint16Array): number {
  if (at + 3 > packed.length) return 0;
  const byte = (i: number) => packed[at + i] as number;
  const first = (byte(0) << 8) | byte(1);
  const shift = byte(2) >> 2;
  if (shift >= 13) {
    square.fill(fromOrdered(first));
    return 3;
  }
  if (at + 14 > packed.length) return 0;
  const values = new Int32Array(16);
  values[0] = first;
  const bias = 0x20 << shift;
  // Six bits each, beginning two bits before byte 3.
  let bit = 22;
  for (const [index, base] of ORDER) {
    const word = (byte(bit >> 3) << 8) | ((bit >> 3) + 1 < 14 ? byte((bit >> 3) + 1) : 0);
    const six = (word >> (10 - (bit & 7))) & 0x3f;
    values[index] = ((values[base] as number) + (six << shift) - bias) & 0xffff;
    bit += 6;
  }
  for (let i = 0; i < 16; i++) square[i] = fromOrdered(values[i] as number);
  return 14;
}
