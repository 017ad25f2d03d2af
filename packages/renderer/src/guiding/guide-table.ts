import type { GuidePoints } from './guide-points';
import {
  GUIDE_BINS,
  GUIDE_COLUMNS as COLUMNS,
  GUIDE_POINTS,
  GUIDE_ROWS as ROWS,
  GUIDE_WIDTH,
} from './guide_constants.wesl';

/** A node counts what its parent has seen as so many samples of its own. */
const PRIOR = 8;

/**
 * Shares of directions that the guide may choose. Light that training has missed is left to the closure, whose samples
 * of it then are up to twice as noisy.
 */
const SHARES = [0.25, 0.5] as const;

/** A guide is used where it takes this share of the variance away at least. */
const WORTH = 0.1;

/** The middles of the bins. */
const MIDDLES = Array.from({ length: GUIDE_BINS }, (_, bin) => {
  const x = (2 * (Math.floor(bin / COLUMNS) + 0.5)) / ROWS - 1;
  const around = (((bin % COLUMNS) + 0.5) / COLUMNS - 0.5) * 2 * Math.PI;
  const r = Math.sqrt(1 - x * x);
  return [x, r * Math.cos(around), r * Math.sin(around)] as const;
});

/**
 * Second moments of the light in each leaf and bin: what the leaf has seen, blurred, and a little of what the nodes above
 * it have.
 *
 * @param half 0: of the even samples, 1: of the odd ones.
 * @param samples Of that half.
 */
function secondMoments(leaves: number, squares: Float32Array, half: 0 | 1, samples: number): Float64Array {
  const moments = new Float64Array(2 * leaves * GUIDE_BINS);
  const first = leaves * GUIDE_BINS;
  for (let i = 0; i < first; i++) {
    const bin = i % GUIDE_BINS;
    const at = (other: number) => squares[4 * (i - bin + other) + half] as number;
    const around = (by: number) => at(bin - (bin % COLUMNS) + ((bin + by + COLUMNS) % COLUMNS));
    const row = (by: number) => at(bin + by >= 0 && bin + by < GUIDE_BINS ? bin + by : bin);
    // Half of it by what the four bins beside it have seen.
    const beside = around(-1) + around(1) + row(-COLUMNS) + row(COLUMNS);
    moments[first + i] = (0.5 * at(bin) + 0.125 * beside) / samples;
  }
  const child = (node: number, bin: number) => moments[node * GUIDE_BINS + bin] as number;
  for (let node = leaves - 1; node > 0; node--)
    for (let bin = 0; bin < GUIDE_BINS; bin++)
      moments[node * GUIDE_BINS + bin] = (child(2 * node, bin) + child(2 * node + 1, bin)) / 2;
  for (let node = 2; node < 2 * leaves; node++) {
    const seen = (samples * leaves) / 2 ** Math.floor(Math.log2(node));
    for (let bin = 0; bin < GUIDE_BINS; bin++)
      moments[node * GUIDE_BINS + bin] = (seen * child(node, bin) + PRIOR * child(node >> 1, bin)) / (seen + PRIOR);
  }
  return moments.subarray(first);
}

/**
 * The tables of a guide. A leaf's table holds for each bin the sum of the probabilities up to it, times the share of
 * directions that the guide chooses there: the least that leaves of the variance of diffuse reflection, 0 where that is
 * not {@link WORTH} it.
 *
 * A bin's probability follows the root of the light's second moment, which leaves the least variance (Rath et al. 2020,
 * "Variance-Aware Path Guiding"), times the cosine. The variance is that of the odd samples with a guide of the even
 * ones, and the other way round: a guide that has learned noise is not used.
 *
 * @param squares Per leaf and bin the sums of squared luminance over even and over odd samples; stride 4.
 * @param samples Samples of each half.
 * @returns The tree's nodes, then the tables; rows of {@link GUIDE_WIDTH} numbers.
 */
export function guideTable(
  { leaves, nodes, points }: GuidePoints,
  squares: Float32Array,
  samples: number,
): Float32Array<ArrayBuffer> {
  const halves = [secondMoments(leaves, squares, 0, samples), secondMoments(leaves, squares, 1, samples)] as const;
  const length = (2 + GUIDE_BINS) * leaves;
  const data = new Float32Array(GUIDE_WIDTH * Math.ceil(length / GUIDE_WIDTH));
  data.set(nodes);
  for (let leaf = 0; leaf < leaves; leaf++) {
    const cosines = cosinesOf(points.subarray(8 * leaf * GUIDE_POINTS, 8 * (leaf + 1) * GUIDE_POINTS));
    const [even, odd] = halves.map((half) => half.subarray(leaf * GUIDE_BINS, (leaf + 1) * GUIDE_BINS)) as [
      Float64Array,
      Float64Array,
    ];
    const share = bestShare(cosines, even, odd);
    if (share === 0) continue;
    const chances = chancesOf(
      cosines,
      even.map((value, bin) => value + (odd[bin] as number)),
    );
    let below = 0;
    for (let bin = 0; bin < GUIDE_BINS; bin++) {
      below += share * (chances[bin] as number);
      data[2 * leaves + leaf * GUIDE_BINS + bin] = below;
    }
  }
  return data;
}

/** Probabilities of the bins in diffuse reflection, for the mean of a leaf's points. */
function cosinesOf(points: Float32Array): Float64Array {
  const cosines = Float64Array.from(MIDDLES, ([x, y, z]) => {
    let sum = 1e-3;
    for (let k = 0; k < points.length; k += 8)
      sum += Math.abs((points[k + 4] as number) * x + (points[k + 5] as number) * y + (points[k + 6] as number) * z);
    return sum;
  });
  const total = cosines.reduce((a, b) => a + b);
  return cosines.map((value) => value / total);
}

/** Probabilities of the bins by the guide. */
function chancesOf(cosines: Float64Array, moments: Float64Array): Float64Array {
  const weights = cosines.map((cosine, bin) => cosine * Math.sqrt(moments[bin] as number));
  const total = weights.reduce((a, b) => a + b);
  return total > 0 ? weights.map((value) => value / total) : weights;
}

function bestShare(cosines: Float64Array, even: Float64Array, odd: Float64Array): number {
  const pairs = [
    [chancesOf(cosines, even), odd],
    [chancesOf(cosines, odd), even],
  ] as const;
  const left = (share: number) => {
    let sum = 0;
    for (const [chances, moments] of pairs)
      for (let bin = 0; bin < GUIDE_BINS; bin++) {
        const cosine = cosines[bin] as number;
        const chance = share * (chances[bin] as number) + (1 - share) * cosine;
        sum += ((moments[bin] as number) * cosine * cosine) / chance;
      }
    return sum;
  };
  let [best, lowest] = [0, (1 - WORTH) * left(0)];
  for (const share of SHARES) {
    const variance = left(share);
    if (variance < lowest) [best, lowest] = [share, variance];
  }
  return best;
}
