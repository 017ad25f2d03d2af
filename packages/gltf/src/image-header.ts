/** Chunks of a PNG for colour management and orientation. */
const PNG_METADATA = new Set(['iCCP', 'gAMA', 'cHRM', 'sRGB', 'cICP', 'mDCV', 'cLLI', 'eXIf']);

/**
 * An opaque JPEG or PNG without its colour profiles and orientation (Exif), as subarrays of the bytes, so that every
 * decoder returns the values stored in the file. Undefined for images with transparency and other formats.
 */
export function opaqueImageParts(bytes: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer>[] | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 34) return undefined;
  return view.getUint32(0) === 0x89504e47
    ? plainPng(bytes, view)
    : view.getUint16(0) === 0xffd8
      ? plainJpeg(bytes, view)
      : undefined;
}

function plainPng(bytes: Uint8Array<ArrayBuffer>, view: DataView): Uint8Array<ArrayBuffer>[] | undefined {
  // Grey, RGB or a palette, with max 8 bits.
  if (![0, 2, 3].includes(bytes[25] as number) || (bytes[24] as number) > 8) return undefined;
  const parts: Uint8Array<ArrayBuffer>[] = [];
  for (let at = 8, kept = 0; at + 12 <= bytes.length;) {
    const type = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (type === 'IDAT') return [...parts, bytes.subarray(kept)];
    // Transparent or animated.
    if (type === 'tRNS' || type === 'acTL') return undefined;
    const end = at + 12 + view.getUint32(at);
    if (PNG_METADATA.has(type)) {
      parts.push(bytes.subarray(kept, at));
      kept = Math.min(end, bytes.length);
    }
    at = end;
  }
  return undefined;
}

function plainJpeg(bytes: Uint8Array<ArrayBuffer>, view: DataView): Uint8Array<ArrayBuffer>[] | undefined {
  const parts: Uint8Array<ArrayBuffer>[] = [];
  for (let at = 2, kept = 0; at + 10 <= bytes.length;) {
    const marker = view.getUint16(at);
    if (marker < 0xffc0 || marker === 0xffff) return undefined;
    // Start of scan: pixels follow.
    if (marker === 0xffda) return [...parts, bytes.subarray(kept)];
    const end = at + 2 + view.getUint16(at + 2);
    // A frame of four components is CMYK.
    if (marker <= 0xffcf && ![0xffc4, 0xffc8, 0xffcc].includes(marker) && bytes[at + 9] !== 1 && bytes[at + 9] !== 3)
      return undefined;
    // Exif and XMP; profiles and gain maps.
    if (marker === 0xffe1 || marker === 0xffe2) {
      parts.push(bytes.subarray(kept, at));
      kept = Math.min(end, bytes.length);
    }
    at = end;
  }
  return undefined;
}

/** Max compression ratio of deflate. */
const DEFLATE_RATIO = 1032;

/**
 * The size in the header of a PNG, JPEG or WebP; undefined if it is not found.
 * @throws {Error} for a PNG whose size exceeds what its bytes can encode.
 */
export function imageSize(
  bytes: Uint8Array,
  type: string,
): { readonly width: number; readonly height: number } | undefined {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (type === 'image/png' && bytes.length >= 29) {
    const size = { width: view.getUint32(16), height: view.getUint32(20) };
    const bits = (bytes[24] as number) * ([1, 0, 3, 1, 2, 0, 4][bytes[25] as number] ?? 4);
    if ((size.width * size.height * bits) / 8 > DEFLATE_RATIO * bytes.length + 65536)
      throw new Error(`its header claims that ${bytes.length} bytes hold ${size.width} × ${size.height} pixels`);
    return size;
  }
  if (type === 'image/jpeg') {
    for (let at = 2; at + 9 <= bytes.length; at += 2 + view.getUint16(at + 2)) {
      const marker = view.getUint16(at);
      if (marker < 0xffc0 || marker === 0xffff || marker === 0xffda) return undefined;
      if (marker <= 0xffcf && ![0xffc4, 0xffc8, 0xffcc].includes(marker))
        return { height: view.getUint16(at + 5), width: view.getUint16(at + 7) };
    }
  }
  if (type === 'image/webp' && bytes.length >= 30) {
    const kind = view.getUint32(12);
    // "VP8X", "VP8L", "VP8 "
    if (kind === 0x56503858)
      return {
        width: 1 + view.getUint16(24, true) + 65536 * (bytes[26] as number),
        height: 1 + view.getUint16(27, true) + 65536 * (bytes[29] as number),
      };
    if (kind === 0x5650384c)
      return {
        width: 1 + (view.getUint32(21, true) & 0x3fff),
        height: 1 + ((view.getUint32(21, true) >>> 14) & 0x3fff),
      };
    if (kind === 0x56503820)
      return { width: view.getUint16(26, true) & 0x3fff, height: view.getUint16(28, true) & 0x3fff };
  }
  return undefined;
}
