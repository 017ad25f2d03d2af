import { expect, it } from 'vitest';
import { gunzipSync } from 'node:zlib';
import { glbImages, packPixels, pixelsName } from '../../src/equal-time/load';

function glb(json: object, binary: Uint8Array): Uint8Array {
  let text = JSON.stringify(json);
  text += ' '.repeat((4 - (text.length % 4)) % 4);
  const out = new Uint8Array(28 + text.length + binary.length);
  const view = new DataView(out.buffer);
  [0x46546c67, 2, out.length, text.length, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  out.set(new TextEncoder().encode(text), 20);
  view.setUint32(20 + text.length, binary.length, true);
  view.setUint32(24 + text.length, 0x004e4942, true);
  out.set(binary, 28 + text.length);
  return out;
}

it('finds the images inside a .glb file', () => {
  const file = glb(
    {
      images: [{ bufferView: 1 }, { bufferView: 0 }],
      bufferViews: [{ byteLength: 4 }, { byteOffset: 8, byteLength: 3 }],
    },
    Uint8Array.of(1, 2, 3, 4, 0, 0, 0, 0, 7, 8, 9, 0),
  );
  expect(glbImages(file).map((bytes) => [...bytes])).toEqual([
    [7, 8, 9],
    [1, 2, 3, 4],
  ]);
  expect(glbImages(glb({}, new Uint8Array(0)))).toEqual([]);
});

it('names packed images by their contents', () => {
  expect(pixelsName(Uint8Array.of(1))).not.toBe(pixelsName(Uint8Array.of(2)));
  const packed = gunzipSync(packPixels({ width: 2, height: 1, data: Uint8Array.of(1, 2, 3, 4, 5, 6, 7, 8) }));
  expect([...packed]).toEqual([2, 0, 0, 0, 1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8]);
});
