import { CliError } from '../errors';

/** A file to write, and how. */
export interface OutputTarget {
  /** As the user gave it. */
  readonly path: string;
  readonly format: 'png' | 'exr' | 'hdr' | 'film';
  /** Bits per channel: 8 or 16 in PNG, 16 (half) or 32 in EXR and films; 8 with a shared exponent in HDR. */
  readonly bits: 8 | 16 | 32;
}

const DEPTHS = { png: [8, 16], exr: [16, 32], hdr: [8], film: [32] } as const;

/**
 * The format that a file's ending asks for.
 *
 * @param bits What `--bits` says. A format that lacks it takes its default as long as it has a choice of its own.
 * @throws {CliError} `cli/usage` for another ending or depth.
 */
export function formatOf(path: string, bits?: number): OutputTarget {
  const ending = /\.([a-z0-9]+)$/i.exec(path)?.[1]?.toLowerCase();
  if (ending !== 'png' && ending !== 'exr' && ending !== 'hdr' && ending !== 'film') {
    throw new CliError('cli/usage', `Unknown format of "${path}": the name must end in .png, .exr, .hdr or .film.`);
  }
  const depths: readonly number[] = DEPTHS[ending];
  if (bits !== undefined && ending !== 'hdr' && ending !== 'film' && !depths.includes(bits)) {
    throw new CliError(
      'cli/usage',
      `--bits ${bits} is not possible for "${path}": .${ending} has ${depths.join(' or ')}.`,
    );
  }
  return {
    path,
    format: ending,
    bits: (ending === 'hdr' || ending === 'film' ? depths[0] : (bits ?? depths[0])) as OutputTarget['bits'],
  };
}
