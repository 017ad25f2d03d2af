import { readFile } from 'node:fs/promises';
import { BenchError } from '../error';
import { flip } from '../flip/flip';
import { shownValue } from '../flip/shown';

/** The scenes of the quality set. */
export const QUALITY_SCENES = [
  'cornell_spheres',
  'glass_caustic',
  'textured',
  'veach_mis',
  'env_sun',
  'dof',
  'helmet',
  'pushbutton',
] as const;

/** An array of NumPy's: rows, columns, channels. */
export interface NpyImage {
  readonly height: number;
  readonly width: number;
  readonly channels: number;
  readonly data: Float32Array;
}

/** Half precision to a number. */
function halfToNumber(bits: number): number {
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  const sign = bits & 0x8000 ? -1 : 1;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/**
 * Reads a `.npy` file of version 1 with three axes in C order, of little-endian halves or single floats.
 *
 * @throws {BenchError} `bench/missing-data`
 */
export async function readNpy(path: string): Promise<NpyImage> {
  const bytes = await readFile(path).catch((cause: unknown) => {
    throw new BenchError('bench/missing-data', `"${path}" cannot be read: name the quality set with --data.`, {
      cause,
    });
  });
  const length = bytes.readUInt16LE(8);
  const header = bytes.toString('latin1', 10, 10 + length);
  const shape = /'shape': \((\d+), (\d+), (\d+)\)/.exec(header)?.slice(1).map(Number);
  const half = header.includes("'<f2'");
  if (!shape || !(half || header.includes("'<f4'")) || header.includes("'fortran_order': True"))
    throw new BenchError('bench/missing-data', `"${path}" is no image of floats: ${header.trim()}`);
  const [height, width, channels] = shape as [number, number, number];
  const at = 10 + length;
  const data = Float32Array.from({ length: height * width * channels }, (_, i) =>
    half ? halfToNumber(bytes.readUInt16LE(at + 2 * i)) : bytes.readFloatLE(at + 4 * i),
  );
  return { height, width, channels, data };
}

/** Some channels of an image. */
export const channelsOf = ({ data, channels }: NpyImage, from: number, count: number): Float32Array =>
  Float32Array.from(
    { length: (data.length / channels) * count },
    (_, i) => data[Math.floor(i / count) * channels + from + (i % count)]!,
  );

/** Mean over pixels of the squared error over the squared reference, as the reference set counts it. RGB. */
export function relativeError(test: Float32Array, reference: Float32Array): number {
  const pixels = reference.length / 3;
  const power = reference.reduce((sum, value) => sum + value * value, 0) / reference.length;
  let sum = 0;
  for (let i = 0; i < pixels; i++) {
    let error = 0;
    let own = 0;
    for (let c = 3 * i; c < 3 * i + 3; c++) {
      error += (test[c]! - reference[c]!) ** 2 / 3;
      own += reference[c]! ** 2 / 3;
    }
    sum += error / (own + 0.01 * power);
  }
  return sum / pixels;
}

const shown = (image: Float32Array) => image.map((value) => shownValue(value));

/** Mean ꟻLIP of two linear images, RGB, as sRGB shows them without a tone map. */
export const flipOf = (test: Float32Array, reference: Float32Array, width: number, height: number): number =>
  flip(shown(reference), shown(test), width, height).mean;
