import { writeTza } from './write-tza';

/** A generator of numbers in [0, 1) that is the same every time. */
export function numbersFrom(seed: number): () => number {
  let state = seed + 1;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}

/** Name, whether the first source is upsampled, sources, output channels. */
type Row = readonly [name: string, up: boolean, from: readonly string[], channels: number];

const PLAIN: readonly Row[] = [
  ['enc_conv0', false, ['input'], 4],
  ['enc_conv1', false, ['enc_conv0'], 6],
  ['enc_conv2', false, ['enc_conv1'], 5],
  ['enc_conv3', false, ['enc_conv2'], 8],
  ['enc_conv4', false, ['enc_conv3'], 7],
  ['enc_conv5a', false, ['enc_conv4'], 12],
  ['enc_conv5b', false, ['enc_conv5a'], 3],
  ['dec_conv4a', true, ['enc_conv5b', 'enc_conv3'], 17],
  ['dec_conv4b', false, ['dec_conv4a'], 4],
  ['dec_conv3a', true, ['dec_conv4b', 'enc_conv2'], 6],
  ['dec_conv3b', false, ['dec_conv3a'], 9],
  ['dec_conv2a', true, ['dec_conv3b', 'enc_conv1'], 8],
  ['dec_conv2b', false, ['dec_conv2a'], 5],
  ['dec_conv1a', true, ['dec_conv2b', 'input'], 20],
  ['dec_conv1b', false, ['dec_conv1a'], 6],
  ['dec_conv0', false, ['dec_conv1b'], 3],
];

const LARGE: readonly Row[] = [
  ['enc_conv1a', false, ['input'], 4],
  ['enc_conv1b', false, ['enc_conv1a'], 6],
  ['enc_conv2a', false, ['enc_conv1b'], 5],
  ['enc_conv2b', false, ['enc_conv2a'], 8],
  ['enc_conv3a', false, ['enc_conv2b'], 7],
  ['enc_conv3b', false, ['enc_conv3a'], 5],
  ['enc_conv4a', false, ['enc_conv3b'], 9],
  ['enc_conv4b', false, ['enc_conv4a'], 4],
  ['enc_conv5a', false, ['enc_conv4b'], 8],
  ['enc_conv5b', false, ['enc_conv5a'], 10],
  ['dec_conv4a', true, ['enc_conv5b', 'enc_conv3b'], 6],
  ['dec_conv4b', false, ['dec_conv4a'], 4],
  ['dec_conv3a', true, ['dec_conv4b', 'enc_conv2b'], 6],
  ['dec_conv3b', false, ['dec_conv3a'], 9],
  ['dec_conv2a', true, ['dec_conv3b', 'enc_conv1b'], 8],
  ['dec_conv2b', false, ['dec_conv2a'], 5],
  ['dec_conv1a', true, ['dec_conv2b', 'input'], 7],
  ['dec_conv1b', false, ['dec_conv1a'], 6],
  ['dec_conv1c', false, ['dec_conv1b'], 3],
];

/** The layers of {@link PLAIN} with as many channels each. */
const EVEN = PLAIN.map(([name, up, from, channels]): Row => [name, up, from, Math.min(channels, 4)]);

const GRAPHS = { plain: PLAIN, large: LARGE, even: EVEN };

/**
 * An archive of a network with few channels and random weights.
 *
 * @param graph `even` where a test is about something else than layers: as many of them share a program, a compiler on
 *   a CPU takes a third of the time.
 */
export function randomNetwork(
  channels: 3 | 6 | 9,
  graph: keyof typeof GRAPHS = 'plain',
  seed = 1,
): Uint8Array<ArrayBuffer> {
  const random = numbersFrom(seed);
  const counts = new Map<string, number>([['input', channels]]);
  return writeTza(
    GRAPHS[graph].flatMap(([name, , from, outputs]) => {
      const inputs = from.reduce((sum, source) => sum + counts.get(source)!, 0);
      counts.set(name, outputs);
      const spread = Math.sqrt(24 / (9 * inputs));
      const values = (count: number, scale: number, middle: number) =>
        Array.from({ length: count }, () => middle + scale * (random() - 0.5));
      return [
        {
          name: `${name}.weight`,
          shape: [outputs, inputs, 3, 3],
          type: 'f' as const,
          data: values(outputs * inputs * 9, spread, 0),
        },
        { name: `${name}.bias`, shape: [outputs], type: 'f' as const, data: values(outputs, 0.2, 0.05) },
      ];
    }),
  );
}

/** Random images: radiance over some decades, reflectances, normals with values that are not allowed. */
export function randomImages(width: number, height: number, seed = 7) {
  const random = numbersFrom(seed);
  const fill = (value: () => number) => Float32Array.from({ length: 3 * width * height }, value);
  const images = {
    width,
    height,
    color: fill(() => 10 ** (4 * random() - 3)),
    albedo: fill(random),
    normal: fill(() => 2 * random() - 1),
  };
  images.color[0] = -1;
  images.color[3] = NaN;
  images.albedo[4] = 7;
  images.normal[5] = -Infinity;
  return images;
}
