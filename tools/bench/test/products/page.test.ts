import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { expect, it } from 'vitest';
import type { ProductMeasurement } from '../../src/products/measure';
import {
  joinedMeasurements,
  productPage,
  readReports,
  writeProductPage,
  type ProductReport,
} from '../../src/products/page';

const measurement = (product: string, setUpMs: number): ProductMeasurement => ({
  product,
  renderer: 'glanz',
  width: 32,
  height: 18,
  adapter: { name: 'test', software: false },
  stamped: true,
  setUpMs,
  runs: [{ samples: 10, gpuMs: 20, wallMs: 40, relMse: 0.1, relMseWithReference: 0.1, brightness: 1 }],
  noise: [0.1],
});

const report = (...details: ProductMeasurement[]): ProductReport => ({
  benchmark: 'products',
  gpu: { name: 'a GPU' },
  machine: { commit: 'abc1234' },
  settings: { titles: { a: 'a bottle', b: 'a ring' }, peer: 'three-gpu-pathtracer 0.0.26' },
  notes: [],
  details,
});

const NOISE = {
  name: "noise × wall time, three-gpu-pathtracer's over Glanz's, geometric mean",
  unit: '×',
  runs: 1,
  median: 12.3,
};

it('joins reports: of two measurements of the same, the later one', () => {
  const all = joinedMeasurements([report(measurement('a', 1), measurement('b', 2)), report(measurement('a', 3))]);
  expect(all.map(({ product, setUpMs }) => [product, setUpMs])).toEqual([
    ['a', 3],
    ['b', 2],
  ]);
});

it('writes the page and the figures of reports, and refuses other files', () => {
  const folder = mkdtempSync(join(tmpdir(), 'glanz-products-'));
  const file = join(folder, 'report.json');
  writeFileSync(file, JSON.stringify(report(measurement('a', 1))));
  const error = "relMSE after 1 s of wall time, three-gpu-pathtracer's over Glanz's, geometric mean";
  const figures = [{ name: error, unit: '×', runs: 1, median: 45.61 }, NOISE];
  writeProductPage(readReports([file]), figures, folder);
  const page = readFileSync(join(folder, 'products.md'), 'utf8');
  expect(page).toContain('takes **12.3×** as long to the same noise');
  expect(page).toContain('after a second is **45.6×** as large');
  expect(page).toContain('Measured on a GPU (commits abc1234);');
  expect(page).toContain('- `a`: a bottle\n');
  expect(page).not.toContain('a ring');
  const data = join(folder, 'products.json');
  expect(JSON.parse(readFileSync(data, 'utf8'))).toMatchObject({ figures });
  // What was joined before keeps its commits.
  writeFileSync(file, JSON.stringify({ ...report(measurement('b', 1)), machine: { commit: 'def5678' } }));
  writeProductPage(readReports([data, file]), [], folder);
  expect(readFileSync(join(folder, 'products.md'), 'utf8')).toContain('(commits abc1234, def5678);');
  writeFileSync(file, '{"benchmark":"lights"}');
  expect(() => readReports([file])).toThrow(expect.objectContaining({ code: 'bench/missing-data' }));
  rmSync(folder, { recursive: true });
});

it('says by what the references were checked', () => {
  const known = { ownRelMse: 1e-6, samples: 8, checkSamples: 2, ratio: 1, ratio95: 0.1, outside: 0, blocks: 256 };
  const checkedBy = { sampler: 'independent', guiding: 1, lightPaths: 0.25, lightCandidates: 4 } as const;
  const [a, b] = [measurement('a', 1), measurement('b', 1)];
  const [older, newer] = [
    { ...a, reference: known },
    { ...b, reference: { ...known, checkedBy } },
  ];
  const same = 'by the same estimator with another sampler';
  const other = 'another unbiased estimator';
  expect(productPage([report(older)], [])).toContain(`${same}.`);
  expect(productPage([report(newer)], [])).toContain(`by ${other}`);
  expect(productPage([report(older, newer)], [])).toContain(`${same}, for b (32 × 18) ${other}`);
});
