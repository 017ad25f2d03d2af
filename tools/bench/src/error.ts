import { GlanzError } from '@glanz/scene';

/**
 * A benchmark cannot run, or its result is wrong. Codes: `bench/option` (an unknown benchmark or option, or a value that
 * an option does not accept), `bench/missing` (a program such as Redis is missing), `bench/missing-data` (a file that the
 * benchmark reads is missing), `bench/browser` (no Chromium, or a Chromium without a GPU), `bench/not-available` (the
 * measurement is not possible on this machine), `bench/gpu-error` (the GPU reported errors during the measurement),
 * `bench/wrong-hits` (rays hit other triangles than brute force finds), `bench/different` (two loaders disagree about a
 * model), `bench/farm` (a batch was not queued), `bench/failed` (a part of the benchmark, or its process, failed).
 */
export class BenchError extends GlanzError {}
