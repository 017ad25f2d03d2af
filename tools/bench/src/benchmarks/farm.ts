import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { nodeIo, runCli } from '@glanz/cli';
import { openFarmQueue } from '@glanz/farm';
import { findRedis, startRedis } from '@glanz/redis';
import { timed, type Benchmark } from '../benchmark';
import { BenchError } from '../error';

/** Steps of a turntable that a row of a batch may have. */
const STEPS = 3600;
const SAMPLE_MS = 200;
/** Samples between two collections of garbage: V8 lets a heap grow before it collects, which is no use of memory. */
const COLLECT_EVERY = 5;
const MB = 1e6;

/** Submitting a large batch, and reading the status of its queue. */
export const benchmark: Benchmark = {
  description: 'submitting 100,000 jobs to a queue on Redis: time, memory of the process, reading the status',
  options: { jobs: { type: 'string', help: 'how many, default 100000' } },
  async run({ log, quick, values }) {
    const jobs = Number(values['jobs'] ?? (quick ? 2000 : 100_000));
    const { program, missing } = await findRedis();
    if (!program) throw new BenchError('bench/missing', `No Redis: ${missing}.`);
    setFlagsFromString('--expose-gc');
    const collect = runInNewContext('gc') as () => void;
    const folder = mkdtempSync(join(tmpdir(), 'glanz-bench-farm-'));
    const redis = await startRedis(program, join(folder, 'redis'));
    try {
      writeFileSync(join(folder, 'a.obj'), 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n');
      const images = Array.from({ length: Math.ceil(jobs / STEPS) }, (_, row) => ({
        turntable: Math.min(STEPS, jobs - row * STEPS),
        elevation: row,
        output: `out/${row}-{view}.png`,
      }));
      writeFileSync(join(folder, 'b.json'), JSON.stringify({ defaults: { model: 'a.obj', size: '16x16' }, images }));
      const submit = async () => {
        const rss: number[] = [];
        const used: number[] = [];
        const timer = setInterval(() => {
          if (rss.push(process.memoryUsage().rss / MB) % COLLECT_EVERY > 0) return;
          collect();
          used.push(process.memoryUsage().heapUsed / MB);
        }, SAMPLE_MS);
        const start = performance.now();
        let out = '';
        const io = { ...nodeIo(), cwd: folder, stdout: (text: string) => void (out += text), stderr: () => undefined };
        const code = await runCli(['farm', 'submit', 'b.json', '--redis', redis.url, '--json'], io);
        clearInterval(timer);
        const { queued } = JSON.parse(out) as { queued?: number };
        if (code !== 0 || queued !== jobs) throw new BenchError('bench/farm', `The batch was not submitted: ${out}`);
        return { seconds: (performance.now() - start) / 1000, rss, used };
      };
      const first = await submit();
      log(`${jobs} jobs in ${first.seconds.toFixed(1)} s`);
      const queue = await openFarmQueue({ redis: redis.url });
      const statusMs: number[] = [];
      for (let i = 0; i < 20; i++) {
        const start = performance.now();
        const { waiting } = await queue.status();
        statusMs.push(performance.now() - start);
        if (waiting !== jobs) throw new BenchError('bench/farm', `The queue has ${waiting} jobs instead of ${jobs}.`);
      }
      await queue.close();
      const again = await submit();
      const mean = (list: readonly number[]) => list.reduce((sum, one) => sum + one, 0) / Math.max(1, list.length);
      /** How much more there is in the last quarter than in the second one. */
      const growth = (list: readonly number[]) => {
        const quarter = Math.floor(list.length / 4);
        return mean(list.slice(-quarter)) - mean(list.slice(quarter, 2 * quarter));
      };
      return {
        settings: { jobs, rows: images.length },
        figures: [
          { name: 'submit', unit: 's', runs: 1, median: first.seconds },
          { name: 'submit again', unit: 's', runs: 1, median: again.seconds },
          timed('status', 'ms', statusMs),
          { name: 'memory in use: maximum', unit: 'MB', runs: 1, median: Math.max(...first.used, ...again.used) },
          {
            name: 'memory in use: last quarter of the first submission − second quarter',
            unit: 'MB',
            runs: 1,
            median: growth(first.used),
          },
          {
            name: 'memory of the process: last quarter of the first submission − second quarter',
            unit: 'MB',
            runs: 1,
            median: growth(first.rss),
          },
          { name: 'memory of the process: maximum', unit: 'MB', runs: 1, median: Math.max(...first.rss, ...again.rss) },
        ],
        details: { rss: first.rss, used: first.used },
      };
    } finally {
      await redis.stop();
      rmSync(folder, { recursive: true, force: true });
    }
  },
};
