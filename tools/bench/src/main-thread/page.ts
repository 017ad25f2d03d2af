import { launchChromium, type Chromium } from '../browser/chromium';
import { firstFilm, servePlayground } from '../browser/playground';

/** What the page's main thread did during an action. */
export interface Blocked {
  /** The longest task, milliseconds of that thread's time: what else the machine does is not in it. */
  readonly longestTask: number;
  /** The longest task by the clock. */
  readonly longestTaskWall: number;
  /** The longest time between two messages that the page sent itself, by the clock. */
  readonly longestGap: number;
  /** Entries of the browser's own kind: tasks of 50 ms and more. */
  readonly longTasks: readonly number[];
  /** Milliseconds in all, by the clock. */
  readonly ms: number;
  /** Names and milliseconds of the functions that took most of the longest tasks, where a profile was asked for. */
  readonly profile?: readonly string[];
}

interface TraceEvent {
  readonly name: string;
  readonly ph: string;
  readonly pid: number;
  readonly tid: number;
  readonly ts: number;
  readonly dur?: number;
  readonly tdur?: number;
  readonly id?: string;
  readonly args?: {
    readonly name?: string;
    readonly data?: {
      readonly message?: string;
      readonly functionName?: string;
      readonly url?: string;
      readonly lineNumber?: number;
      readonly cpuProfile?: { readonly nodes?: readonly ProfileNode[]; readonly samples?: readonly number[] };
      readonly timeDeltas?: readonly number[];
      readonly startTime?: number;
    };
  };
}

interface ProfileNode {
  readonly id: number;
  readonly parent?: number;
  readonly callFrame: { readonly functionName: string; readonly url?: string; readonly lineNumber?: number };
}

/**
 * The playground, built from the sources of the workspace, in Chromium.
 *
 * @param profile Whether to say which functions long tasks are in.
 */
export async function openPlayground(profile: boolean, gpu: Chromium['gpu'] = 'software') {
  const { browser } = await launchChromium(gpu);
  const server = await servePlayground(profile);
  const { origin } = server;
  return {
    version: browser.version(),
    /** Opens a file in a page of its own and looks at its thread until the first image of it is there. */
    async watch(name: string, file: string): Promise<Blocked> {
      const page = await browser.newPage({ viewport: { width: 700, height: 500 } });
      try {
        await page.goto(`${origin}/?model=cornell-box&scale=0.25&samples=1&max-depth=2`);
        await firstFilm(page);
        await page.waitForSelector('#image[data-state="done"]', { state: 'attached', timeout: 300_000 });
        await page.evaluate(() => {
          const seen = { gap: 0, long: [] as number[], done: false };
          Object.assign(globalThis, { seen });
          new PerformanceObserver((list) =>
            seen.long.push(...list.getEntries().map(({ duration }) => duration)),
          ).observe({ type: 'longtask' });
          const { port1, port2 } = new MessageChannel();
          let last = performance.now();
          port1.onmessage = () => {
            const now = performance.now();
            seen.gap = Math.max(seen.gap, now - last);
            last = now;
            // Not at once, or the page would do nothing else.
            if (!seen.done) setTimeout(() => port2.postMessage(0), 1);
          };
          port2.postMessage(0);
        });
        await browser.startTracing(page, {
          categories: [
            '__metadata',
            'toplevel',
            'devtools.timeline',
            ...(profile ? ['disabled-by-default-v8.cpu_profiler'] : []),
          ],
        });
        // Nor does its start count: it takes a task of more than ten milliseconds.
        await page.evaluate(() => {
          const { seen } = globalThis as unknown as { seen: { gap: number; long: number[] } };
          seen.long.length = seen.gap = 0;
          console.timeStamp('begin');
        });
        const begun = performance.now();
        await page.setInputFiles('#files', file);
        await page.waitForSelector(`#image[data-scene="${name}"][data-state="done"]`, {
          state: 'attached',
          timeout: 300_000,
        });
        const ms = performance.now() - begun;
        // Before the trace is fetched, for which the browser stops the page's thread.
        const seen = await page.evaluate(() => {
          const { seen } = globalThis as unknown as { seen: { gap: number; long: number[]; done: boolean } };
          seen.done = true;
          return { gap: seen.gap, long: [...seen.long] };
        });
        const { traceEvents } = JSON.parse((await browser.stopTracing()).toString()) as { traceEvents: TraceEvent[] };
        const main = new Set(
          traceEvents
            .filter((event) => event.name === 'thread_name' && event.args?.name === 'CrRendererMain')
            .map(({ pid, tid }) => `${pid}/${tid}`),
        );
        const begin = traceEvents.find(({ name, args }) => name === 'TimeStamp' && args?.data?.message === 'begin');
        if (!begin) throw new Error('the trace does not show where the load begins');
        const events = traceEvents.filter(
          ({ ph, pid, tid, dur, ts }) => ph === 'X' && dur !== undefined && ts >= begin.ts && main.has(`${pid}/${tid}`),
        );
        const tasks = wholeTasks(events);
        return {
          ms,
          longestTask: Math.max(0, ...tasks.map(({ tdur }) => tdur / 1000)),
          longestTaskWall: Math.max(0, ...tasks.map(({ dur }) => dur / 1000)),
          longestGap: seen.gap,
          longTasks: seen.long,
          ...(profile ? { profile: longFunctions(traceEvents, events, tasks) } : {}),
        };
      } finally {
        await page.close();
      }
    },
    async close() {
      await browser.close();
      await server.close();
    },
  };
}

type Task = Pick<TraceEvent, 'pid' | 'tid' | 'ts'> & { dur: number; tdur: number };

/** Microseconds between a task and what its promises have called, which the browser separates. */
const TOGETHER = 200;

/**
 * The tasks of a thread with what their promises have called: to the page they are one. What lies in a task belongs to
 * it; the page's own start lasts as long as the page.
 */
function wholeTasks(events: readonly TraceEvent[]): Task[] {
  const tasks: Task[] = [];
  for (const { name, pid, tid, ts, dur = 0, tdur = 0 } of [...events].sort((a, b) => a.ts - b.ts)) {
    const promises = name.endsWith('PerformMicrotaskCheckpoint');
    if (!promises && !name.endsWith('RunTask')) continue;
    const last = tasks.findLast((task) => task.pid === pid && task.tid === tid);
    if (last && ts < last.ts + last.dur) continue;
    if (promises && last && ts - last.ts - last.dur < TOGETHER) {
      last.dur = ts + dur - last.ts;
      last.tdur += tdur;
    } else tasks.push({ pid, tid, ts, dur, tdur });
  }
  return tasks;
}

/** The function that an event calls, where it says so. */
function placeOf({ args }: TraceEvent): string {
  const { functionName, url, lineNumber } = args?.data ?? {};
  return url === undefined
    ? ''
    : ` (${functionName || 'anonymous'}, ${url.slice(url.lastIndexOf('/') + 1)}:${lineNumber ?? 0})`;
}

/** Which functions the samples in tasks over 8 ms fell into, by their chains of callers. */
function longFunctions(events: readonly TraceEvent[], parts: readonly TraceEvent[], tasks: readonly Task[]): string[] {
  const long = tasks
    .filter(({ tdur }) => tdur > 8000)
    .sort((a, b) => b.tdur - a.tdur)
    .slice(0, 12);
  const lines: string[] = [];
  for (const task of long) {
    const inside = parts
      .filter(
        ({ ts, dur = 0, name, pid, tid }) =>
          pid === task.pid &&
          tid === task.tid &&
          ts >= task.ts &&
          ts + dur <= task.ts + task.dur + 1 &&
          dur > 2000 &&
          !name.includes('RunTask'),
      )
      .sort((a, b) => b.dur! - a.dur!);
    const counts = new Map<string, number>();
    for (const start of events.filter(({ name, pid }) => name === 'Profile' && pid === task.pid)) {
      const chunks = events
        .filter(({ name, id, pid }) => name === 'ProfileChunk' && id === start.id && pid === start.pid)
        .sort((a, b) => a.ts - b.ts);
      const nodes = new Map<number, ProfileNode>();
      let at = start.args?.data?.startTime ?? start.ts;
      for (const { args } of chunks) {
        for (const node of args?.data?.cpuProfile?.nodes ?? []) nodes.set(node.id, node);
        const samples = args?.data?.cpuProfile?.samples ?? [],
          deltas = args?.data?.timeDeltas ?? [];
        samples.forEach((sample, i) => {
          at += deltas[i] ?? 0;
          if (at < task.ts || at > task.ts + task.dur) return;
          const chain: string[] = [];
          for (
            let node = nodes.get(sample);
            node && chain.length < 6;
            node = node.parent === undefined ? undefined : nodes.get(node.parent)
          )
            chain.push(node.callFrame.functionName || '(anonymous)');
          const key = chain.join(' < ');
          counts.set(key, (counts.get(key) ?? 0) + (deltas[i] ?? 0));
        });
      }
    }
    lines.push(
      `task of ${(task.tdur / 1000).toFixed(1)} ms (${(task.dur / 1000).toFixed(1)} by the clock): ${inside
        .slice(0, 6)
        .map((event) => `${event.name}${placeOf(event)} ${(event.dur! / 1000).toFixed(1)}`)
        .join(', ')}`,
    );
    for (const [key, us] of [...counts].sort((a, b) => b[1] - a[1]).slice(0, 6))
      lines.push(`    ${(us / 1000).toFixed(1)} ms ${key}`);
  }
  return lines;
}
