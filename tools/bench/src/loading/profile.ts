import type { Page } from 'playwright';
import type { Contestant } from './models';

/** Kinds of work that a load's time on the calling thread goes to. */
export const WORK = {
  waiting: 'waiting for images, workers and the file',
  decoder: 'Draco and meshopt (WebAssembly)',
  tangents: 'tangents, normals, normalisation',
  checks: 'validation',
  own: 'the loader itself',
  browser: 'the browser (reading, copying, transferring images)',
  collector: 'garbage collection',
} as const;

export type Work = keyof typeof WORK;

/** Share of each kind of work in the time of loads, 0..1. */
export type Shares = Readonly<Record<Work, number>>;

interface ProfileNode {
  readonly id: number;
  readonly callFrame: { readonly functionName: string; readonly url: string; readonly lineNumber: number };
  readonly children?: readonly number[];
}

interface Profile {
  readonly nodes: readonly ProfileNode[];
  readonly samples: readonly number[];
  readonly timeDeltas: readonly number[];
}

/** For each line of a bundle the source file that it is from, as esbuild notes it. */
export function sourcesByLine(bundle: string): string[] {
  let file = '';
  return bundle.split('\n').map((line) => (file = /^\/\/ (\S+\.[mc]?[jt]s)$/.exec(line)?.[1] ?? file));
}

/** The kind of work of a function, by its name and where it stands; undefined: its caller's. */
export function workOf(
  { functionName, url, lineNumber }: ProfileNode['callFrame'],
  sources: ReadonlyMap<string, readonly string[]>,
): Work | undefined {
  if (functionName === '(idle)') return 'waiting';
  if (functionName === '(garbage collector)') return 'collector';
  if (functionName === '(program)') return 'browser';
  if (functionName.startsWith('(')) return undefined;
  if (/^wasm:|\.wasm$/.test(url)) return 'decoder';
  const file = sources.get(url.slice(url.lastIndexOf('/')))?.[lineNumber] ?? '';
  // The tangents' own WebAssembly is counted with its caller.
  if (/draco|meshopt_decoder|meshoptimizer\/meshopt_decoder/i.test(file)) return 'decoder';
  if (/gltf\/src\/(tangents|normals)|meshopt_tangents|mikk/i.test(file)) return 'tangents';
  if (/gltf\/src\/(check\/|limits|container)/.test(file)) return 'checks';
  if (file !== '') return 'own';
  // What has no file is the browser's: fetch, createImageBitmap, TextDecoder.
  return url === '' ? 'browser' : 'own';
}

/** Sums up what a profile says, by the nearest caller that is known. */
export function sharesOf(
  { nodes, samples, timeDeltas }: Profile,
  sources: ReadonlyMap<string, readonly string[]>,
): Shares {
  const byId = new Map(nodes.map((node) => [node.id, node]));
  const parents = new Map(nodes.flatMap(({ id, children = [] }) => children.map((child) => [child, id] as const)));
  const kinds = new Map<number, Work>();
  const kind = (id: number): Work => {
    let found = kinds.get(id);
    if (found === undefined) {
      const own = workOf(byId.get(id)!.callFrame, sources),
        parent = parents.get(id);
      const above = parent === undefined ? 'browser' : kind(parent);
      found = own === undefined || (own === 'decoder' && above === 'tangents') ? above : own;
      kinds.set(id, found);
    }
    return found;
  };
  const sums: Record<Work, number> = {
    waiting: 0,
    decoder: 0,
    tangents: 0,
    checks: 0,
    own: 0,
    browser: 0,
    collector: 0,
  };
  let all = 0;
  samples.forEach((sample, i) => {
    const time = Math.max(0, timeDeltas[i] ?? 0);
    sums[kind(sample)] += time;
    all += time;
  });
  for (const work of Object.keys(sums) as Work[]) sums[work] /= all || 1;
  return sums;
}

/** Where the page's own thread spends the time of loads from memory, one after the other for so many milliseconds. */
export async function profileLoads(
  page: Page,
  loader: Exclude<Contestant, 'worker'>,
  address: string,
  ms: number,
): Promise<Shares> {
  const session = await page.context().newCDPSession(page);
  const sources = new Map<string, string[]>();
  for (const name of ['/ours.js', '/three.js'])
    sources.set(name, sourcesByLine(await page.evaluate(async (path) => (await fetch(path)).text(), name)));
  await session.send('Profiler.enable');
  await session.send('Profiler.setSamplingInterval', { interval: 100 });
  // What the profiler sees begins and ends with the loads: the bytes are fetched before.
  await page.evaluate(
    async (path) => Object.assign(globalThis, { bytesToLoad: await (await fetch(path)).arrayBuffer() }),
    address,
  );
  const again = (min: number) =>
    page.evaluate(
      async ({ name, time }) => {
        const { loaders, bytesToLoad } = globalThis as unknown as {
          loaders: Record<string, (input: ArrayBuffer) => Promise<number>>;
          bytesToLoad: ArrayBuffer;
        };
        const begun = performance.now();
        do await loaders[name]!(bytesToLoad.slice(0));
        while (performance.now() - begun < time);
      },
      { name: loader, time: min },
    );
  await again(0);
  await session.send('Profiler.start');
  await again(ms);
  const { profile } = (await session.send('Profiler.stop')) as unknown as { profile: Profile };
  await session.detach();
  return sharesOf(profile, sources);
}
