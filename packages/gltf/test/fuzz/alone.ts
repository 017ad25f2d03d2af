// The fuzzer as one file, see pack.mjs: this thread counts, others run the same file as workers.
import { createHash } from 'node:crypto';
import { writeFileSync } from 'node:fs';
import { availableParallelism, cpus } from 'node:os';
import { parseArgs } from 'node:util';
import { isMainThread, Worker } from 'node:worker_threads';
import type { Parts } from './mutate';
import { fuzzOn } from './pool';
import './worker';

/** Documents to spoil, as JSON: what they say, and their bytes in base64. */
declare const FUZZ_DOCUMENTS: string;

async function main(): Promise<void> {
  const { values } = parseArgs({
    options: {
      count: { type: 'string', default: '1000000' },
      seed: { type: 'string', default: '20261121' },
      first: { type: 'string', default: '0' },
      threads: { type: 'string', default: String(availableParallelism()) },
      json: { type: 'string' },
    },
  });
  const [count, seed, first, threads] = [values.count, values.seed, values.first, values.threads].map(Number) as [
    number,
    number,
    number,
    number,
  ];
  if (![count, seed, first, threads].every(Number.isInteger) || count < 1 || threads < 1 || first < 0)
    throw new Error('--count, --seed, --first and --threads are whole numbers.');
  const parts = (JSON.parse(FUZZ_DOCUMENTS) as { json: unknown; binary?: string }[]).map(({ json, binary }): Parts =>
    binary === undefined ? { json } : { json, binary: new Uint8Array(Buffer.from(binary, 'base64')) },
  );
  const begun = performance.now();
  const printProgress = (done: number) =>
    process.stderr.write(`${done} of ${count}, ${(done / ((performance.now() - begun) / 1000)).toFixed(0)} a second\n`);
  const { findings, ends, done } = await fuzzOn(
    (workerData) =>
      new Worker(new URL(import.meta.url), { workerData, resourceLimits: { maxOldGenerationSizeMb: 1024 } }),
    { parts, seed, count, first, threads, onProgress: (now) => now % 50_000 === 0 && printProgress(now) },
  );
  const seconds = (performance.now() - begun) / 1000;
  const report = {
    count,
    done,
    seed,
    first,
    threads,
    documents: parts.length,
    documentsSha256: createHash('sha256').update(FUZZ_DOCUMENTS).digest('hex'),
    commit: process.env['GLANZ_COMMIT'] ?? 'unknown',
    node: process.version,
    cpu: cpus()[0]?.model,
    seconds: Math.round(10 * seconds) / 10,
    ends: Object.fromEntries(Object.entries(ends).sort((a, b) => b[1] - a[1])),
    badEnds: findings.length,
    findings: findings.map((finding) => ({ ...finding, again: `--seed ${seed} --first ${finding.mutant} --count 1` })),
  };
  if (values.json !== undefined) writeFileSync(values.json, `${JSON.stringify(report, null, 1)}\n`);
  process.stdout.write(
    `${done} spoiled documents in ${seconds.toFixed(1)} s on ${threads} threads (seed ${seed}): ${ends['scene'] ?? 0} scenes, ${done - (ends['scene'] ?? 0) - findings.length} errors of ${Object.keys(ends).length - 1} codes, ${findings.length} bad ends\n${findings.map(({ mutant, what }) => `mutant ${mutant}: ${what}\n`).join('')}`,
  );
  process.exitCode = findings.length > 0 || done < count ? 1 : 0;
}

if (isMainThread) await main();
