// Loads mutants and reports each before and after, so that a hang or a crash can be attributed to one.
import { parentPort, workerData } from 'node:worker_threads';
import { OperationCounter } from '@glanz/operations';
import { validateScene } from '@glanz/scene';
import draco3d from 'draco3dgltf';
import { MeshoptDecoder } from 'meshoptimizer/decoder';
import { GltfError, loadGltf } from '../../src/index';
import { mutate, type Parts } from './mutate';
import { Random } from './random';

/** What a worker is started with. */
export interface FuzzTask {
  readonly parts: readonly Parts[];
  readonly seed: number;
  readonly first: number;
  readonly end: number;
  readonly step: number;
}

/** A bad end. */
export interface FuzzFinding {
  readonly mutant: number;
  readonly what: string;
}

/**
 * What a worker says: which mutant comes next, a bad end, or that all are done, with how often each end was: `scene`,
 * or an error's code.
 */
export type FuzzMessage =
  | { readonly at: number }
  | { readonly finding: FuzzFinding }
  | { readonly done: Readonly<Record<string, number>> };

/**
 * Mutants whose operations are counted at once, and how many operations they may take: a document can ask for 2^28
 * bytes of zeros.
 */
const TOGETHER = 64;
const MAX_OPERATIONS = 2 ** 30;

const outside = /^\/|\.\.|^[a-z]+:/i;

const port = parentPort;
if (port) {
  const { parts, seed, first, end, step } = workerData as FuzzTask;
  const draco: unknown = await draco3d.createDecoderModule();
  // Image decoders are external: only test that the loader handles what they return or throw.
  const decodeImage = (bytes: Uint8Array) =>
    bytes.length % 2
      ? Promise.reject(new Error('broken'))
      : Promise.resolve({ width: 1, height: 1, data: new Uint8Array(4) });
  const say = (message: FuzzMessage) => port.postMessage(message);
  const ends: Record<string, number> = {};
  const count = (end: string) => void (ends[end] = (ends[end] ?? 0) + 1);
  const load = async (mutant: number) => {
    const random = new Random(seed + mutant * 7919);
    const bytes = mutate(random.pick(parts), random);
    say({ at: mutant });
    const bad = (what: string) => say({ finding: { mutant, what } });
    const read: string[] = [];
    try {
      const files = new Map<string, Uint8Array<ArrayBuffer>>([['folder/document.gltf', bytes]]);
      const spied = {
        get: (path: string) => {
          read.push(path);
          return files.get(path);
        },
        [Symbol.iterator]: () => files[Symbol.iterator](),
        keys: () => files.keys(),
      } as unknown as Map<string, Uint8Array<ArrayBuffer>>;
      const scene = await loadGltf(random.below(2) ? bytes : { files: spied, entry: 'folder/document.gltf' }, {
        allowEmpty: true,
        decodeImage,
        decoders: { draco, meshopt: MeshoptDecoder },
        limits: { geometryBytes: 2 ** 28, instances: 2 ** 16 },
        ...(random.below(3) === 0 ? { time: random.below(100) / 50 } : {}),
      });
      validateScene(scene);
      count('scene');
      for (const { message } of scene.warnings) if (/[\n\r\u2028]/.test(message)) bad('a warning of several lines');
    } catch (error) {
      count(error instanceof GltfError ? error.code : 'none');
      if (!(error instanceof GltfError)) bad(error instanceof Error ? (error.stack ?? error.message) : String(error));
      else if (/[\n\r\u2028]/.test(error.message)) bad('a message of several lines');
    }
    if (read.some((path) => outside.test(path))) bad(`reads ${read.join(', ')}`);
    if (Object.keys(Object.prototype).length > 0 || 'polluted' in {}) bad('changes Object.prototype');
  };
  // The worker is bundled into one file.
  const counter = new OperationCounter(/./);
  for (let mutant = first; mutant < end; mutant += TOGETHER * step) {
    const { operations } = await counter.measure(async () => {
      for (let i = 0; i < TOGETHER && mutant + i * step < end; i++) await load(mutant + i * step);
    });
    if (operations > MAX_OPERATIONS)
      say({ finding: { mutant, what: `and the next ${TOGETHER - 1} of its thread take ${operations} operations` } });
  }
  counter.end();
  say({ done: ends });
}
