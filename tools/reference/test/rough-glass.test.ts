import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { afterEach, describe, expect, it } from 'vitest';
import { GroundTruth, renderImage } from '../src/index';
import { roughConvexGlass } from './rough-glass';

afterEach(expectNoGpuErrors);

const FULL = process.env['GLANZ_FULL'] !== undefined;

/**
 * Means of furnace_glass with rough glass and single scattering, over all pixels, for the largest numbers of edges: by
 * 29.4 million rays through {@link roughConvexGlass}, with their standard errors.
 */
const TRACED = [
  { roughness: 0.2, means: { 32: 0.988933, 100: 0.992779, 400: 0.992911 }, error: 1.8e-5 },
  { roughness: 0.3, means: { 32: 0.973036, 100: 0.97359, 400: 0.97359 }, error: 2.6e-5 },
] as const;

const EDGES = [32, 100, 400] as const;

/** The same by some rays, random in each pixel. */
function traced(truth: GroundTruth, scene: Awaited<ReturnType<GroundTruth['scene']>>, roughness: number, rays: number) {
  const { positions, indices } = scene.meshes[0]!;
  const { camera, film } = truth.description;
  const half = Math.tan((camera.yfov_deg * Math.PI) / 360);
  let seed = 1;
  const next = (): number => {
    seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0;
    // The lower half of the bits has short periods.
    return ((seed >>> 8) + 0.5) / 2 ** 24;
  };
  const trace = roughConvexGlass({ positions, indices: indices!, ior: 1.5, alpha: roughness ** 2 }, 400, next);
  const [sums, squares] = [new Float64Array(3), new Float64Array(3)];
  for (let i = 0; i < rays; i++) {
    const pixel = i % (film.width * film.height);
    const x = (((pixel % film.width) + next()) / film.width) * 2 - 1;
    const y = 1 - ((Math.floor(pixel / film.width) + next()) / film.height) * 2;
    const length = Math.hypot(x * half, y * half, 1);
    const left = trace(camera.position, [(x * half) / length, (y * half) / length, -1 / length]);
    EDGES.forEach((edges, k) => {
      sums[k]! += left[edges]! / rays;
      squares[k]! += left[edges]! ** 2 / rays;
    });
  }
  return Array.from(sums, (mean, k) => ({ mean, error: Math.sqrt((squares[k]! - mean * mean) / rays) }));
}

/** Glanz's mean over so many seeds, and its standard error. */
async function rendered(roughness: number, maxDepth: number, multipleScattering: boolean) {
  const device = await testDevice();
  const scene = await new GroundTruth('furnace_glass').scene();
  scene.materials[0]!.parameters = { ...scene.materials[0]!.parameters, specular_roughness: roughness };
  const size = { width: 32, height: 32, camera: 0, samples: FULL ? 128 : 16 };
  const means: number[] = [];
  for (let seed = 1; seed <= 8; seed++) {
    const image = await renderImage(device, scene, { ...size, maxDepth, multipleScattering, seed });
    means.push(image.reduce((sum, value) => sum + value, 0) / image.length);
  }
  const mean = means.reduce((sum, value) => sum + value, 0) / means.length;
  const variance = means.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (means.length - 1);
  return { mean, error: Math.sqrt(variance / means.length) };
}

describe('a faceted ball of rough glass in a furnace', () => {
  it.each(TRACED)('has the means that are stored, by rays of double precision: roughness $roughness', async (one) => {
    const truth = new GroundTruth('furnace_glass');
    const found = traced(truth, await truth.scene(), one.roughness, FULL ? 4e6 : 2e5);
    EDGES.forEach((edges, k) => {
      const { mean, error } = found[k]!;
      expect(Math.abs(mean - one.means[edges])).toBeLessThan(4 * Math.hypot(error, one.error));
      // A tenth of what 32 edges lack at a roughness of 0.2.
      expect(error).toBeLessThan(3.8e-4);
    });
  });

  // Student's t of 8 seeds: beyond five standard errors once in 600, and not with these seeds.
  const far = 5;
  const [smoother, rougher] = TRACED;
  for (const { roughness, means, error: own } of FULL ? [smoother, rougher] : [smoother])
    it(`renders with them, and what is missing is left by longer paths: roughness ${roughness}`, async () => {
      const [short, long] = [await rendered(roughness, 32, false), await rendered(roughness, 100, false)];
      expect(Math.abs(short.mean - means[32])).toBeLessThan(far * Math.hypot(short.error, own));
      expect(Math.abs(long.mean - means[100])).toBeLessThan(far * Math.hypot(long.error, own));
      // The errors are small enough to tell the two limits apart.
      expect(means[100] - short.mean).toBeGreaterThan((roughness > 0.25 ? 2 : far) * Math.hypot(short.error, own));
    });

  it('loses nothing with compensation once paths are long', async () => {
    const [short, long] = [await rendered(0.2, 32, true), await rendered(0.2, 400, true)];
    expect(1 - short.mean).toBeGreaterThan(far * short.error);
    expect(Math.abs(long.mean - 1)).toBeLessThan(far * long.error);
    // A tenth of what 32 edges lack.
    expect(long.error).toBeLessThan(6e-4);
  });
});
