import { readFileSync, writeFileSync } from 'node:fs';
import { PathTracer, requestDevice, type PathTracerOptions } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import type { Scene } from '@glanz/scene';
import { BenchError } from '../error';
import { taskScene } from './glanz';
import { noiseOf, type Reference } from './images';
import { SCENES } from './scenes';

/** A long render of Glanz to stand for the truth. */
export interface ReferencePlan {
  readonly scene: string;
  readonly size: number;
  /** Samples per pixel in all: two independent halves, which measure the noise. */
  readonly samples: number;
  readonly gpu?: string;
  readonly file: string;
}

/** How far an image of another estimator, with independent random numbers, is from the reference. */
export interface CrossCheck {
  readonly scene: string;
  readonly samples: number;
  readonly checkSamples: number;
  /** What the check samples by: absent in older reports, whose check is the reference's estimator. */
  readonly checkedBy?: CheckOptions;
  /** Mean of the check over that of the reference, and the half-width of its 95 % interval. */
  readonly ratio: number;
  readonly ratio95: number;
  /** Blocks whose means differ by more than three standard errors, and how many there are. */
  readonly outside: number;
  readonly blocks: number;
}

/** Edge of the blocks that are compared, in 1/16 of the image's. */
const BLOCKS = 16;

/** How many of the reference's samples the check has. */
const CHECK_SHARE = 4;

/** Options that change from where light is sampled, and not how much there is. */
export type CheckOptions = Required<Pick<PathTracerOptions, 'sampler' | 'guiding' | 'lightPaths' | 'lightCandidates'>>;

/** Training paths of the check's guide over the paths of its image, and millions of them at least and at most. */
const TRAINING = { share: 0.1, min: 0.002, max: 16 } as const;

/**
 * Another unbiased estimator of the same image: directions from a guide that is learned, caustics from light paths, and
 * one of four light samples instead of one. An error in a density of either gives another mean.
 */
export function checkOptions(width: number, height: number, samples: number): CheckOptions {
  const training = (TRAINING.share * width * height * samples) / 1e6;
  return {
    sampler: 'independent',
    guiding: Math.min(TRAINING.max, Math.max(TRAINING.min, training)),
    lightPaths: 0.25,
    lightCandidates: 4,
  };
}

/** An image, RGB, stride 3, and the variance of each of its values. */
export interface Rendered {
  readonly image: Float32Array;
  readonly variance: Float32Array;
}

/** Renders an image with the variance of its mean. */
export async function render(
  device: GPUDevice,
  scene: Scene,
  options: PathTracerOptions,
  samples: number,
): Promise<Rendered> {
  const tracer = await PathTracer.create(device, scene, options);
  try {
    for await (const progress of tracer.render({ samples })) void progress;
    const rgb = (rgba: Float32Array) =>
      Float32Array.from({ length: (rgba.length / 4) * 3 }, (_, i) => rgba[4 * Math.floor(i / 3) + (i % 3)]!);
    return { image: rgb(await tracer.read('beauty')), variance: rgb(await tracer.read('variance')) };
  } finally {
    tracer.destroy();
  }
}

/** Compares a check with a reference block by block. */
export function crossCheck(
  check: Rendered,
  reference: Reference,
): Pick<CrossCheck, 'ratio' | 'ratio95' | 'outside' | 'blocks'> {
  const { width, height, mean, standardError } = reference;
  const difference = new Float64Array(BLOCKS * BLOCKS),
    variance = new Float64Array(BLOCKS * BLOCKS);
  let total = 0;
  for (let i = 0; i < mean.length; i++) {
    const pixel = Math.floor(i / 3);
    const block =
      Math.floor((Math.floor(pixel / width) * BLOCKS) / height) * BLOCKS +
      Math.floor(((pixel % width) * BLOCKS) / width);
    difference[block]! += check.image[i]! - mean[i]!;
    // Channels share their paths: at worst they err together, which counts threefold.
    variance[block]! += 3 * (check.variance[i]! + standardError[i]! ** 2);
    total += mean[i]!;
  }
  const sum = (values: Float64Array) => values.reduce((all, value) => all + value, 0);
  const outside = difference.reduce(
    (count, value, i) => count + (Math.abs(value) > 3 * Math.sqrt(variance[i]!) + 1e-6 * total ? 1 : 0),
    0,
  );
  return {
    ratio: 1 + sum(difference) / total,
    ratio95: (1.96 * Math.sqrt(sum(variance))) / total,
    outside,
    blocks: difference.length,
  };
}

/** A reference with what is known of its error. */
export interface LongRender extends Omit<CrossCheck, 'scene'> {
  readonly reference: Reference;
  /** relMSE of the reference's own noise, from its halves. */
  readonly ownRelMse: number;
}

/**
 * Renders a reference from two halves with random numbers of their own, and checks it by another estimator.
 *
 * @param samples Samples a pixel of both halves together.
 */
export async function renderReference(
  device: GPUDevice,
  scene: Scene,
  options: PathTracerOptions & { readonly width: number; readonly height: number },
  samples: number,
): Promise<LongRender> {
  const half = Math.ceil(samples / 2);
  const [a, b] = [
    await render(device, scene, { ...options, seed: 5001 }, half),
    await render(device, scene, { ...options, seed: 5002 }, half),
  ];
  const { width, height } = options;
  const mean = a.image.map((value, i) => (value + b.image[i]!) / 2);
  // Exactly what makes (x − mean)² − standardError² the product of the errors against both halves, which has no bias.
  const standardError = a.image.map((value, i) => Math.abs(value - b.image[i]!) / 2);
  const reference = { width, height, mean, standardError };
  const checkSamples = Math.ceil(samples / CHECK_SHARE);
  const checkedBy = checkOptions(width, height, checkSamples);
  const check = await render(device, scene, { ...options, seed: 5003, ...checkedBy }, checkSamples);
  return {
    reference,
    // The noise of one half, halved.
    ownRelMse: noiseOf(a.image, b.image, reference) / 2,
    samples: 2 * half,
    checkSamples,
    checkedBy,
    ...crossCheck(check, reference),
  };
}

/** Renders the reference of a scene into a file, and checks it. */
export async function makeReference(plan: ReferencePlan, log: (line: string) => void): Promise<CrossCheck> {
  const found = SCENES.find(({ name }) => name === plan.scene);
  if (!found) throw new BenchError('bench/option', `There is no scene "${plan.scene}".`);
  const { task } = await found.load(plan.size);
  const scene = await taskScene(task);
  const { gpu } = await createGpu(plan.gpu === undefined ? {} : { gpu: plan.gpu });
  const device = await requestDevice({ gpu });
  const { width, height, maxDepth, camera, multipleScattering } = task;
  const options = { width, height, maxDepth, camera, multipleScattering };
  const started = performance.now();
  const { reference, ...check } = await renderReference(device, scene, options, plan.samples);
  writeReference(plan.file, reference);
  device.destroy();
  const { ownRelMse: _, ...rest } = check;
  const { samples, ratio, ratio95, outside, blocks } = rest;
  log(
    `${plan.scene}: reference of ${samples} samples in ${((performance.now() - started) / 1000).toFixed(1)} s; another estimator gives ${ratio.toFixed(5)} ± ${ratio95.toFixed(5)} of it, ${outside} of ${blocks} blocks outside`,
  );
  return { scene: plan.scene, ...rest };
}

/** Keeps a reference in a file. */
export function writeReference(file: string, { width, height, mean, standardError }: Reference): void {
  writeFileSync(
    file,
    Buffer.concat(
      [Uint32Array.of(width, height), mean, standardError].map(
        ({ buffer, byteOffset, byteLength }) => new Uint8Array(buffer, byteOffset, byteLength),
      ),
    ),
  );
}

/** Reads what {@link writeReference} wrote. */
export function readReference(file: string | undefined): Reference {
  if (file === undefined) throw new BenchError('bench/missing-data', 'This scene needs a reference first.');
  const bytes = readFileSync(file);
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength) as ArrayBuffer;
  const [width, height] = new Uint32Array(buffer, 0, 2) as unknown as [number, number];
  const count = 3 * width * height;
  return {
    width,
    height,
    mean: new Float32Array(buffer, 8, count),
    standardError: new Float32Array(buffer, 8 + 4 * count, count),
  };
}
