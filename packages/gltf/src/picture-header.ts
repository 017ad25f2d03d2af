/** Chunks of a PNG that say what its colours mean or how it is turned. */
const PNG_MEANING = new Set(['iCCP', 'gAMA', 'cHRM', 'sRGB', 'cICP', 'mDCV', 'cLLI', 'eXIf']);

/**
 * An opaque JPEG or PNG without what it says of the meaning of its colours (profiles) and of its orientation (Exif), in
 * pieces of the bytes: every decoder gives the codes that are in the file. Undefined for what is transparent or of another kind.
 */
export function plainPicture(bytes: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer>[] | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 34) return undefined;
  return view.getUint32(0) === 0x89504e47 ? plainPng(bytes, view) : view.getUint16(0) === 0xffd8 ? plainJpeg(bytes, view) : undefined;
}

function plainPng(bytes: Uint8Array<ArrayBuffer>, view: DataView): Uint8Array<ArrayBuffer>[] | undefined {
  // Grey, RGB or a palette, of 8 bits at most.
  if (![0, 2, 3].includes(bytes[25] as number) || (bytes[24] as number) > 8) return undefined;
  const parts: Uint8Array<ArrayBuffer>[] = [];
  for (let at = 8, kept = 0; at + 12 <= bytes.length; ) {
    const type = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (type === 'IDAT') return [...parts, bytes.subarray(kept)];
    // Transparent, or moving.
    if (type === 'tRNS' || type === 'acTL') return undefined;
    const end = at + 12 + view.getUint32(at);
    if (PNG_MEANING.has(type)) {
      parts.push(bytes.subarray(kept, at));
      kept = Math.min(end, bytes.length);
    }
    at = end;
  }
  return undefined;
}

function plainJpeg(bytes: Uint8Array<ArrayBuffer>, view: DataView): Uint8Array<ArrayBuffer>[] | undefined {
  const parts: Uint8Array<ArrayBuffer>[] = [];
  for (let at = 2, kept = 0; at + 10 <= bytes.length; ) {
    const marker = view.getUint16(at);
    if (marker < 0xffc0 || marker === 0xffff) return undefined;
    // Tables of scans: pixels from here on.
    if (marker === 0xffda) return [...parts, bytes.subarray(kept)];
    const end = at + 2 + view.getUint16(at + 2);
    // A frame of four components is CMYK.
    if (marker <= 0xffcf && ![0xffc4, 0xffc8, 0xffcc].includes(marker) && bytes[at + 9] !== 1 && bytes[at + 9] !== 3) return undefined;
    // Exif and XMP; profiles and gain maps.
    if (marker === 0xffe1 || marker === 0xffe2) {
      parts.push(bytes.subarray(kept, at));
      kept = Math.min(end, bytes.length);
    }
    at = end;
  }
  return undefined;
}
