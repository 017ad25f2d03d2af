import { mkdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { faultsOf, type Fault, type FaultPoint } from '@glanz/gpu/faults';
import { quads } from '@glanz/browser/files';
import { launchOptions } from '@glanz/browser/launch';
import type { Viewer, ViewerOptions } from '@glanz/viewer';
import type { Journal } from './journal';
import type { Ending, Outcome } from './outcome';
import type { PageFaults } from './page';
import { repository } from './repository';

/** What {@link viewerCampaign} takes; see {@link tracerCampaign}. */
export interface ViewerCampaign {
  readonly faults?: readonly Fault[];
  readonly only?: string;
  readonly every?: number;
  readonly boundMs?: number;
  readonly journal: Journal;
  readonly onOutcome?: (outcome: Outcome, done: number, of: number) => void;
}

/** What happens to the viewer, in order. */
const PHASES = ['load', 'edit', 'resize', 'read', 'destroy'] as const;

interface Plan {
  readonly point?: string;
  readonly fault?: Fault;
  /** The phase during which the tab is hidden. */
  readonly hide?: string;
}

/** How the page ended. */
interface End {
  /** Size and digest of the finished film, or '' where an error came in its place. */
  readonly film: string;
  /** Codes of errors; `untyped: …` for others. */
  readonly errors: readonly string[];
  readonly hung: boolean;
  readonly points: readonly FaultPoint[];
  readonly struck: boolean;
  readonly live: readonly string[];
}

/** What the test page of the viewer puts into its window. */
interface PageWindow {
  make(options: ViewerOptions): Viewer;
  file(base64: string, name: string): File;
  glanzFaults: PageFaults;
}

/**
 * Runs in the page: load, edit, resize, read, destroy, with a fault on the way; and all of it again where that failed.
 */
async function run({
  base64,
  plan,
  boundMs,
}: {
  readonly base64: string;
  readonly plan: Plan;
  readonly boundMs: number;
}): Promise<End> {
  const page = globalThis as unknown as PageWindow;
  const { recorder } = page.glanzFaults;
  recorder.clear(plan.point === undefined ? undefined : { point: plan.point, fault: plan.fault! });
  const errors: string[] = [];
  const report = (error: unknown) => {
    const code = (error as { code?: unknown }).code;
    errors.push(
      typeof code === 'string' && code.includes('/') ? code : `untyped: ${String((error as Error)?.message ?? error)}`,
    );
  };
  const wait = (milliseconds: number) => new Promise<void>((done) => setTimeout(done, milliseconds));
  let viewer: Viewer | undefined;
  const enter = (phase: string) => {
    recorder.phase = phase;
    if (plan.hide !== phase) return;
    page.glanzFaults.hide(true);
    setTimeout(() => page.glanzFaults.hide(false), 700);
  };
  // The state alone may be that of before: a resize is seen a few frames later.
  const done = async (width: number) => {
    for (;;) {
      if (viewer!.state === 'done' && viewer!.tracer?.samples === 2 && viewer!.tracer.width === width) return;
      if (viewer!.state === 'failed') throw Object.assign(new Error('failed'), { code: 'viewer/failed' });
      await wait(20);
    }
  };
  const canvas = document.querySelector('canvas') as HTMLCanvasElement;
  const flow = async (): Promise<string> => {
    canvas.style.width = '320px';
    enter('load');
    viewer = page.make({
      samples: 2,
      maxDepth: 3,
      pixelRatio: 0.25,
      environment: { type: 'constant', radiance: [1, 1, 1] },
    });
    viewer.on('error', report);
    await viewer.load(page.file(base64, 'model.glb'));
    await done(80);
    enter('edit');
    await Promise.all([viewer.setVariant('night'), viewer.setMaterial('left', { base_color: [0.9, 0.9, 0.02] })]);
    await done(80);
    enter('resize');
    canvas.style.width = '200px';
    await done(50);
    enter('read');
    const read = () => viewer!.tracer!.read('beauty');
    const pixels = await read().catch(async (error: unknown) => {
      // A loss may come with the reading itself: the film that follows is read then.
      report(error);
      await wait(200);
      await done(50);
      return read();
    });
    const digest = new Uint8Array(await crypto.subtle.digest('SHA-256', pixels));
    return `${viewer.tracer!.width} × ${viewer.tracer!.height} ${[...digest.subarray(0, 12)].map((byte) => byte.toString(16).padStart(2, '0')).join('')}`;
  };
  let hung = false;
  const bounded = () =>
    Promise.race([
      flow(),
      wait(boundMs).then(() => {
        hung = true;
        errors.push(
          `viewer/hang in ${recorder.phase}: ${viewer?.state}, ${viewer?.tracer?.samples} samples, ${viewer?.tracer?.width} × ${viewer?.tracer?.height}`,
        );
        throw Object.assign(new Error('no end'), { code: 'viewer/hang' });
      }),
    ]);
  let film = '';
  try {
    film = await bounded();
  } catch (error) {
    report(error);
    const destroyed = viewer;
    destroyed?.destroy();
    if (!hung) film = await bounded().catch((again: unknown) => (report(again), ''));
  }
  enter('destroy');
  viewer?.destroy();
  await wait(100);
  return {
    film,
    errors,
    hung,
    points: [...recorder.points],
    struck: recorder.struck !== undefined,
    live: [...recorder.live.values()].map(({ kind, label }) => `${kind} ${label}`),
  };
}

/**
 * Injects faults into every distinct call to the GPU that a viewer in Chromium makes while it loads a model, edits it,
 * is resized, read and destroyed, and hides its tab in each of these phases. Each trial is a page of its own.
 */
export async function viewerCampaign({
  faults,
  only = '',
  every = 1,
  boundMs = 90_000,
  journal,
  onOutcome,
}: ViewerCampaign): Promise<void> {
  const root = repository();
  const [{ build }, { weslSource }, { chromium }, { servePage, watch }] = await Promise.all([
    import('esbuild'),
    import('../../../pipeline/wesl.mjs'),
    import('playwright'),
    import('@glanz/browser'),
  ]);
  const bundled = await build({
    entryPoints: [join(root, 'tools/bench/src/faults/page.ts')],
    bundle: true,
    write: false,
    format: 'iife',
    target: 'es2022',
    conditions: ['@glanz/source'],
    plugins: [weslSource()],
    logLevel: 'error',
  });
  const script = bundled.outputFiles[0]!.text;
  mkdirSync(join(root, '.cache'), { recursive: true });
  const served = await servePage(join(root, 'packages/viewer/test/page'));
  const browser = await chromium.launch(await launchOptions(resolve(root, '.cache/browser')));
  const base64 = quads([
    { name: 'left', colour: [0.9, 0.02, 0.02], at: [-1.2, 0, 0] },
    { name: 'right', colour: [0.02, 0.8, 0.02], at: [1.2, 0, 0], variants: { night: [0.02, 0.02, 0.9] } },
  ]).toString('base64');
  const start = async (plan: Plan): Promise<End & { readonly complaints: readonly string[] }> => {
    const page = await browser.newPage({ viewport: { width: 640, height: 480 } });
    try {
      const complaints = watch(page, served.origin);
      await page.addInitScript(script);
      await page.goto(served.origin);
      const end = await page.evaluate(run, { base64, plan, boundMs });
      return { ...end, complaints: complaints.filter((text) => text.startsWith('uncaught')) };
    } finally {
      await page.close();
    }
  };
  try {
    const reference = await start({});
    if (reference.errors.length > 0 || reference.film === '')
      throw new Error(`The viewer fails without a fault: ${reference.errors.join(', ')}`);
    const trials: { readonly name: string; readonly fault: Outcome['fault']; readonly plan: Plan }[] = [];
    for (const point of reference.points) {
      if (point.number > 2) continue;
      for (const fault of faultsOf(point))
        if (!faults || faults.includes(fault))
          trials.push({ name: point.name, fault, plan: { point: point.name, fault } });
    }
    if (!faults)
      for (const hide of PHASES) trials.push({ name: `tab in ${hide}`, fault: 'tab-hidden', plan: { hide } });
    const chosen = trials.filter(({ name }) => name.includes(only)).filter((_, i) => i % every === 0);
    for (const [i, { name, fault, plan }] of chosen.entries()) {
      const trial = { subject: 'viewer', point: name, fault } as const;
      if (journal.has(trial)) continue;
      journal.begin(trial);
      const end = await start(plan);
      if (plan.point !== undefined && !end.struck) {
        journal.miss(trial);
        continue;
      }
      const outcome: Outcome = { ...trial, ...judge(end, reference.film, end.complaints) };
      journal.end(outcome);
      onOutcome?.(outcome, i + 1, chosen.length);
    }
  } finally {
    await browser.close();
    await served.close();
  }
}

function judge(
  { film, errors, hung, live }: End,
  expected: string,
  complaints: readonly string[],
): { readonly ending: Ending; readonly detail?: string } {
  const detail = errors.length === 0 ? {} : { detail: [...new Set(errors)].join(', ') };
  if (hung) return { ending: 'hang', ...detail };
  if (complaints.length > 0) return { ending: 'unhandled', detail: complaints[0]! };
  const untyped = errors.find((error) => error.startsWith('untyped'));
  if (untyped !== undefined) return { ending: 'untyped', detail: untyped };
  if (film === '') return { ending: 'unusable', ...detail };
  if (film !== expected) return { ending: 'silent', detail: `${film} in place of ${expected}` };
  if (live.length > 0) return { ending: 'leak', detail: live.join(', ') };
  return errors.length === 0 ? { ending: 'image' } : { ending: 'error', ...detail };
}
