import { appendFileSync, existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { FAULTS, type Fault } from '@glanz/gpu/faults';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import type { Benchmark, BenchmarkResult, Figure } from '../benchmark';
import { BenchError } from '../error';
import { cliCampaign } from '../faults/cli';
import { untilDone } from '../faults/isolate';
import { Journal } from '../faults/journal';
import { survived, type Outcome, type Subject } from '../faults/outcome';
import { tracerCampaign } from '../faults/tracer';
import { viewerCampaign } from '../faults/viewer';

/** Set for a process that makes trials on tracers: its part of them, from 0, and the number of parts, `0/4`. */
const CHILD = 'GLANZ_FAULTS_CHILD';

const SUBJECTS: readonly Subject[] = ['tracer', 'viewer', 'cli'];

/** Points tried and survived, by subject and fault. */
export function summary(
  outcomes: readonly Outcome[],
): { readonly subject: Subject; readonly fault: string; readonly tried: number; readonly survived: number }[] {
  const rows = new Map<string, { subject: Subject; fault: string; tried: number; survived: number }>();
  for (const outcome of outcomes) {
    const key = `${outcome.subject} ${outcome.fault}`;
    const row = rows.get(key) ?? { subject: outcome.subject, fault: outcome.fault, tried: 0, survived: 0 };
    row.tried++;
    if (survived(outcome)) row.survived++;
    rows.set(key, row);
  }
  return [...rows.values()];
}

const list = <T extends string>(text: string | undefined, all: readonly T[], option: string): readonly T[] => {
  if (text === undefined) return all;
  const names = text.split(',');
  for (const name of names)
    if (!all.includes(name as T))
      throw new BenchError('bench/option', `--${option} ${name}: it must be of ${all.join(', ')}.`);
  return names as T[];
};

/** Faults injected into every distinct call to the GPU, see `faults/`. */
export const benchmark: Benchmark = {
  description:
    'faults injected into every distinct GPU call of the tracer, the viewer and the command line: how many are survived',
  options: {
    subject: { type: 'string', help: `of ${SUBJECTS.join(', ')}; default all` },
    fault: { type: 'string', help: `of ${FAULTS.join(', ')}; default all` },
    only: { type: 'string', help: 'part of the names of points, e.g. "in resize"' },
    every: { type: 'string', help: 'takes each k-th trial' },
    journal: { type: 'string', help: 'file that notes each trial, for a run that resumes another' },
    processes: { type: 'string', help: 'processes that share the trials of the tracer; default 1' },
  },
  async run({ log, quick, gpu: name, values }) {
    const subjects = list(values['subject'], SUBJECTS, 'subject');
    const faults = list(values['fault'], FAULTS, 'fault') as readonly Fault[];
    const every = values['every'] === undefined ? (quick ? 40 : 1) : Number(values['every']);
    if (!Number.isInteger(every) || every < 1)
      throw new BenchError('bench/option', `--every ${values['every']}: it must be a whole number of at least 1.`);
    const processes = Number(values['processes'] ?? 1);
    if (!Number.isInteger(processes) || processes < 1)
      throw new BenchError(
        'bench/option',
        `--processes ${values['processes']}: it must be a whole number of at least 1.`,
      );
    const onOutcome = (outcome: Outcome, done: number, of: number) => {
      if (!survived(outcome) || done % 50 === 0)
        log(
          `${done}/${of} ${survived(outcome) ? 'survived' : 'FAILED'} ${outcome.ending}: ${outcome.fault} at ${outcome.point}${outcome.detail === undefined ? '' : `: ${outcome.detail}`}`,
        );
    };
    const { gpu, adapterName, software } = await createGpu(name === undefined ? { software: 'only' } : { gpu: name });
    // Which part of the trials this process makes, and the number of parts.
    const [part, parts] = process.env[CHILD]?.split('/').map(Number) ?? [];
    const isChild = part !== undefined && parts !== undefined;
    const folder = values['journal'] === undefined ? mkdtempSync(join(tmpdir(), 'glanz-faults-')) : undefined;
    const file = resolve(folder ?? '', values['journal'] ?? 'journal.jsonl');
    try {
      const only = values['only'] ?? '';
      const campaign = { faults, every, only, onOutcome };
      if (subjects.includes('tracer') && isChild)
        await tracerCampaign({
          ...campaign,
          shard: [part, parts],
          journal: new Journal(file),
          open: () => requestDevice({ gpu }),
        });
      else if (subjects.includes('tracer')) {
        const options = {
          subject: 'tracer',
          fault: values['fault'],
          only: values['only'],
          every: String(every),
          gpu: name,
        };
        const args = Object.entries(options).flatMap(([option, value]) =>
          value === undefined ? [] : [`--${option}`, value],
        );
        const command = [process.execPath, fileURLToPath(import.meta.url), ...args] as const;
        const notes = Array.from({ length: processes }, (_, i) => (processes === 1 ? file : `${file}.${i}`));
        await Promise.all(
          notes.map((own, i) =>
            untilDone([...command, '--journal', own], own, { ...process.env, [CHILD]: `${i}/${processes}` }),
          ),
        );
        if (processes > 1) for (const own of notes) appendFileSync(file, existsSync(own) ? readFileSync(own) : '');
      }
      const journal = new Journal(file);
      if (subjects.includes('viewer'))
        await viewerCampaign(
          values['fault'] === undefined ? { every, only, journal, onOutcome } : { ...campaign, journal },
        );
      if (subjects.includes('cli')) await cliCampaign({ ...campaign, journal });
      if (isChild) return { settings: {}, figures: [] };
      return report(journal, { subjects, faults, every, only }, { name: adapterName, software });
    } finally {
      if (folder !== undefined) rmSync(folder, { recursive: true, force: true });
    }
  },
};

function report(
  { outcomes, missed }: Journal,
  settings: BenchmarkResult['settings'],
  gpu: { readonly name: string; readonly software: boolean },
): BenchmarkResult {
  const rows = summary(outcomes);
  const figures = rows.map(({ subject, fault, tried, survived: good }): Figure => ({
    name: `${subject}, ${fault}: survived`,
    unit: '1',
    runs: 1,
    median: good,
    target: { value: tried, relation: '>=', source: 'all points tried' },
  }));
  const notes = outcomes
    .filter((outcome) => !survived(outcome))
    .map(
      ({ subject, fault, point, ending, detail }) =>
        `${subject}: ${fault} at ${point}: ${ending}${detail === undefined ? '' : ` (${detail})`}`,
    );
  if (notes.length > 0) process.exitCode = 1;
  const notReached = missed.map(({ subject, point, fault }) => `${subject}: ${point} (${fault})`);
  return { settings, figures, gpu, notes, details: { summary: rows, outcomes, notReached } };
}
