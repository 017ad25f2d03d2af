/** The hash of one layer of a film, or of one program. */
export interface HashEntry {
  readonly scene: string;
  /** Name of a layer, or of a kernel. */
  readonly part: string;
  readonly hash: string;
  /** Of films: the mean of each channel. */
  readonly means?: readonly (number | null)[];
}

/** What `hashes` stores as `details`. */
export interface Hashes {
  readonly films: readonly HashEntry[];
  readonly programs: readonly HashEntry[];
  /** Scenes that could not be loaded or rendered, with the reason. */
  readonly skipped: readonly string[];
}

/** One entry that differs between two runs. */
export interface Difference {
  readonly scene: string;
  readonly part: string;
  readonly before: string;
  readonly after: string;
  /** Films: the largest relative change of a channel's mean. */
  readonly change?: number;
}

const key = ({ scene, part }: HashEntry) => `${scene}\n${part}`;

function largestChange(before: HashEntry, after: HashEntry): number | undefined {
  if (!before.means || !after.means) return undefined;
  const changes = before.means.map((mean, i) => {
    const other = after.means![i] ?? NaN;
    return mean === other ? 0 : Math.abs((mean ?? NaN) - other) / Math.max(Math.abs(mean ?? NaN), 1e-30);
  });
  return Math.max(...changes);
}

/**
 * What differs between two runs.
 *
 * @param partial Some of the scenes alone ran now: those that `after` lacks are not differences.
 */
export function differences(before: readonly HashEntry[], after: readonly HashEntry[], partial = false): Difference[] {
  const old = new Map(before.map((entry) => [key(entry), entry]));
  const now = new Map(after.map((entry) => [key(entry), entry]));
  const found: Difference[] = [];
  for (const [name, entry] of now) {
    const other = old.get(name);
    if (other?.hash === entry.hash) continue;
    const change = other && largestChange(other, entry);
    found.push({
      scene: entry.scene,
      part: entry.part,
      before: other?.hash ?? 'none',
      after: entry.hash,
      ...(change === undefined ? {} : { change }),
    });
  }
  if (partial) return found;
  const gone = [...old]
    .filter(([name]) => !now.has(name))
    .map(([, { scene, part, hash }]) => ({ scene, part, before: hash, after: 'none' }));
  return [...found, ...gone];
}

/** Flags that no program has on, and those that no program has off. */
export function unusedFlags(flagSets: readonly Readonly<Record<string, boolean>>[]): {
  readonly neverOn: string[];
  readonly neverOff: string[];
} {
  const names = [...new Set(flagSets.flatMap((flags) => Object.keys(flags)))].sort();
  return {
    neverOn: names.filter((name) => !flagSets.some((flags) => flags[name] === true)),
    neverOff: names.filter((name) => !flagSets.some((flags) => flags[name] === false)),
  };
}
