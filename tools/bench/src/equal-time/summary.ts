import { BenchError } from '../error';
import { geometricMean } from '../geometric-mean';
import type { ContestantName } from './contestants';
import type { Measurement, Point } from './measure';
import type { CrossCheck } from './reference';

/** What is written about a scene. */
export interface SceneInfo {
  readonly name: string;
  readonly title: string;
  readonly truth: 'references' | 'own';
}

/** All that a run of the benchmark found. */
export interface EqualTimeDetails {
  readonly budgetsMs: readonly number[];
  readonly size: number;
  readonly runs: number;
  readonly scenes: readonly SceneInfo[];
  readonly measurements: readonly Measurement[];
  readonly crossChecks: readonly CrossCheck[];
}

/**
 * What was measured in pieces, as one. Of a scene in several pieces the last counts.
 *
 * @throws {BenchError} `bench/option` where the pieces were measured in different ways.
 */
export function joinDetails(pieces: readonly EqualTimeDetails[]): EqualTimeDetails {
  const way = ({ budgetsMs, size, runs }: EqualTimeDetails) => JSON.stringify({ budgetsMs, size, runs });
  const [first] = pieces as readonly [EqualTimeDetails, ...EqualTimeDetails[]];
  const other = pieces.find((piece) => way(piece) !== way(first));
  if (other)
    throw new BenchError(
      'bench/option',
      `--from: reports of different measurements cannot be one: ${way(first)} and ${way(other)}.`,
    );
  const names = [...new Set(pieces.flatMap(({ scenes }) => scenes.map(({ name }) => name)))];
  const last = names.map(
    (name) => pieces.findLast(({ scenes }) => scenes.some((scene) => scene.name === name)) as EqualTimeDetails,
  );
  return {
    ...first,
    scenes: names.flatMap((name, i) => last[i]!.scenes.filter((scene) => scene.name === name)),
    measurements: names.flatMap((name, i) => last[i]!.measurements.filter(({ scene }) => scene === name)),
    crossChecks: names.flatMap((name, i) => last[i]!.crossChecks.filter(({ scene }) => scene === name)),
  };
}

/** What two contestants can be compared by. */
export type Quantity = 'relMSE' | 'noise' | 'FLIP';

/** Below this share of the reference's own noise, an error cannot be distinguished from none. */
const RESOLUTION = 0.05;

const mean = (values: readonly number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;

export function measurementOf(
  { measurements }: EqualTimeDetails,
  scene: string,
  contestant: ContestantName,
): Measurement | undefined {
  return measurements.find((m) => m.scene === scene && m.contestant === contestant);
}

const at = (m: Measurement, budget: number, of: (point: Point) => number) =>
  mean(m.points.map((run) => of(run[budget]!)));

/** A quantity at a budget (by its index), mean over runs. Never below what the reference can resolve. */
export function valueAt(m: Measurement, quantity: Quantity, budget: number): number {
  if (quantity === 'noise') return m.noise[budget] ?? NaN;
  if (quantity === 'FLIP') return at(m, budget, ({ flip }) => flip);
  return Math.max(
    at(m, budget, ({ relMse }) => relMse),
    RESOLUTION * at(m, budget, ({ relMse, relMseWithReference }) => relMseWithReference - relMse),
  );
}

/** Milliseconds at a budget, mean over runs. */
export const timeAt = (m: Measurement, budget: number, clock: 'gpuMs' | 'wallMs') =>
  at(m, budget, (point) => point[clock]);

/**
 * How a quantity falls with time where it was not measured: variance as 1 / time, FLIP as a difference of colours with
 * its root.
 */
const DECAY: Readonly<Record<Quantity, number>> = { relMSE: 1, noise: 1, FLIP: 0.5 };

/**
 * A quantity after some time: between measured points on a straight line of logarithms; beyond them, from the nearest,
 * as noise falls.
 */
export function valueAfter(
  m: Measurement,
  quantity: Quantity,
  clock: 'gpuMs' | 'wallMs',
  milliseconds: number,
): number {
  const count = m.points[0]?.length ?? 0;
  const points = Array.from(
    { length: count },
    (_, b) => [Math.log(timeAt(m, b, clock)), Math.log(valueAt(m, quantity, b))] as const,
  ).sort((a, b) => a[0] - b[0]);
  const x = Math.log(milliseconds);
  const after = points.findIndex(([time]) => time >= x);
  const beyond = ([time, value]: readonly [number, number]) => Math.exp(value - DECAY[quantity] * (x - time));
  if (after === 0) return beyond(points[0]!);
  if (after < 0) return beyond(points.at(-1)!);
  const [[x0, y0], [x1, y1]] = [points[after - 1]!, points[after]!];
  return Math.exp(x1 > x0 ? y0 + ((y1 - y0) * (x - x0)) / (x1 - x0) : Math.min(y0, y1));
}

/** The quantity by which a scene's contestants are compared: models differ where our own render is the reference. */
export const fairQuantity = ({ truth }: SceneInfo): Quantity => (truth === 'references' ? 'relMSE' : 'noise');

/**
 * How many times lower Glanz's error is than the peer's at each budget, at equal GPU or wall time; `undefined` where
 * one is missing.
 */
export function ratios(
  details: EqualTimeDetails,
  scene: string,
  peer: ContestantName,
  quantity: Quantity,
  clock: 'gpuMs' | 'wallMs' = 'gpuMs',
): number[] | undefined {
  const [ours, theirs] = [measurementOf(details, scene, 'glanz'), measurementOf(details, scene, peer)];
  if (!ours || !theirs) return undefined;
  if (quantity === 'noise' && details.runs < 2) return undefined;
  // Where a unit of the peer's work is longer than the budget, it has had more time: so has Glanz then.
  return details.budgetsMs.map(
    (_, b) => valueAt(theirs, quantity, b) / valueAfter(ours, quantity, clock, timeAt(theirs, b, clock)),
  );
}

/** Geometric mean of {@link ratios} over scenes and budgets; `undefined` where there are none. */
export function overall(
  details: EqualTimeDetails,
  peer: ContestantName,
  quantity: (scene: SceneInfo) => Quantity | undefined,
  clock: 'gpuMs' | 'wallMs' = 'gpuMs',
): { readonly mean: number; readonly min: number; readonly max: number; readonly count: number } | undefined {
  const all = details.scenes.flatMap((scene) => {
    const what = quantity(scene);
    return what === undefined ? [] : (ratios(details, scene.name, peer, what, clock) ?? []);
  });
  const finite = all.filter((ratio) => Number.isFinite(ratio) && ratio > 0);
  return finite.length === 0
    ? undefined
    : { mean: geometricMean(finite), min: Math.min(...finite), max: Math.max(...finite), count: finite.length };
}
