import { setTimeout as sleep } from 'node:timers/promises';
import { faultsOf, FaultRecorder, instrumentDevice, type Fault, type FaultPoint } from '@glanz/gpu/faults';
import type { PathTracer } from '@glanz/renderer';
import type { Journal } from './journal';
import { attempt, codeOf, describe, type Ending, type Outcome, type Trial } from './outcome';
import { createTracer, digest, look, STEPS, type Step } from './tracer-steps';

/** What {@link tracerCampaign} takes. */
export interface TracerCampaign {
  /** A new device. */
  readonly open: () => Promise<GPUDevice>;
  /** Faults to inject; default all. */
  readonly faults?: readonly Fault[];
  /** Part of a point's name that it must contain. */
  readonly only?: string;
  /** Names of the steps whose calls are points, see `STEPS`; default all. */
  readonly steps?: readonly string[];
  /** Takes each k-th trial; default 1. */
  readonly every?: number;
  /** The part of these trials to make, from 0, and the number of parts; default all. */
  readonly shard?: readonly [part: number, of: number];
  /** Bound on each call in milliseconds; default 60,000. */
  readonly boundMs?: number;
  /** Where trials are noted; those that it has already are not made again. */
  readonly journal: Journal;
  /** Called after each trial. */
  readonly onOutcome?: (outcome: Outcome, done: number, of: number) => void;
}

/** What a step gives without a fault. */
interface Expected {
  /** The image before the call under test, and after it. */
  readonly before: string | undefined;
  readonly value: string | undefined;
  readonly after: string | undefined;
}

const isLoss = (fault: Fault) => fault === 'lost-unknown' || fault === 'lost-destroyed';

/** A step with what it expects; its calls to the GPU are the points. */
interface Prepared {
  readonly step: Step;
  readonly expected: Expected;
  readonly points: readonly FaultPoint[];
}

/**
 * Injects faults into every distinct call to the GPU that a `PathTracer` makes: while it is created, rendered, read,
 * edited, saved and restored, and destroyed. Each trial has a tracer of its own.
 */
export async function tracerCampaign({
  open,
  faults,
  only = '',
  steps,
  every = 1,
  shard: [part, parts] = [0, 1],
  boundMs = 60_000,
  journal,
  onOutcome,
}: TracerCampaign): Promise<void> {
  const recorder = new FaultRecorder();
  const device = async () => instrumentDevice(await open(), recorder);
  const rejections: unknown[] = [];
  const listen = (reason: unknown) => void rejections.push(reason);
  process.on('unhandledRejection', listen);
  try {
    const compiles = !faults || faults.some((fault) => isLoss(fault) || fault === 'compile');
    let warm = await device();
    const prepared: Prepared[] = [];
    for (const step of STEPS) {
      if (steps && !steps.includes(step.name)) continue;
      // Faults that leave the device alive share one, whose kernels are there: only the others see them compile.
      if (!compiles) {
        await prepare(step, recorder, warm);
        prepared.push(await prepare(step, recorder, warm));
        continue;
      }
      const cold = await device();
      prepared.push(await prepare(step, recorder, cold));
      await cold.queue.onSubmittedWorkDone();
      await sleep(300);
      cold.destroy();
      await prepare(step, recorder, warm);
    }
    const seen = new Set<string>();
    const trials: (Trial & { readonly of: Prepared })[] = [];
    for (const of of prepared) {
      for (const point of of.points) {
        // Rendering after an edit makes the calls that rendering makes: they are tried where they differ.
        const key = `${point.call} ${point.label}`;
        if (point.phase.startsWith('render after') && seen.has(key) && of.step.name !== 'create') continue;
        if (point.phase.startsWith('render after')) seen.add(key);
        if (point.number > 4) continue;
        for (const fault of faultsOf(point))
          if ((!faults || faults.includes(fault)) && point.name.includes(only)) trials.push({ of, point, fault });
      }
    }
    const chosen = trials.filter((_, i) => i % every === 0).filter((_, i) => i % parts === part);
    for (const [i, { of, point, fault }] of chosen.entries()) {
      const name = { subject: 'tracer', point: point.name, fault } as const;
      if (journal.has(name)) continue;
      journal.begin(name);
      rejections.length = 0;
      const alone =
        isLoss(fault) || fault === 'compile' || /Pipeline|ShaderModule|Layout|popErrorScope/.test(point.call);
      const used = alone ? await device() : warm;
      const run = await trial({ of, point, fault, used, healthy: () => Promise.resolve(warm), recorder, boundMs });
      // Rejections are reported in a later turn.
      await sleep(5);
      const ending: Ending =
        run.ending === 'image' || run.ending === 'error'
          ? rejections.length > 0
            ? 'unhandled'
            : run.ending
          : run.ending;
      const detail = ending === 'unhandled' ? describe(rejections[0]) : run.detail;
      if (alone) used.destroy();
      else if (ending === 'hang' || ending === 'unusable') warm = await device();
      if (recorder.struck === undefined && run.reached === false) {
        journal.miss(name);
        continue;
      }
      const outcome: Outcome = { ...name, ending, ...(detail === undefined ? {} : { detail }) };
      journal.end(outcome);
      onOutcome?.(outcome, i + 1, chosen.length);
    }
    warm.destroy();
  } finally {
    process.off('unhandledRejection', listen);
  }
}

/** Runs a step without a fault and notes its calls. */
async function prepare(step: Step, recorder: FaultRecorder, device: GPUDevice): Promise<Prepared> {
  recorder.clear();
  recorder.phase = step.name === 'create' ? 'create' : 'before';
  const tracer = await createTracer(device);
  recorder.phase = 'before';
  await step.before?.(tracer);
  // What the image was, for edits that are refused and rolled back; film states stay as they are.
  const before = keepsFilm(step) ? undefined : await look(tracer);
  if (!keepsFilm(step)) tracer.reset();
  recorder.phase = step.name;
  const value = digest(await step.act(tracer));
  recorder.phase = `render after ${step.name}`;
  const after = await look(tracer);
  recorder.phase = 'destroy';
  tracer.destroy();
  const own =
    step.name === 'create'
      ? () => true
      : (point: FaultPoint) => point.phase === step.name || point.phase.startsWith('render after');
  return {
    step,
    expected: { before, value, after },
    points: recorder.points.filter(own).filter(({ phase }) => phase !== 'before'),
  };
}

/** Steps whose call works on samples that are there. */
const keepsFilm = ({ name }: Step) => /^(read|setLightGroup|saveFilm|restoreFilm)/.test(name);

interface TrialInput {
  readonly of: Prepared;
  readonly point: FaultPoint;
  readonly fault: Fault;
  readonly used: GPUDevice;
  readonly healthy: () => Promise<GPUDevice>;
  readonly recorder: FaultRecorder;
  readonly boundMs: number;
}

interface Verdict {
  readonly ending: Ending;
  readonly detail?: string;
  /** False where the call did not come. */
  readonly reached?: boolean;
}

async function trial({
  of: { step, expected },
  point,
  fault,
  used,
  healthy,
  recorder,
  boundMs,
}: TrialInput): Promise<Verdict> {
  const alive = new Set(recorder.live.keys());
  recorder.clear({ point: point.name, fault });
  let tracer: PathTracer | undefined;
  let refusal: string | undefined;
  const done = (ending: Ending, detail?: string): Verdict => ({
    ending,
    ...(detail === undefined ? {} : { detail }),
    reached: recorder.struck !== undefined,
  });
  // A call that may meet the fault: its value, or a verdict, or `again` if it was refused as promised.
  const call = async <T>(
    what: string,
    run: () => T | Promise<T>,
  ): Promise<{ readonly value: T } | { readonly again: true } | { readonly verdict: Verdict }> => {
    const result = await attempt(run, boundMs);
    if (result.kind === 'value') return { value: result.value };
    if (result.kind === 'hang') return { verdict: done('hang', `${what} did not end within ${boundMs / 1000} s`) };
    const code = codeOf(result.error);
    if (code === undefined) return { verdict: done('untyped', `${what}: ${describe(result.error)}`) };
    if (!recorder.struck)
      return { verdict: done('unusable', `${what} failed before the fault: ${describe(result.error)}`) };
    if (isLoss(fault) !== (code === 'renderer/device-lost'))
      return { verdict: done('untyped', `${what}: a wrong code: ${describe(result.error)}`) };
    refusal ??= code;
    return { again: true };
  };
  /** The whole step on a device that works. */
  const afresh = async (): Promise<Verdict> => {
    tracer?.destroy();
    const next = isLoss(fault) ? await healthy() : used;
    recorder.phase = 'again';
    const result = await attempt(async () => {
      tracer = await createTracer(next);
      await step.before?.(tracer);
      const value = digest(await step.act(tracer));
      return [value, await look(tracer)];
    }, boundMs);
    if (result.kind === 'hang') return done('hang', 'a new tracer after the fault');
    if (result.kind === 'error') return done('unusable', `a new tracer after the fault: ${describe(result.error)}`);
    const [value, after] = result.value;
    return value === expected.value && after === expected.after
      ? done('error', refusal)
      : done('silent', 'a new tracer after the fault shows another image');
  };
  const verdict = await (async (): Promise<Verdict> => {
    recorder.phase = step.name === 'create' ? 'create' : 'before';
    const made = await call('create', () => createTracer(used));
    if ('verdict' in made) return made.verdict;
    if ('again' in made) return afresh();
    tracer = made.value;
    recorder.phase = 'before';
    const ready = await call('before', async () => step.before?.(tracer as PathTracer));
    if ('verdict' in ready) return ready.verdict;
    if ('again' in ready) return afresh();
    recorder.phase = step.name;
    const acted = await call(step.name, async () => digest(await step.act(tracer as PathTracer)));
    if ('verdict' in acted) return acted.verdict;
    if ('again' in acted) {
      if (isLoss(fault)) return afresh();
      recorder.phase = 'again';
      if (expected.before !== undefined) {
        const stands = await attempt(() => look(tracer as PathTracer), boundMs);
        if (stands.kind !== 'value')
          return done(
            stands.kind === 'hang' ? 'hang' : 'unusable',
            `render after a refused ${step.name}: ${stands.kind === 'error' ? describe(stands.error) : 'hang'}`,
          );
        if (stands.value !== expected.before)
          return done('not-rolled-back', `${refusal}; the image is neither as before`);
        tracer.reset();
      }
      const again = await attempt(async () => digest(await step.act(tracer as PathTracer)), boundMs);
      if (again.kind !== 'value')
        return done(
          again.kind === 'hang' ? 'hang' : 'unusable',
          `${step.name} again: ${again.kind === 'error' ? describe(again.error) : 'hang'}`,
        );
      if (again.value !== expected.value) return done('silent', `${step.name} again gives other data`);
    } else if (recorder.struck && acted.value !== expected.value)
      return done('silent', `${step.name} resolved with other data`);
    recorder.phase = `render after ${step.name}`;
    const shown = await call('render', () => look(tracer as PathTracer));
    if ('verdict' in shown) return shown.verdict;
    if ('again' in shown) {
      if (isLoss(fault)) return afresh();
      recorder.phase = 'again';
      const again = await attempt(() => look(tracer as PathTracer), boundMs);
      if (again.kind !== 'value')
        return done(
          again.kind === 'hang' ? 'hang' : 'unusable',
          `render again: ${again.kind === 'error' ? describe(again.error) : 'hang'}`,
        );
      if (again.value !== expected.after) return done('silent', 'render again shows another image');
      return done('error', refusal);
    }
    if (shown.value !== expected.after) return done('silent', 'another image, and no error');
    return refusal === undefined ? done('image') : done('error', refusal);
  })();
  recorder.phase = 'destroy';
  const gone = await attempt(() => tracer?.destroy(), boundMs);
  if (verdict.ending !== 'image' && verdict.ending !== 'error') return verdict;
  if (gone.kind === 'error') return done('untyped', `destroy: ${describe(gone.error)}`);
  const left = [...recorder.live].filter(([object]) => !alive.has(object)).map(([, { label }]) => label);
  for (const object of recorder.live.keys()) if (!alive.has(object)) recorder.live.delete(object);
  return left.length > 0 ? done('leak', left.join(', ')) : verdict;
}
