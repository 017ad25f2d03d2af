import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { decodeExr, encodeExr } from '@glanz/image';
import { ReferenceError } from '../error';
import type { Estimate } from './estimate';
import type { GlassSceneName } from './glass-scenes';

const OWN = 'tools/reference/glass';
const CHANNELS = ['R', 'G', 'B'] as const;
const ERRORS = 'standard_error';

/** How a reference of a glass scene was made. */
export interface GlassReferenceInfo {
  readonly samples: number;
  readonly seed: number;
  readonly maxDepth: number;
  /** The command that makes it again. */
  readonly command: string;
  /** Means of red, green and blue over the image, and their standard errors. */
  readonly mean: readonly number[];
  readonly standardError: readonly number[];
}

/** The folder of the references: `tools/reference/glass`, looked for upwards. */
function folder(): string {
  for (let at = dirname(fileURLToPath(import.meta.url)); ; at = dirname(at)) {
    const candidate = join(at, OWN);
    if (existsSync(candidate)) return candidate;
    if (at === dirname(at)) throw new ReferenceError('reference/absent', `There is no folder ${OWN} here.`);
  }
}

/** Means of the channels over an image, with their standard errors. */
export function imageMean({ mean, standardError }: Estimate): { mean: number[]; standardError: number[] } {
  const pixels = mean.length / 3;
  const [sums, squares] = [
    [0, 0, 0],
    [0, 0, 0],
  ];
  for (let i = 0; i < mean.length; i++) {
    sums[i % 3]! += mean[i]! / pixels;
    squares[i % 3]! += (standardError[i]! / pixels) ** 2;
  }
  return { mean: sums, standardError: squares.map(Math.sqrt) };
}

/** Writes a reference: an EXR of 32-bit floats with `R`, …, `standard_error.R`, …, and a JSON beside it. */
export function writeGlassReference(
  name: GlassSceneName,
  image: Estimate,
  size: { readonly width: number; readonly height: number },
  how: Pick<GlassReferenceInfo, 'samples' | 'seed' | 'maxDepth' | 'command'>,
  target = folder(),
): void {
  const layer = (layerName: string, values: Float64Array) => ({
    name: layerName,
    type: 'float' as const,
    channels: Object.fromEntries(
      CHANNELS.map((channel, k) => [channel, Float32Array.from(values.filter((_, i) => i % 3 === k))]),
    ),
  });
  const layers = [layer('', image.mean), layer(ERRORS, image.standardError)];
  mkdirSync(target, { recursive: true });
  writeFileSync(join(target, `${name}.exr`), encodeExr({ ...size, layers }));
  const info: GlassReferenceInfo = { ...how, ...imageMean(image) };
  writeFileSync(join(target, `${name}.json`), `${JSON.stringify(info, undefined, 2)}\n`);
}

/**
 * The reference of a glass scene.
 *
 * @throws {ReferenceError} `reference/absent`, `reference/channels`
 */
export function readGlassReference(name: GlassSceneName): {
  readonly image: Estimate;
  readonly info: GlassReferenceInfo;
} {
  const file = join(folder(), `${name}.exr`);
  const { width, height, channels } = decodeExr(readFileSync(file));
  const values = (prefix: string): Float64Array => {
    const planes = CHANNELS.map((channel) => channels.get(prefix + channel)?.data);
    return Float64Array.from({ length: 3 * width * height }, (_, i) => {
      const data = planes[i % 3];
      if (!data) throw new ReferenceError('reference/channels', `${file} has no channel ${prefix}${CHANNELS[i % 3]}.`);
      return data[Math.floor(i / 3)]!;
    });
  };
  return {
    image: { mean: values(''), standardError: values(`${ERRORS}.`) },
    info: JSON.parse(readFileSync(join(folder(), `${name}.json`), 'utf8')) as GlassReferenceInfo,
  };
}
