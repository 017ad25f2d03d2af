import { GltfError } from '@glanz/gltf';
import { createGpu } from '@glanz/renderer/node';
import { requestDevice } from '@glanz/renderer';
import {
  GROUND_TRUTH_CASES,
  GroundTruth,
  referenceFolder,
  type ReferenceImage,
  compareImages,
  convergenceSlope,
  failures,
  measureConvergence,
  renderGroundTruth,
} from '@glanz/reference';
import { estimated, type Benchmark, type Figure } from '../benchmark';
import { decodePixels, packedFolder, usePackedReferences } from '../equal-time/load';
import { BenchError } from '../error';

/**
 * Targets for relMSE × samples, of a renderer with Sobol sampling and MIS compensation; those of env_sun, cornell_spheres
 * and glass_caustic are for light paths and guiding.
 */
const TARGETS: Readonly<Record<string, number>> = {
  env_soft: 0.15,
  env_sun: 0.9,
  cornell_diffuse: 0.19,
  cornell_spheres: 0.9,
  dof: 0.22,
  glass_caustic: 1.5,
  medium_scatter: 0.9,
  veach_mis: 0.2,
};

/** Error against the ground-truth references: agreement, and error per sample. */
export const benchmark: Benchmark = {
  description: 'agreement with the ground-truth references, and error per sample',
  options: {
    scenes: { type: 'string', help: 'only these, by name, separated by commas' },
    samples: { type: 'string', help: 'samples per pixel of each run' },
    depth: { type: 'string', help: "edges of a path at most; default that of each scene's reference" },
    'light-paths': { type: 'string', help: 'light paths per pixel and sample; default 0' },
    guiding: { type: 'string', help: 'millions of paths that a guide learns from; default 0' },
    runs: { type: 'string', help: 'independent runs; default 4' },
    slopes: {
      type: 'string',
      help: 'most samples per pixel for the slopes of convergence, 16 at least; without it they are not measured',
    },
  },
  async run({ log, quick, gpu, values }) {
    usePackedReferences();
    if (!referenceFolder())
      throw new BenchError(
        'bench/missing-data',
        'groundtruth needs the reference set: set GLANZ_GROUNDTRUTH to its folder "scenes".',
      );
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const device = await requestDevice({ gpu: api });
    // Independent seeds give the interval; their mean is the image that is checked.
    const runs = wholeNumber('runs', values['runs']) ?? (quick ? 2 : 4);
    const samples = wholeNumber('samples', values['samples']) ?? (quick ? 4 : software ? 32 : 256);
    const lightPaths = Number(values['light-paths'] ?? 0);
    const guiding = Number(values['guiding'] ?? 0);
    const depth = wholeNumber('depth', values['depth']);
    const requested = values['scenes']?.split(',');
    const unknown = requested?.find((name) => !GROUND_TRUTH_CASES.some(({ scene }) => scene === name));
    if (unknown !== undefined)
      throw new BenchError(
        'bench/option',
        `--scenes: there is no scene "${unknown}"; there are: ${[...new Set(GROUND_TRUTH_CASES.map(({ scene }) => scene))].join(', ')}.`,
      );
    const max = wholeNumber('slopes', values['slopes']);
    if (max !== undefined && max < 16) throw new BenchError('bench/option', `--slopes ${max}: it must be at least 16.`);
    const cases = GROUND_TRUTH_CASES.filter(({ scene }) => requested?.includes(scene) ?? true);
    const figures: Figure[] = [];
    const notes: string[] = [];
    let agreeing = 0;
    for (const { scene, variant } of cases) {
      const name = variant === 'full' ? scene : `${scene}.${variant}`;
      const truth = new GroundTruth(scene, packedFolder() ? { decodeImage: (bytes) => decodePixels(bytes) } : {});
      const { width, height } = truth.description.film;
      const sum = new Float32Array(width * height * 3);
      const perSample: number[] = [];
      const means: number[] = [];
      const start = performance.now();
      try {
        await truth.scene();
      } catch (error) {
        // A bare machine has no decoder of images: one scene less, which the count at the end shows.
        if (!(error instanceof GltfError) || error.code !== 'gltf/missing-decoder') throw error;
        notes.push(`${name} left out: ${error.message}`);
        continue;
      }
      for (let seed = 1; seed <= runs; seed++) {
        const { image, comparison } = await renderGroundTruth(device, truth, {
          samples,
          variant,
          seed,
          lightPaths,
          guiding,
          ...(depth === undefined ? {} : { maxDepth: depth }),
        });
        image.forEach((value, i) => (sum[i]! += value / runs));
        perSample.push(comparison.relMsePerSample);
        means.push(image.reduce((all, value) => all + value, 0) / image.length);
      }
      const whole = compareImages(sum, samples * runs, truth.image(variant), { width, height }, truth.tolerance);
      if (whole.passed) agreeing++;
      else notes.push(`${name} disagrees: ${failures(whole)}`);
      const target = variant === 'full' ? TARGETS[scene] : undefined;
      figures.push(
        estimated(
          `${name}: relMSE × samples`,
          '1',
          perSample,
          target === undefined ? undefined : { value: target, relation: '<=', source: 'sample efficiency aimed at' },
        ),
      );
      figures.push(meanOver(`${name}: mean over the reference's, less 1`, means, truth.image(variant)));
      const mean = perSample.reduce((a, b) => a + b, 0) / runs;
      figures.push({
        name: `${name}: samples of the reference renderer per sample`,
        unit: '1',
        runs,
        mean: truth.image(variant).stats.relmse_1spp / mean,
        ci95: 0,
      });
      if (max !== undefined && variant === 'full') {
        // Below the error that the reference set allows the reference itself, a slope would be the reference's.
        const last = Math.max(
          16,
          Math.min(max, Math.floor(truth.image(variant).stats.relmse_1spp / truth.tolerance.floor)),
        );
        // Four steps, from a sixteenth of the samples or so.
        const counts = [last / 16, last / 8, last / 4, last / 2, last].map(Math.round);
        if (last < max)
          notes.push(`${name}: slope up to ${last} samples, where its error is as low as the reference's may be`);
        const slope = convergenceSlope(await measureConvergence(device, truth, counts, runs));
        figures.push({
          name: `${name}: slope of convergence away from −1`,
          unit: '1',
          runs,
          mean: Math.abs(slope + 1),
          ci95: 0,
          target: { value: 0.05, relation: '<=', source: 'unbiased' },
        });
        log(`${name}: slope ${slope.toFixed(3)}`);
      }
      log(
        `${name}: ${whole.passed ? 'agrees' : 'DISAGREES'}, relMSE × samples ${mean.toPrecision(3)}, ${((performance.now() - start) / 1000).toFixed(1)} s`,
      );
    }
    figures.push({
      name: 'images that agree with their reference',
      unit: `of ${cases.length}`,
      runs: 1,
      mean: agreeing,
      ci95: 0,
      target: { value: cases.length, relation: '>=', source: 'all of them' },
    });
    device.destroy();
    return {
      settings: {
        samples,
        runs,
        lightPaths,
        guiding,
        ...(depth === undefined ? {} : { depth }),
        multipleScattering: false,
      },
      gpu: { name: adapterName, software },
      figures,
      notes,
    };
  },
};

/**
 * The mean of all pixels and channels over that of the reference, less 1, with the errors of both: the runs differ by
 * ours, and the reference states its own.
 */
function meanOver(name: string, means: readonly number[], { mean, standardError }: ReferenceImage): Figure {
  const truth = mean.reduce((all, value) => all + value, 0) / mean.length;
  const ours = estimated(
    name,
    '1',
    means.map((value) => value / truth - 1),
  );
  let variance = 0;
  // Channels share their paths: at worst they err together.
  for (let i = 0; i < mean.length; i += 3)
    variance += (standardError[i]! + standardError[i + 1]! + standardError[i + 2]!) ** 2;
  const own = Math.sqrt(variance) / mean.length / truth;
  return { ...ours, ci95: Math.hypot(ours.ci95 as number, 1.96 * own) };
}

function wholeNumber(name: string, text: string | undefined): number | undefined {
  if (text === undefined) return undefined;
  const value = Number(text);
  if (!Number.isInteger(value) || value < 1)
    throw new BenchError('bench/option', `--${name} ${text}: it must be a whole number of at least 1.`);
  return value;
}
