import { bytesOf, rawSize, type ExrBlock } from './exr-block';
import { inflateTo } from './exr-zip';

/**
 * OpenEXR's PXR24: floats cut to 24 bits, then for each line of each channel the differences between neighbours, the
 * highest bytes first, through zlib.
 */
export function unpackPxr24(packed: Uint8Array, block: ExrBlock): Uint8Array | undefined {
  const { channels, width, lines } = block;
  const kept = (channel: (typeof channels)[number]) => (channel.type === 'float' ? 3 : bytesOf(channel));
  const planes = inflateTo(packed, width * lines * channels.reduce((sum, channel) => sum + kept(channel), 0));
  if (!planes) return undefined;
  const raw = new Uint8Array(rawSize(block));
  const view = new DataView(raw.buffer);
  let from = 0,
    to = 0;
  for (let y = 0; y < lines; y++) {
    for (const channel of channels) {
      const bytes = kept(channel),
        size = bytesOf(channel);
      let value = 0;
      for (let x = 0; x < width; x++) {
        let difference = 0;
        for (let b = 0; b < bytes; b++) difference = (difference << 8) | (planes[from + b * width + x] as number);
        value = (value + (channel.type === 'float' ? difference << 8 : difference)) >>> 0;
        if (size === 2) view.setUint16(to, value & 0xffff, true);
        else view.setUint32(to, value, true);
        to += size;
      }
      from += bytes * width;
    }
  }
  return raw;
}
