/** Draws index i with probability weights[i] / Σ weights in constant time (Walker 1977, Vose 1991). */
export interface AliasTable {
  /** Probability of each index; sums to 1. */
  readonly probability: Float64Array;
  /** A draw that lands on row i keeps i with this probability and takes `alias[i]` otherwise. */
  readonly keep: Float64Array;
  readonly alias: Uint32Array;
}

/**
 * Builds an alias table in O(n).
 *
 * @param weights Not negative, finite. With a sum of 0 there is nothing to draw: `undefined`.
 */
export function buildAliasTable(weights: ArrayLike<number>): AliasTable | undefined {
  const n = weights.length;
  let total = 0;
  for (let i = 0; i < n; i++) total += weights[i] as number;
  if (!(total > 0) || !Number.isFinite(total)) return undefined;
  const probability = new Float64Array(n);
  const keep = new Float64Array(n).fill(1);
  const alias = new Uint32Array(n);
  const scaled = new Float64Array(n);
  const small = new Uint32Array(n);
  const large = new Uint32Array(n);
  let smalls = 0;
  let larges = 0;
  for (let i = 0; i < n; i++) {
    probability[i] = (weights[i] as number) / total;
    scaled[i] = (probability[i] as number) * n;
    alias[i] = i;
    if ((scaled[i] as number) < 1) small[smalls++] = i;
    else large[larges++] = i;
  }
  while (smalls > 0 && larges > 0) {
    const s = small[--smalls] as number;
    const l = large[larges - 1] as number;
    keep[s] = scaled[s] as number;
    alias[s] = l;
    scaled[l] = (scaled[l] as number) + (scaled[s] as number) - 1;
    if ((scaled[l] as number) < 1) {
      larges--;
      small[smalls++] = l;
    }
  }
  return { probability, keep, alias };
}
