import { buildBlas, type BlasOptions } from '../blas';
import type { TriangleMesh } from '../layout';
import { best, bestSplit } from '../builders/best';
import type { BuildSettings } from '../builders/builder';
import { fast } from '../builders/fast';
import { Scratch } from '../builders/scratch';
import type { TriangleTree } from '../builders/steps';
import { ownPort, type WorkerPort } from './port';
import { buffersOf, sendableError, type BuildReply, type BuildRequest, type SentOptions } from './protocol';
import { RETAIN_MS } from './retained';
import { Team } from './team';
import { buildInParallel } from './parallel-build';

export type { WorkerPort } from './port';

/**
 * Warm-up builds, and quads along an edge of their mesh: all code is optimised after about a tenth of a second.
 */
const WARM_BUILDS = 24;
const WARM_EDGE = 40;
/** Triangles of these builds together: as many in real builds make the warm-up superfluous. */
const WARM_TRIANGLES = 2 * WARM_BUILDS * WARM_EDGE ** 2;

/** A wavy sheet of quads, each row with triangles of another size: splits, pairs and rotations all have work. */
function sheet(edge: number): TriangleMesh {
  const positions = new Float32Array((edge + 1) * (edge + 1) * 3);
  const indices = new Uint32Array(edge * edge * 6);
  for (let y = 0, p = 0, i = 0; y <= edge; y++) {
    for (let x = 0; x <= edge; x++) {
      positions.set([x * (1 + 0.05 * y), Math.sin(7.3 * x + 1.7 * y), y * y * 0.1], 3 * p);
      if (x < edge && y < edge) {
        indices.set([p, p + 1, p + edge + 1, p + 1, p + edge + 2, p + edge + 1], i);
        i += 6;
      }
      p++;
    }
  }
  return { positions, indices };
}

function receivedOptions({ builder, ...others }: SentOptions): BlasOptions {
  const named = [fast, best, bestSplit].find(({ name }) => name === builder) ?? (builder as 'balanced' | undefined);
  return named === undefined ? others : { ...others, builder: named };
}

/** Placeholder for the tree, which the other worker has. */
const nothing = (): TriangleTree => ({
  nodes: new Float32Array(0),
  nodeCount: 0,
  triangleIndices: new Uint32Array(0),
  bounds: new Float64Array(6),
});

/**
 * Answers build requests of a `BvhWorkers` pool. This module calls it when it is loaded as a worker, and does nothing
 * elsewhere; call it only in your own worker, made by `createWorker`.
 *
 * @param port Receives and posts the worker's messages.
 */
export function serveBuilds(port: WorkerPort): void {
  // Engines compile code for typed arrays on the assumption that no buffer is ever detached, and discard that code when
  // one is, as by the first answer. So detach one now, before anything is compiled.
  const gone = new ArrayBuffer(8);
  structuredClone(gone, { transfer: [gone] });
  const say = (reply: BuildReply, transfer?: readonly ArrayBuffer[]) => port.post(reply, transfer);
  /** Triangles of the requested builds. */
  let built = 0;
  // Meshes come several at a time: keep the working memory, as new memory costs half as much as a build.
  let held: readonly ArrayBuffer[] | undefined;
  let releaseTimer: ReturnType<typeof setTimeout> | undefined;
  const holdMemory = () => {
    held = Scratch.left?.deref();
    clearTimeout(releaseTimer);
    if (held) releaseTimer = setTimeout(() => (held = undefined), RETAIN_MS);
  };
  const warmUp = (left: number) => {
    // One build at a time, so that a request waits for at most two milliseconds.
    if (built >= WARM_TRIANGLES || left === 0) return say({ kind: 'warmed' });
    buildBlas(sheet(WARM_EDGE + (left % 4)));
    setTimeout(() => warmUp(left - 1), 0);
  };
  const together = ({ id, mesh, options, index, memory }: BuildRequest & { kind: 'together' }) => {
    const team = new Team(index, memory);
    if (index === 0) say({ kind: 'started', id });
    try {
      // eslint-disable-next-line require-yield
      const build = function* (given: TriangleMesh, count: number, settings: BuildSettings) {
        return buildInParallel(given, count, settings, team) ?? nothing();
      };
      // The name is only for messages between threads.
      const blas = buildBlas(mesh, { ...receivedOptions(options), builder: { name: 'fast', build } });
      if (index === 1) return say({ kind: 'helped', id });
      say({ kind: 'built', id, blas }, buffersOf(blas.nodes, blas.triangleIndices, blas.bounds.min, blas.bounds.max));
    } catch (error) {
      if (team.peerGaveUp) return say({ kind: 'helped', id });
      team.giveUp();
      say({ kind: 'failed', id, error: sendableError(error) });
    }
  };
  port.listen((message) => {
    const request = message as BuildRequest;
    if (request.kind === 'warm-up') return warmUp(WARM_BUILDS);
    built += Math.floor((request.mesh.indices?.length ?? request.mesh.positions.length / 3) / 3);
    if (request.kind === 'together') return together(request);
    const { id, mesh, options } = request;
    say({ kind: 'started', id });
    try {
      const blas = buildBlas(mesh, receivedOptions(options));
      holdMemory();
      say({ kind: 'built', id, blas }, buffersOf(blas.nodes, blas.triangleIndices, blas.bounds.min, blas.bounds.max));
    } catch (error) {
      say({ kind: 'failed', id, error: sendableError(error) });
    }
  });
  say({ kind: 'ready' });
}

const port = ownPort();
if (port) serveBuilds(port);
