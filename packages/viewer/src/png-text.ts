/** Bytes before what follows the header of a PNG: the signature, and the header's chunk. */
const HEAD = 8 + 25;

/** The cyclic redundancy code of PNG. */
function crc32(bytes: Uint8Array): number {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let k = 0; k < 8; k++) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

function textChunk(key: string, text: string): Uint8Array<ArrayBuffer> {
  const data = Uint8Array.from(`tEXt${key}\0${text}`, (c) => Math.min(c.charCodeAt(0), 255));
  const chunk = new Uint8Array(data.length + 8);
  const view = new DataView(chunk.buffer);
  view.setUint32(0, data.length - 4);
  chunk.set(data, 4);
  view.setUint32(data.length + 4, crc32(data));
  return chunk;
}

/** Adds text to the metadata of a PNG file. Browsers write none. */
export async function markPng(png: Blob, text: Readonly<Record<string, string>>): Promise<Blob> {
  const head = await png.slice(0, HEAD).arrayBuffer();
  const chunks = Object.entries(text).map(([key, value]) => textChunk(key, value));
  return new Blob([head, ...chunks, png.slice(HEAD)], { type: png.type });
}
