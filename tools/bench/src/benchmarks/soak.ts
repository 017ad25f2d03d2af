import { mkdirSync, writeFileSync } from 'node:fs';
import { dirname, resolve } from 'node:path';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import type { Benchmark, Figure } from '../benchmark';
import { BenchError } from '../error';
import { compileEarly, slope, soak, soakPlot, type SoakPoint } from '../faults/soak';

const QUANTITIES: readonly {
  readonly name: string;
  readonly unit: string;
  readonly value: (point: SoakPoint) => number;
}[] = [
  { name: 'heap', unit: 'KiB/min', value: ({ heapBytes }) => heapBytes / 1024 },
  { name: 'memory outside the heap', unit: 'KiB/min', value: ({ externalBytes }) => externalBytes / 1024 },
  { name: 'RSS', unit: 'KiB/min', value: ({ rssBytes }) => rssBytes / 1024 },
  { name: 'live GPU objects', unit: '1/min', value: ({ gpuObjects }) => gpuObjects },
  { name: 'live GPU memory', unit: 'KiB/min', value: ({ gpuBytes }) => gpuBytes / 1024 },
];

/** A long random run, see `faults/soak`. */
export const benchmark: Benchmark = {
  description:
    'a long random run of loads, edits, orbits, resizes and losses: memory and GPU objects over time, and their slope',
  options: {
    minutes: { type: 'string', help: 'how long; default 30' },
    losses: { type: 'string', help: 'probability that an edit meets a lost device; default 0.02, 0 for none' },
    jit: {
      type: 'string',
      help: '"no": V8 compiles nothing late, whose code grows the heap like a leak; default "yes"',
    },
    svg: { type: 'string', help: 'file for the plot' },
  },
  async run({ log, quick, gpu: name, seed = 1, values }) {
    const minutes = values['minutes'] === undefined ? (quick ? 0.5 : 30) : Number(values['minutes']);
    if (!(minutes > 0))
      throw new BenchError('bench/option', `--minutes ${values['minutes']}: it must be a number above 0.`);
    const lossRate = Number(values['losses'] ?? 0.02);
    if (!(lossRate >= 0 && lossRate <= 1))
      throw new BenchError('bench/option', `--losses ${values['losses']}: it must be a number from 0 to 1.`);
    const jit = values['jit'] ?? 'yes';
    if (jit !== 'yes' && jit !== 'no') throw new BenchError('bench/option', `--jit ${jit}: it must be "yes" or "no".`);
    if (jit === 'no') compileEarly();
    const { gpu, adapterName, software } = await createGpu(name === undefined ? { software: 'only' } : { gpu: name });
    // Caches fill at first: five minutes, or a sixth of a short run.
    const settled = Math.min(300, 10 * minutes);
    let said = 0;
    const result = await soak({
      open: () => requestDevice({ gpu }),
      seconds: 60 * minutes,
      seed,
      lossRate,
      onPoint: ({ seconds, heapBytes, externalBytes, rssBytes, gpuObjects, losses }) => {
        if (seconds < said) return;
        said = seconds + Math.min(60, 6 * minutes);
        log(
          `${(seconds / 60).toFixed(1)} min: heap ${(heapBytes / 2 ** 20).toFixed(1)} MiB, outside ${(externalBytes / 2 ** 20).toFixed(1)} MiB, RSS ${(rssBytes / 2 ** 20).toFixed(0)} MiB, ${gpuObjects} GPU objects, ${losses} losses`,
        );
      },
    });
    const later = result.points.filter(({ seconds }) => seconds >= settled);
    const slopes =
      later.length < 3
        ? []
        : QUANTITIES.map(({ name: what, unit, value }): Figure => {
            const { slope: mean, ci95 } = slope(later.map((point) => [point.seconds / 60, value(point)]));
            return {
              name: `${what}: slope after ${(settled / 60).toFixed(1)} min`,
              unit,
              runs: later.length,
              mean,
              ci95,
            };
          });
    const plot = soakPlot(result.points, settled);
    if (values['svg'] !== undefined) {
      const file = resolve(values['svg']);
      mkdirSync(dirname(file), { recursive: true });
      writeFileSync(file, plot);
    }
    const { loads, edits, losses, peak, errors, points } = result;
    if (errors.length > 0) process.exitCode = 1;
    const one = (what: string, unit: string, value: number): Figure => ({ name: what, unit, runs: 1, median: value });
    return {
      settings: { minutes, seed, losses: lossRate, jit, settledSeconds: settled },
      figures: [
        one('loads', '1', loads),
        one('edits', '1', edits),
        one('losses of the device', '1', losses),
        one('most GPU memory at once', 'KiB', peak.gpuBytes / 1024),
        one('most GPU objects at once', '1', peak.gpuObjects),
        ...slopes,
      ],
      gpu: { name: adapterName, software },
      notes: errors,
      details: { points, plot },
    };
  },
};
