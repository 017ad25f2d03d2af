/** How the numbers of a channel are stored. */
export type ExrType = 'half' | 'float' | 'uint';

/** A channel as a file's header describes it. */
export interface ExrChannelInfo {
  readonly name: string;
  readonly type: ExrType;
  /** Whether the channel is perceptually linear: some compressions treat it differently. */
  readonly linear: boolean;
}

/** A rectangle of pixels that is compressed as one. */
export interface ExrBlock {
  /** In the order of the file. */
  readonly channels: readonly ExrChannelInfo[];
  readonly width: number;
  readonly lines: number;
}

/** Bytes of a number. */
export const bytesOf = ({ type }: { readonly type: ExrType }): number => (type === 'half' ? 2 : 4);

/** Bytes of a block as it is uncompressed: line by line, in each channel by channel. */
export const rawSize = ({ channels, width, lines }: ExrBlock): number =>
  width * lines * channels.reduce((sum, channel) => sum + bytesOf(channel), 0);

/**
 * Puts planes (each channel's pixels, line by line) into the order of an uncompressed block.
 * @param planes Bytes of each channel.
 */
export function interleavePlanes({ channels, width, lines }: ExrBlock, planes: readonly Uint8Array[]): Uint8Array {
  const raw = new Uint8Array(rawSize({ channels, width, lines }));
  let at = 0;
  for (let y = 0; y < lines; y++) {
    channels.forEach((channel, c) => {
      const length = width * bytesOf(channel);
      raw.set((planes[c] as Uint8Array).subarray(y * length, (y + 1) * length), at);
      at += length;
    });
  }
  return raw;
}

/**
 * Undoes what ZIP, RLE and DWA's averages have in common: differences between bytes, and even bytes apart from odd
 * ones. In place, into a new array.
 */
export function reconstruct(split: Uint8Array): Uint8Array {
  const size = split.length;
  for (let i = 1; i < size; i++) split[i] = (split[i] as number) + (split[i - 1] as number) - 128;
  const raw = new Uint8Array(size);
  const half = (size + 1) >> 1;
  for (let i = 0, j = 0; j < half; j++) {
    raw[i++] = split[j] as number;
    if (i < size) raw[i++] = split[half + j] as number;
  }
  return raw;
}
