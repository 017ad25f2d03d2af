import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Benchmark, BenchmarkResult } from '../benchmark';
import { childJob, inChild, type ChildJobs } from '../child';
import { productFile } from '../denoise/product-scenes';
import { BenchError } from '../error';
import { listOption, numberOption } from '../options';
import { withoutPeer } from '../peers/three-gpu-pathtracer';
import { measureProduct, RENDERERS, type ProductMeasurement, type ProductPlan } from '../products/measure';
import { productOf, PRODUCTS } from '../products/scenes';
import { joinedMeasurements, readReports, writeProductPage } from '../products/page';
import { figuresOf, productTable, remarks } from '../products/summary';

const JOBS: ChildJobs<ProductPlan> = { name: 'products', file: import.meta.url, run: measureProduct };

const SIZES = '512,1920x1080';

/** Sizes such as `512,1920x1080`. */
function sizesOf(text: string): readonly { readonly width: number; readonly height: number }[] {
  return text.split(',').map((part) => {
    const [, width, height = width] = /^([1-9]\d{0,3})(?:x([1-9]\d{0,3}))?$/.exec(part) ?? [];
    if (!(Number(width) >= 16 && Number(height) >= 16))
      throw new BenchError('bench/option', `--size must be sizes of 16 pixels or more, like ${SIZES}, not "${part}".`);
    return { width: Number(width), height: Number(height) };
  });
}

/** What earlier reports say together. */
function fromReports(
  files: readonly string[],
  folder: string | undefined,
  log: (line: string) => void,
): BenchmarkResult {
  const reports = readReports(files);
  const measurements = joinedMeasurements(reports);
  const figures = figuresOf(measurements, true);
  if (folder !== undefined) for (const file of writeProductPage(reports, figures, folder)) log(`wrote ${file}`);
  process.stdout.write(`${productTable(measurements)}\n`);
  return { settings: { from: files }, figures, notes: remarks(measurements) };
}

/** Products in real light, each renderer in a process of its own on the same files. */
export const benchmark: Benchmark = {
  description: 'set-up, time and error per sample of products in real light, beside three-gpu-pathtracer',
  options: {
    only: { type: 'string', help: 'products, by name, separated by commas' },
    renderers: { type: 'string', help: `names, separated by commas (${RENDERERS.join(',')})` },
    size: { type: 'string', help: `pixels across and down, or like 1920x1080; several with commas (${SIZES})` },
    samples: { type: 'string', help: 'samples a pixel of each run (64)' },
    runs: { type: 'string', help: 'independent runs, two or more (4)' },
    reference: { type: 'string', help: 'samples a pixel of the references (2048)' },
    deadline: { type: 'string', help: 'seconds after which nothing new is begun' },
    from: { type: 'string', help: 'measures nothing: takes the data of these reports, separated by commas' },
    pages: { type: 'string', help: 'folder to write the page of the docs into, with --from' },
  },
  async run({ log, quick, gpu, values }) {
    await childJob(JOBS);
    if (values['from'] !== undefined) return fromReports(values['from'].split(','), values['pages'], log);
    if (values['pages'] !== undefined)
      throw new BenchError('bench/option', '--pages writes what --from reads: measure first.');
    const started = performance.now();
    const products = listOption(
      values['only'],
      PRODUCTS.map(({ name }) => name),
      'product',
    );
    const renderers = listOption(values['renderers'], RENDERERS, 'renderer');
    if (!renderers.includes('glanz'))
      throw new BenchError('bench/option', '--renderers must name glanz, which makes the references.');
    const sizes = sizesOf(values['size'] ?? (quick ? '48' : SIZES));
    const samples = numberOption(values, 'samples', quick ? 2 : 64);
    const runs = numberOption(values, 'runs', quick ? 2 : 4);
    if (runs < 2) throw new BenchError('bench/option', '--runs must be 2 or more: one run has no spread.');
    const referenceSamples = numberOption(values, 'reference', quick ? 8 : 2048);
    const deadline = numberOption(values, 'deadline', 1e9, false);
    const folder = mkdtempSync(join(tmpdir(), 'glanz-products-'));
    const measurements: ProductMeasurement[] = [];
    const notes: string[] = [];
    const skip = (what: string, why: string) => {
      notes.push(`${what} skipped: ${why}`);
      log(`${what} skipped: ${why}`);
    };
    const measured = async (plan: ProductPlan): Promise<ProductMeasurement | string> =>
      performance.now() - started > deadline * 1000
        ? 'the deadline had passed'
        : inChild<ProductMeasurement, ProductPlan>(JOBS, plan);
    try {
      for (const product of products) {
        const { files, notByPeer } = productOf(product);
        try {
          files.forEach(productFile);
        } catch (error) {
          if (!(error instanceof BenchError) || error.code !== 'bench/missing-data') throw error;
          skip(product, error.message);
          continue;
        }
        for (const { width, height } of sizes) {
          const plan: ProductPlan = {
            product,
            renderer: 'glanz',
            width,
            height,
            samples,
            runs,
            referenceSamples,
            referenceFile: join(folder, 'reference'),
            ...(gpu === undefined ? {} : { gpu }),
          };
          const where = `${product}, ${width} × ${height}`;
          const ours = await measured(plan);
          if (typeof ours === 'string') {
            skip(where, ours);
            continue;
          }
          measurements.push(ours);
          if (!renderers.includes('three-gpu-pathtracer')) continue;
          const without = notByPeer ?? withoutPeer(ours.adapter.name);
          const theirs = without ?? (await measured({ ...plan, renderer: 'three-gpu-pathtracer' }));
          if (typeof theirs === 'string') skip(`${where}, three-gpu-pathtracer`, theirs);
          else measurements.push(theirs);
        }
      }
    } finally {
      rmSync(folder, { recursive: true, force: true });
    }
    const adapter = measurements[0]?.adapter;
    if (!adapter) throw new BenchError('bench/not-available', `Nothing could be measured: ${notes.join('; ')}`);
    process.stdout.write(`${productTable(measurements)}\n`);
    return {
      settings: {
        products,
        titles: Object.fromEntries(products.map((name) => [name, productOf(name).title])),
        sizes,
        samples,
        runs,
        referenceSamples,
        peer: 'three-gpu-pathtracer 0.0.26 (WebGPU, wavefront) on three 0.185.0',
      },
      gpu: adapter,
      figures: figuresOf(measurements, !quick && !adapter.software),
      notes: [...notes, ...remarks(measurements)],
      details: measurements,
    };
  },
};
