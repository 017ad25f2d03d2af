import { TemporalFilter, type FrameStep, type TemporalFilterOptions, type TemporalFrame } from '../src/temporal/index';
import { numbersFrom } from './random-network';

/** Pixels of the images. */
export const [WIDTH, HEIGHT] = [40, 24];
export const PIXELS = WIDTH * HEIGHT;

/** What a pixel shows. */
export interface Seen {
  readonly radiance: number;
  readonly albedo: number;
  readonly instance: number;
  readonly position: readonly [x: number, y: number, z: number];
  readonly normal: readonly [x: number, y: number, z: number];
  readonly virtualDepth: number;
  /** Default 1. */
  readonly roughness?: number;
  /** Pixels to where the surface was. */
  readonly motion: readonly [x: number, y: number];
}

/** A wall 2 m away that faces the camera. */
export const wall = (x: number, y: number): Seen => ({
  radiance: 0.5,
  albedo: 0.5,
  instance: 3,
  position: [0.01 * x, -0.01 * y, -2],
  normal: [0, 0, 1],
  virtualDepth: 2,
  motion: [0, 0],
});

/** A frame. */
export interface Shot {
  readonly scene: (x: number, y: number) => Seen;
  readonly step: FrameStep;
  readonly samples?: number;
  /** Standard deviation of the noise over the radiance. */
  readonly noise?: number;
  readonly instancesMoved?: boolean;
  readonly eyes?: TemporalFrame['eyes'];
  readonly projections?: TemporalFrame['projections'];
  /** In place of the noisy radiance. */
  readonly color?: (x: number, y: number) => number;
}

const bits = (value: number) => new Uint32Array(Float32Array.of(value).buffer)[0]!;
/** X and Y of a pixel. */
export const center = (i: number) => [i % WIDTH, Math.floor(i / WIDTH)] as const;

/** Runs frames through a filter: the last image's red channel, and what the frames' films were. */
export async function runShots(device: GPUDevice, shots: readonly Shot[], options: TemporalFilterOptions = {}) {
  const filter = await TemporalFilter.create(device, options);
  const usage = GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST;
  const random = numbersFrom(7);
  const films: Float32Array[] = [];
  const made: GPUBuffer[] = [];
  const buffer = (data: Float32Array<ArrayBuffer> | Uint32Array<ArrayBuffer>) => {
    const one = device.createBuffer({ size: data.byteLength, usage });
    device.queue.writeBuffer(one, 0, data);
    made.push(one);
    return one;
  };
  try {
    await filter.prepare(WIDTH, HEIGHT);
    let image = { buffer: undefined as unknown as GPUBuffer, width: WIDTH, height: HEIGHT };
    for (const { scene, step, samples = 1, noise = 0, instancesMoved = false, eyes, projections, color } of shots) {
      const seen = Array.from({ length: PIXELS }, (_, i) => scene(...center(i)));
      const film = Float32Array.from({ length: 4 * PIXELS }, (_, i) => {
        if (i % 4 === 3) return 0.25;
        const pixel = Math.floor(i / 4);
        return color?.(...center(pixel)) ?? seen[pixel]!.radiance * (1 + noise * Math.sqrt(12) * (random() - 0.5));
      });
      films.push(film);
      const vectors = (value: (seen: Seen) => readonly number[]) => Float32Array.from(seen.flatMap(value));
      image = filter.filter({
        width: WIDTH,
        height: HEIGHT,
        samples,
        step,
        instancesMoved,
        color: buffer(film),
        albedo: buffer(vectors(({ albedo }) => [albedo, albedo, albedo, 1])),
        normal: buffer(vectors(({ normal, position }) => [...normal, -position[2]])),
        position: buffer(vectors(({ position, virtualDepth }) => [...position, virtualDepth])),
        ids: buffer(Uint32Array.from(seen.flatMap(({ instance, roughness = 1 }) => [instance, 0, 0, bits(roughness)]))),
        eyes,
        projections,
        motion: buffer(vectors(({ motion }) => motion)),
      });
    }
    return { image: await filter.read(image), films };
  } finally {
    filter.destroy();
    for (const one of made) one.destroy();
  }
}

/** The red channel of a pixel. */
export const red = (image: Float32Array, x: number, y: number) => image[4 * (y * WIDTH + x)]!;

/** Root of the mean squared difference to a value, over pixels away from the borders. */
export function spread(image: Float32Array, value: number): number {
  let sum = 0;
  let count = 0;
  for (let y = 4; y < HEIGHT - 4; y++)
    for (let x = 4; x < WIDTH - 4; x++) {
      sum += (red(image, x, y) - value) ** 2;
      count++;
    }
  return Math.sqrt(sum / count);
}

/** Nothing but the mean over time. */
export const MEAN_ALONE = {
  maxHistory: 32,
  antialias: false,
  passes: 0,
  clampSigmas: Infinity,
  settledSamples: Infinity,
} as const;
