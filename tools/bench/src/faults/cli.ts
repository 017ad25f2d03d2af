import { spawn } from 'node:child_process';
import { createHash } from 'node:crypto';
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { quads } from '@glanz/browser/files';
import { faultsOf, type Fault, type FaultPoint } from '@glanz/gpu/faults';
import type { Journal } from './journal';
import type { Ending, Outcome } from './outcome';
import { repository } from './repository';

/** What {@link cliCampaign} takes; see {@link tracerCampaign}. */
export interface CliCampaign {
  readonly faults?: readonly Fault[];
  readonly only?: string;
  readonly every?: number;
  readonly boundMs?: number;
  readonly journal: Journal;
  readonly onOutcome?: (outcome: Outcome, done: number, of: number) => void;
}

interface Recorded {
  readonly struck?: FaultPoint;
  readonly points: readonly FaultPoint[];
}

interface Run {
  readonly code: number | null;
  readonly err: string;
  readonly hung: boolean;
  /** Digests of the files that it has written, by name. */
  readonly files: Readonly<Record<string, string>>;
  readonly recorded: Recorded | undefined;
}

const JOBS: Readonly<Record<'single' | 'batch', readonly string[]>> = {
  single: [
    'render',
    'model.glb',
    '--gpu',
    'software',
    '--size',
    '24x16',
    '--samples',
    '6',
    '--max-depth',
    '3',
    '-o',
    'x.exr',
    '-o',
    'x.png',
  ],
  batch: [
    'render',
    '--batch',
    'jobs.json',
    '--gpu',
    'software',
    '--size',
    '24x16',
    '--samples',
    '4',
    '--max-depth',
    '3',
  ],
};

/** Bundles the program and the GPU with faults, so that nothing must have been built. */
async function bundlePrograms(): Promise<{ readonly program: string; readonly dawn: string }> {
  const { build } = await import('esbuild');
  const { weslSource } = await import('../../../pipeline/wesl.mjs');
  const root = repository();
  const external = ['webgpu', 'sharp', '@sparticuz/chromium', 'draco3dgltf', 'meshoptimizer', 'meshoptimizer/*'];
  const common = {
    bundle: true,
    platform: 'node' as const,
    format: 'esm' as const,
    target: 'node20',
    conditions: ['@glanz/source'],
    external,
    plugins: [weslSource()],
    logLevel: 'error' as const,
  };
  const banner = {
    js: "import { createRequire as glanzRequire } from 'node:module'; const require = glanzRequire(import.meta.url);",
  };
  const [program, dawn] = [
    join(root, 'packages/cli/.cache/faults-glanz.mjs'),
    join(root, 'tools/bench/.cache/faults-dawn.mjs'),
  ];
  await build({ ...common, banner, entryPoints: [join(root, 'packages/cli/src/glanz.ts')], outfile: program });
  await build({ ...common, entryPoints: [join(root, 'tools/bench/src/faults/dawn.ts')], outfile: dawn });
  return { program, dawn };
}

/**
 * Injects faults into every distinct call to the GPU that `glanz render` makes, for one image and for a batch; each
 * trial is a process. Right files and exit status 0, or a typed error and no wrong file.
 */
export async function cliCampaign({
  faults,
  only = '',
  every = 1,
  boundMs = 120_000,
  journal,
  onOutcome,
}: CliCampaign): Promise<void> {
  const { program, dawn } = await bundlePrograms();
  const folder = mkdtempSync(join(tmpdir(), 'glanz-faults-'));
  const model = quads([
    { name: 'left', colour: [0.9, 0.02, 0.02], at: [-1.2, 0, 0] },
    { name: 'right', colour: [0.02, 0.8, 0.02], at: [1.2, 0, 0] },
  ]);
  const second = quads([{ name: 'one', colour: [0.1, 0.2, 0.9] }]);
  let number = 0;
  const start = async (
    job: keyof typeof JOBS,
    plan?: { readonly point: string; readonly fault: Fault },
  ): Promise<Run> => {
    const cwd = join(folder, `${job}-${number++}`);
    mkdirSync(cwd);
    const inputs: Record<string, string | Uint8Array> = {
      'model.glb': model,
      'second.glb': second,
      'jobs.json': JSON.stringify([
        { model: 'model.glb', output: 'a.png' },
        { model: 'second.glb', output: 'b.png' },
        { model: 'model.glb', output: 'c.exr' },
      ]),
    };
    for (const [name, data] of Object.entries(inputs)) writeFileSync(join(cwd, name), data);
    const record = join(folder, `${job}-${number}.json`);
    const child = spawn(process.execPath, [program, ...JOBS[job]], {
      cwd,
      stdio: ['ignore', 'ignore', 'pipe'],
      env: {
        ...process.env,
        GPU_WEBGPU: dawn,
        GLANZ_FAULT_RECORD: record,
        ...(plan ? { GLANZ_FAULT_PLAN: JSON.stringify(plan) } : {}),
      },
    });
    let err = '';
    child.stderr.on('data', (text: Buffer) => (err += text.toString()));
    let hung = false;
    const timer = setTimeout(() => {
      hung = true;
      child.kill('SIGKILL');
    }, boundMs);
    const code = await new Promise<number | null>((resolve) => child.on('close', resolve));
    clearTimeout(timer);
    const made = readdirSync(cwd).filter((name) => /\.(png|exr)$/.test(name));
    const files = Object.fromEntries(
      made.map((name) => [
        name,
        createHash('sha256')
          .update(readFileSync(join(cwd, name)))
          .digest('base64url')
          .slice(0, 16),
      ]),
    );
    let recorded: Recorded | undefined;
    try {
      recorded = JSON.parse(readFileSync(record, 'utf8')) as Recorded;
    } catch {
      // A process that was killed has written nothing.
    }
    rmSync(cwd, { recursive: true, force: true });
    return { code, err, hung, files, recorded };
  };
  try {
    const trials: { readonly job: keyof typeof JOBS; readonly point: FaultPoint; readonly fault: Fault }[] = [];
    const expected: Partial<Record<keyof typeof JOBS, Run>> = {};
    for (const job of ['single', 'batch'] as const) {
      const run = (expected[job] = await start(job));
      if (run.code !== 0 || !run.recorded)
        throw new Error(`glanz ${JOBS[job].join(' ')} fails without a fault: ${run.err}`);
      for (const point of run.recorded.points) {
        if (point.number > 3) continue;
        for (const fault of faultsOf(point))
          if ((!faults || faults.includes(fault)) && `${point.name} of ${job}`.includes(only))
            trials.push({ job, point, fault });
      }
    }
    const chosen = trials.filter((_, i) => i % every === 0);
    for (const [i, { job, point, fault }] of chosen.entries()) {
      const trial = { subject: 'cli', point: `${point.name} of ${job}`, fault } as const;
      if (journal.has(trial)) continue;
      journal.begin(trial);
      const run = await start(job, { point: point.name, fault });
      // A process that a signal has ended says nothing of what it reached.
      if (!run.hung && run.code !== null && run.recorded?.struck === undefined) {
        journal.miss(trial);
        continue;
      }
      const outcome: Outcome = { ...trial, ...judge(run, expected[job] as Run) };
      journal.end(outcome);
      onOutcome?.(outcome, i + 1, chosen.length);
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

function judge(run: Run, expected: Run): { readonly ending: Ending; readonly detail?: string } {
  const last =
    run.err
      .trim()
      .split('\n')
      .findLast((line) => !line.startsWith('Warning: max'))
      ?.slice(0, 200) ?? '';
  if (run.hung) return { ending: 'hang', detail: last };
  if (run.code === null) return { ending: 'crash', detail: last };
  const wrong = Object.entries(run.files)
    .filter(([name, digest]) => expected.files[name] !== digest)
    .map(([name]) => name);
  if (wrong.length > 0)
    return { ending: 'silent', detail: `${wrong.join(', ')} with other pixels, exit status ${run.code}` };
  if (/UnhandledPromiseRejection|unhandledRejection/.test(run.err)) return { ending: 'unhandled', detail: last };
  if (run.code === 0) {
    const missing = Object.keys(expected.files).filter((name) => run.files[name] === undefined);
    return missing.length === 0
      ? { ending: 'image' }
      : { ending: 'silent', detail: `exit status 0 without ${missing.join(', ')}` };
  }
  const code = /\[([a-z]+\/[\w-]+)\]/.exec(run.err)?.[1];
  return code === undefined || run.code === 70
    ? { ending: 'untyped', detail: `exit status ${run.code}: ${last}` }
    : { ending: 'error', detail: code };
}
