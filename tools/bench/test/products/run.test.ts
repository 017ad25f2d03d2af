import { execFile } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import { expect, it } from 'vitest';
import type { ProductMeasurement } from '../../src/products/measure';
import type { BenchmarkReport } from '../../src/runner';

const main = fileURLToPath(new URL('../../src/main.mjs', import.meta.url));

const bench = (folder: string, ...argv: string[]) =>
  promisify(execFile)(process.execPath, [main, 'products', '--json', join(folder, 'out.json'), ...argv], {
    env: { ...process.env, GLANZ_ASSETS: folder },
  });

it('runs from start to end on any GPU', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'glanz-products-test-'));
  try {
    const small = ['--size', '16', '--samples', '2', '--runs', '2', '--reference', '8', '--renderers', 'glanz'];
    const { stdout } = await bench(folder, '--only', 'button', ...small);
    expect(stdout).toContain('| button | 16 × 16 |');
    const report = JSON.parse(readFileSync(join(folder, 'out.json'), 'utf8')) as BenchmarkReport & {
      readonly details: readonly ProductMeasurement[];
    };
    expect(report.benchmark).toBe('products');
    expect(report.details).toHaveLength(1);
    const [{ runs, reference, setUpMs }] = report.details as [ProductMeasurement];
    expect(setUpMs).toBeGreaterThan(0);
    expect(runs.map(({ samples }) => samples)).toEqual([2, 2]);
    for (const { gpuMs, relMseWithReference, brightness } of runs) {
      expect(gpuMs).toBeGreaterThan(0);
      expect(relMseWithReference).toBeGreaterThan(0);
      // Noise of two samples: far from a black image or one of another exposure.
      expect(brightness).toBeGreaterThan(0.5);
      expect(brightness).toBeLessThan(2);
    }
    // Other random numbers give other images.
    expect(runs[0]!.relMseWithReference).not.toBe(runs[1]!.relMseWithReference);
    expect(reference).toMatchObject({ samples: 8, checkSamples: 2, checkedBy: { guiding: 0.002, lightPaths: 0.25 } });
    expect(reference!.ownRelMse).toBeGreaterThan(0);
    expect(reference!.ownRelMse).toBeLessThan(runs[0]!.relMseWithReference);
  } finally {
    rmSync(folder, { recursive: true });
  }
}, 120_000);

it.each([
  [['--only', 'nothing'], 'There is no product "nothing"'],
  [['--size', '8'], '--size'],
  [['--runs', '1'], '--runs'],
  [['--renderers', 'three-gpu-pathtracer'], 'references'],
])('refuses %s', async (argv, message) => {
  const { benchmark } = await import('../../src/benchmarks/products');
  const values = Object.fromEntries([[argv[0]!.slice(2), argv[1]]]);
  await expect(benchmark.run({ log: () => undefined, quick: true, values })).rejects.toMatchObject({
    code: 'bench/option',
    message: expect.stringContaining(message) as string,
  });
});
