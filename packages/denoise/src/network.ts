import { DenoiseError } from './error';
import { parseTza, type TzaTensor } from './tza';

/** Where a layer's input comes from: the index of a layer, or `INPUT`. */
export type LayerSource = number;

/** The encoded images, as the source of a layer. */
export const INPUT = -1;

/** A convolution of 3×3 with ReLU, and what surrounds it. */
export interface Layer {
  readonly name: string;
  /** The layer computes 1/2^level of the pixels along each side. */
  readonly level: number;
  /** The layer whose output is doubled in size (each pixel repeated) and comes first among the input channels. */
  readonly up: LayerSource | undefined;
  /** The layer whose output is read as it is. */
  readonly direct: LayerSource;
  /** Channels that come from `up`, 0 without one. */
  readonly upChannels: number;
  /** Channels that come from `direct`. */
  readonly directChannels: number;
  /** Channels of the output. */
  readonly channels: number;
  /** Whether the output is the maximum of 2×2 pixels, at level + 1. */
  readonly pool: boolean;
  /** `[out][in][row][column]`, correlation. */
  readonly weights: Float32Array;
  readonly bias: Float32Array;
}

/** A network of Open Image Denoise: its layers in the order of evaluation. */
export interface Network {
  /** Channels of the input: 3 (image), 6 (and albedo) or 9 (and normal). */
  readonly channels: 3 | 6 | 9;
  readonly layers: readonly Layer[];
  /** Half of the receptive field in pixels, rounded up to a multiple of 16: how far a pixel's result depends on others. */
  readonly overlap: number;
}

/** A row of a graph: name, level, then p for pooling, u for an upsampled predecessor, and the layer that is skipped to. */
type Row = readonly [name: string, level: number, pool?: 'p' | 'u' | undefined, skip?: string];

/** Small and base differ by their channel counts alone. */
const PLAIN: readonly Row[] = [
  ['enc_conv0', 0],
  ['enc_conv1', 0, 'p'],
  ['enc_conv2', 1, 'p'],
  ['enc_conv3', 2, 'p'],
  ['enc_conv4', 3, 'p'],
  ['enc_conv5a', 4],
  ['enc_conv5b', 4],
  ['dec_conv4a', 3, 'u', 'enc_conv3'],
  ['dec_conv4b', 3],
  ['dec_conv3a', 2, 'u', 'enc_conv2'],
  ['dec_conv3b', 2],
  ['dec_conv2a', 1, 'u', 'enc_conv1'],
  ['dec_conv2b', 1],
  ['dec_conv1a', 0, 'u', ''],
  ['dec_conv1b', 0],
  ['dec_conv0', 0],
];

/** Two convolutions a level in the encoder. */
const LARGE: readonly Row[] = [
  ['enc_conv1a', 0],
  ['enc_conv1b', 0, 'p'],
  ['enc_conv2a', 1],
  ['enc_conv2b', 1, 'p'],
  ['enc_conv3a', 2],
  ['enc_conv3b', 2, 'p'],
  ['enc_conv4a', 3],
  ['enc_conv4b', 3, 'p'],
  ['enc_conv5a', 4],
  ['enc_conv5b', 4],
  ['dec_conv4a', 3, 'u', 'enc_conv3b'],
  ['dec_conv4b', 3],
  ['dec_conv3a', 2, 'u', 'enc_conv2b'],
  ['dec_conv3b', 2],
  ['dec_conv2a', 1, 'u', 'enc_conv1b'],
  ['dec_conv2b', 1],
  ['dec_conv1a', 0, 'u', ''],
  ['dec_conv1b', 0],
  ['dec_conv1c', 0],
];

const unknownNetwork = (why: string) =>
  new DenoiseError(
    'denoise/weights',
    `The weights belong to no known network: ${why}. Use the .tza files of Open Image Denoise 2.x.`,
  );

function tensorOf(tensors: ReadonlyMap<string, TzaTensor>, name: string, shape: readonly (number | undefined)[]) {
  const tensor = tensors.get(name);
  if (!tensor) throw unknownNetwork(`tensor "${name}" is missing`);
  if (tensor.shape.length !== shape.length || shape.some((size, i) => size !== undefined && size !== tensor.shape[i]))
    throw unknownNetwork(
      `tensor "${name}" has the shape [${tensor.shape.join(', ')}], not [${shape.map((size) => size ?? 'any').join(', ')}]`,
    );
  return tensor;
}

/**
 * Recognises the network that an archive holds; channel counts are those of its tensors.
 *
 * @throws {DenoiseError} `denoise/weights` where bytes are no archive, or tensors are missing, superfluous or of other
 * sizes than their neighbours.
 */
export function readNetwork(weights: Uint8Array | ArrayBuffer): Network {
  const tensors = parseTza(weights);
  const rows = tensors.has('enc_conv1b.weight') ? LARGE : PLAIN;
  if (tensors.size !== 2 * rows.length) throw unknownNetwork(`it has ${tensors.size} tensors, not ${2 * rows.length}`);
  const first = tensorOf(tensors, `${rows[0]![0]}.weight`, [undefined, undefined, 3, 3]).shape[1];
  if (first !== 3 && first !== 6 && first !== 9) throw unknownNetwork(`it has ${first} input channels, not 3, 6 or 9`);
  const layers: Layer[] = [];
  const channelsOf = (source: LayerSource) => (source === INPUT ? first : layers[source]!.channels);
  for (const [i, [name, level, what, skip]] of rows.entries()) {
    const last = i === rows.length - 1;
    const up = what === 'u' ? i - 1 : undefined;
    const direct = what === 'u' ? rows.findIndex((row) => row[0] === skip) : i - 1;
    const upChannels = up === undefined ? 0 : channelsOf(up);
    const directChannels = channelsOf(direct);
    const weight = tensorOf(tensors, `${name}.weight`, [last ? 3 : undefined, upChannels + directChannels, 3, 3]);
    const channels = weight.shape[0]!;
    const bias = tensorOf(tensors, `${name}.bias`, [channels]);
    const pool = what === 'p';
    layers.push({
      name,
      level,
      up,
      direct,
      upChannels,
      directChannels,
      channels,
      pool,
      weights: weight.data,
      bias: bias.data,
    });
  }
  // 174 and 202 pixels, by adding up kernels of 3 at each level.
  return { channels: first, layers, overlap: rows === LARGE ? 112 : 96 };
}
