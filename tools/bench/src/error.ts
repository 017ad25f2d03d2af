import { GlanzError } from '@glanz/scene';

/**
 * A benchmark cannot run. Codes: `bench/browser`, `bench/unknown-name`, `bench/not-available`, `bench/option`,
 * `bench/missing-data`, `bench/wrong-hits`, `bench/failed`.
 */
export class BenchError extends GlanzError {}
