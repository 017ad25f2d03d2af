import { writeFileSync } from 'node:fs';
import { encodePng } from '@glanz/image';
import { toneMapPixels } from '@glanz/tonemap';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { childJob, inChild, type ChildJobs } from '../child';
import { BenchError } from '../error';
import { numberOption } from '../options';
import { differingPixels } from '../scale/compare';
import { renderAtScale, type ScalePlan, type ScaleResult } from '../scale/measure';

const JOBS: ChildJobs<ScalePlan> = { name: 'scale', file: import.meta.url, run: renderAtScale };

const mebibytes = (bytes: number) => bytes / 2 ** 20;

/** One mesh within WebGPU's default limits: the same film as on a device with all that the adapter offers. */
export const benchmark: Benchmark = {
  description:
    "one mesh of 10 million triangles within WebGPU's default limits: its film, bit for bit that of a device with the adapter's limits",
  options: {
    triangles: { type: 'string', help: 'millions of triangles of the mesh; default 10, with --quick 0.1' },
    size: { type: 'string', help: 'pixels of a side of the film; default 64' },
    samples: { type: 'string', help: 'samples per pixel; default 4' },
    compact: { type: 'string', help: 'MiB above which shapes are compact; default: that of the renderer' },
    image: { type: 'string', help: 'PNG file that the film of the default limits is written to' },
  },
  async run({ log, quick, gpu, values }) {
    await childJob(JOBS);
    const millions = numberOption(values, 'triangles', quick ? 0.1 : 10, false);
    const size = numberOption(values, 'size', 64);
    const samples = numberOption(values, 'samples', 4);
    const compactAboveMiB =
      values['compact'] === undefined ? {} : { compactAboveMiB: numberOption(values, 'compact', 1) };
    const plan = {
      triangles: millions * 1e6,
      size,
      samples,
      ...compactAboveMiB,
      ...(gpu === undefined ? {} : { gpu }),
    };
    const figures: Figure[] = [];
    const one = (name: string, unit: string, value: number, target?: Figure['target']) =>
      figures.push(timed(name, unit, [value], target));
    // In processes of their own, one after the other: the memory of the first is free when the second starts.
    const render = async (defaultLimits: boolean): Promise<ScaleResult> => {
      const result = await inChild<ScaleResult, ScalePlan>(JOBS, { ...plan, defaultLimits });
      const name = defaultLimits ? 'default limits' : "the adapter's limits";
      if (typeof result === 'string') throw new BenchError('bench/failed', `${name}: ${result}`);
      one(`${name}: bytes that a shader binds of a buffer`, 'MiB', mebibytes(result.bindingBytes));
      for (const { name: array, bytes, pages } of result.arrays) {
        one(`${name}: ${array}`, 'MiB', mebibytes(bytes));
        one(`${name}: pages of ${array} (0: a buffer)`, '1', pages);
      }
      one(`${name}: bytes a triangle`, 'B', result.bytesPerTriangle, { value: 64, relation: '<=', source: 'issue 21' });
      one(`${name}: GPU memory`, 'MiB', mebibytes(result.gpuBytes));
      one(`${name}: peak memory of the process`, 'MiB', mebibytes(result.peakBytes));
      one(`${name}: create()`, 'ms', result.createMs);
      one(`${name}: ${samples} samples`, 'ms', result.renderMs);
      log(`${name}: done, peak memory ${mebibytes(result.peakBytes).toFixed(0)} MiB`);
      return result;
    };
    const limited = await render(true);
    const unlimited = await render(false);
    const films = [limited, unlimited].map(({ film }) => Buffer.from(film, 'base64')) as [Buffer, Buffer];
    const differing = differingPixels(...films);
    one('triangles', '1', limited.triangles);
    one('pixels whose bits differ', '1', differing, { value: 0, relation: '<=', source: 'the same image' });
    one('samples that were not finite', '1', limited.badSamples + unlimited.badSamples);
    const notes: string[] = [];
    const paged = limited.arrays.filter(({ pages }) => pages > 0).length;
    if (paged === 0) notes.push('all arrays fit into buffers: nothing was in pages; take more triangles');
    if (differing > 0) {
      notes.push(`${differing} of ${size * size} pixels differ`);
      process.exitCode = 1;
    }
    if (values['image'] !== undefined) {
      const pixels = new Float32Array(new Uint8Array(films[0]).buffer);
      const data = new Uint8Array(toneMapPixels(pixels, size, size, { alpha: 'opaque' }).buffer);
      writeFileSync(values['image'], encodePng({ width: size, height: size, data }));
    }
    return {
      settings: {
        triangles: millions * 1e6,
        width: size,
        height: size,
        samples,
        maxDepth: 4,
        bvhBuilder: 'cpu',
        ...compactAboveMiB,
      },
      gpu: limited.adapter,
      figures,
      notes,
    };
  },
};
