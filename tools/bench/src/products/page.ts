import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Figure } from '../benchmark';
import { BenchError } from '../error';
import type { ProductMeasurement } from './measure';
import { meansOf, productTable, remarks } from './summary';

/** Which code was measured, and when. */
interface Source {
  readonly commit?: string;
  readonly date?: string;
}

/** What is read of a report of the benchmark `products`. */
export interface ProductReport {
  readonly benchmark: string;
  readonly gpu?: { readonly name: string };
  readonly machine: Source;
  /** Of joined reports: where each comes from. */
  readonly sources?: readonly Source[];
  readonly settings: { readonly titles: Readonly<Record<string, string>>; readonly peer: string };
  readonly notes: readonly string[];
  readonly details: readonly ProductMeasurement[];
}

/** @throws {BenchError} `bench/missing-data` for a file that is no report of `products` */
export function readReports(files: readonly string[]): readonly ProductReport[] {
  return files.map((file) => {
    const report = JSON.parse(readFileSync(file, 'utf8')) as ProductReport;
    if (report.benchmark !== 'products' || !Array.isArray(report.details))
      throw new BenchError('bench/missing-data', `"${file}" is not a report of the benchmark products.`);
    return report;
  });
}

/** The measurements of several reports; of two of the same, the later one. */
export function joinedMeasurements(reports: readonly ProductReport[]): readonly ProductMeasurement[] {
  const all = new Map<string, ProductMeasurement>();
  for (const one of reports.flatMap(({ details }) => details))
    all.set([one.product, one.width, one.height, one.renderer].join(), one);
  return [...all.values()];
}

const sourcesOf = (reports: readonly ProductReport[]): Source[] =>
  reports.flatMap(({ sources, machine: { commit, date } }) => sources ?? [{ commit, date } as Source]);

/** How the references were checked, which older reports did in another way. */
function checkOf(all: readonly ProductMeasurement[]): string {
  const checked = all.filter(({ reference }) => reference);
  const other = checked.filter(({ reference }) => reference?.checkedBy);
  const of = other.map(({ product, width, height }) => `${product} (${width} × ${height})`).join(', ');
  const estimator =
    'another unbiased estimator, which finds the same light by other densities: directions from a guide that is learned, light paths, one of four light samples, and independent random numbers';
  const sampler = 'the same estimator with another sampler';
  const by =
    other.length === 0 ? sampler : other.length === checked.length ? estimator : `${sampler}, for ${of} ${estimator}`;
  return `A third render checks the brightness of the image and of 256 blocks of it, with a quarter of the samples: by ${by}.`;
}

/** The page of the documentation. */
export function productPage(reports: readonly ProductReport[], figures: readonly Figure[]): string {
  const all = joinedMeasurements(reports);
  const titles = Object.assign({}, ...reports.map(({ settings }) => settings.titles)) as Record<string, string>;
  const shown = [...new Set(all.map(({ product }) => product))];
  const notes = remarks(all);
  const { noise, error } = meansOf(figures);
  const commits = [...new Set(sourcesOf(reports).map(({ commit = 'unknown' }) => commit))].join(', ');
  const gpus = [...new Set(reports.map(({ gpu }) => gpu?.name ?? 'unknown'))].join(', ');
  return `<!-- Written by npm run bench -- products --from FILE,FILE --pages FOLDER; do not edit. -->

# Products in real light

<ResultPlot of="products" />

Models of products in the light that they are shown in, rendered by Glanz and by [three-gpu-pathtracer](https://github.com/gkjohnson/three-gpu-pathtracer) (${reports[0]?.settings.peer ?? ''}), each in a process of its own, one after the other on the same GPU, from the same .glb file with the same camera, size and depth. Biased options of both are off.

- **Set-up.** From the file in memory to the first sample, in a fresh process, with pipelines that the driver has not compiled before.
- **relMSE × samples.** The error of one sample: mean over pixels of the squared error over the reference's squared brightness (plus 1 % of the image's mean), times the number of samples.
- **Noise × time.** The noise of three-gpu-pathtracer times its wall time, over that of Glanz: how many times as long it takes to the same noise. Only the noise counts, measured between independent runs, since a bias does not fall with time.
- **Error after 1 s.** relMSE of an image after one second of wall time without set-up (at the median time of a sample, at least one sample), that of three-gpu-pathtracer over that of Glanz. It is the sum of the noise, which falls as 1 / samples, and of the rest of the measured relMSE (at least 0), which stays. The references are Glanz's, so the rest of the peer's error is mostly that it shows another image: it is no noise, and more time does not lower it.
- **Brightness.** That of the peer's image over the reference's. Far from 1, it shows another image, and its error is no noise.
- **References.** Long renders of Glanz in two halves with random numbers of their own, whose difference gives the stated error of the reference. ${checkOf(all)}
- **–** Not measured: three-gpu-pathtracer has no subsurface scattering, or the time of the measurement was over.

Over all products and sizes, as geometric means, three-gpu-pathtracer takes **${noise}×** as long to the same noise, and its error after a second is **${error}×** as large. Measured on ${gpus} (commits ${commits}); another GPU of the host was at work meanwhile.

${productTable(all)}

${shown.map((name) => `- \`${name}\`: ${titles[name] ?? name}`).join('\n')}

${notes.length > 0 ? `## Remarks\n\n${notes.map((note) => `- ${note}`).join('\n')}\n` : ''}`;
}

/** Writes the page and its data. Gives the files. */
export function writeProductPage(
  reports: readonly ProductReport[],
  figures: readonly Figure[],
  folder: string,
): string[] {
  const [page, data] = [join(folder, 'products.md'), join(folder, 'products.json')];
  writeFileSync(page, productPage(reports, figures));
  const [{ machine, gpu } = {}] = reports;
  const titles = Object.assign({}, ...reports.map(({ settings }) => settings.titles)) as Record<string, string>;
  const settings = { ...reports[0]?.settings, titles };
  // With the measurements, so that later reports can be joined with them.
  const details = joinedMeasurements(reports);
  const sources = sourcesOf(reports);
  const report = { benchmark: 'products', machine, gpu, settings, sources, figures, notes: [], details };
  writeFileSync(data, `${JSON.stringify(report, null, 1)}\n`);
  return [page, data];
}
