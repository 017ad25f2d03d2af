import type { Benchmark } from '../benchmark';

/** The benchmarks by name. Each is loaded only when it runs, so that one missing piece does not stop the others. */
export const BENCHMARKS: Readonly<Record<string, () => Promise<{ readonly benchmark: Benchmark }>>> = {};
