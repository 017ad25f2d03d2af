import type { Blas } from '../blas';
import type { TriangleMesh } from '../layout';
import { BvhError } from '../error';
import { copyAll, roomFor, type Copy } from './copy';
import { BuildsHere, type Job } from './here';
import { connect, hardwareThreads, startWorker, type NodeWorkerLike, type WebWorkerLike } from './line';
import type { BvhWorkersOptions, WorkerBuildOptions } from './options';
import { buffersOf, receivedError, sendableOptions, type BuildReply, type BuildRequest } from './protocol';
import { seatsWorth, type Seat } from './seat';
import { Spare } from './spare';
import { release, teamMemory, tellCopied, type TeamMemory } from './team';

export type { NodeWorkerLike, WebWorkerLike } from './line';
export type { BvhWorkersOptions, WorkerBuildOptions } from './options';

/** Workers that warm up at a time: the calling thread has work too, and all share the threads that compile. */
const WARM_AT_ONCE = 2;

/** Small builds are sent ahead until a worker has so many triangles to do: it should not wait for the next message. */
const AHEAD = 16_384;

/**
 * A mesh of so many triangles is built by two workers together where nothing else waits for them and they can share
 * memory.
 */
const TOGETHER = 200_000;

/** On machines of so many threads a second one for the same mesh takes nothing from anybody. */
const SPARE_THREADS = 4;

/** A build of more triangles is worth ending its worker when it is aborted; a smaller one is let run out, unheard. */
const WORTH_ENDING = 100_000;

/** A worker that has not reported by then will not. */
const START_MS = 15_000;

/**
 * Builds hierarchies off the calling thread, several at a time. Module workers in browsers, `worker_threads` in Node.
 * Where there are no workers it builds on the calling thread, in slices of about ten milliseconds;
 * {@link fallback} then says why.
 *
 * @example
 * const workers = await BvhWorkers.create();
 * const trees = await Promise.all(meshes.map((mesh) => workers.buildBlas(mesh, { signal })));
 * workers.destroy();
 */
export class BvhWorkers {
  readonly #createWorker: () => WebWorkerLike | NodeWorkerLike;
  readonly #warmUp: boolean;
  readonly #together: boolean;
  readonly #seats: Set<Seat>;
  readonly #queue: Job[] = [];
  readonly #here = new BuildsHere();
  /** Builds by signal: one listener serves them all, however many meshes share a signal. */
  readonly #signals = new Map<AbortSignal, { readonly jobs: Set<Job>; readonly abort: () => void }>();
  /** What two workers share for a build, and whether one of them is done with it. */
  readonly #teams = new Map<number, { readonly memory: TeamMemory; half: boolean }>();
  /** What the last two have left. */
  readonly #spare = new Spare<TeamMemory>();
  #fallback: string | undefined;
  #nextId = 0;
  /** Triangles of all builds that were asked for since there was last nothing to do. */
  #burst = 0;
  /** Builds are about to be given out. */
  #giving = false;
  #destroyed = false;

  private constructor(
    count: number,
    { createWorker = startWorker, warmUp = false, together = hardwareThreads() >= SPARE_THREADS }: BvhWorkersOptions,
  ) {
    this.#together = together;
    this.#createWorker = createWorker;
    this.#warmUp = warmUp;
    this.#seats = new Set(
      Array.from({ length: count }, () => ({
        line: undefined,
        ready: false,
        timer: undefined,
        jobs: new Map<number, Job>(),
        load: 0,
        warmth: 'cold',
      })),
    );
  }

  /**
   * Starts the workers. Resolves as soon as one is ready, or with {@link fallback} set if none can be had; that is no
   * error.
   *
   * @throws {BvhError} `bvh/options` for a count that is not a whole number from 1 on.
   */
  static async create(options: BvhWorkersOptions = {}): Promise<BvhWorkers> {
    const count = options.count ?? Math.max(1, Math.min(8, hardwareThreads()));
    if (!(Number.isInteger(count) && count >= 1))
      throw new BvhError('bvh/options', `count is ${count}; it must be a whole number from 1 on.`);
    const workers = new BvhWorkers(count, options);
    await Promise.any([...workers.#seats].map((seat) => workers.#start(seat))).catch(() => undefined);
    return workers;
  }

  /** Workers there are, those that are starting included; 0 if builds run on the calling thread. */
  get count(): number {
    return this.#seats.size;
  }

  /** Why builds run on the calling thread; undefined where workers do them. */
  get fallback(): string | undefined {
    return this.#fallback;
  }

  /**
   * Builds the hierarchy of a mesh: the same as `buildBlas(mesh, options)`, bit for bit. Builds are taken up in the
   * order of the calls. The mesh is read when its build is taken up, so it must stay as it is until the promise
   * settles.
   *
   * @throws {BvhError} as `buildBlas` does; `bvh/worker` if the worker ends under the build, for want of memory
   * perhaps; `bvh/destroyed` after or during {@link destroy}.
   * @throws the signal's reason when aborted.
   */
  buildBlas(mesh: TriangleMesh, options: WorkerBuildOptions = {}): Promise<Blas> {
    const { signal, onProgress, transfer = false, ...own } = options;
    return new Promise<Blas>((resolve, reject) => {
      if (this.#destroyed) throw destroyed();
      signal?.throwIfAborted();
      const job: Job = {
        id: this.#nextId++,
        mesh,
        options: own,
        transfer,
        triangles: Math.floor((mesh.indices?.length ?? mesh.positions.length / 3) / 3),
        progress: (done) => {
          try {
            if (!job.settled) onProgress?.(done);
          } catch (error) {
            job.settle({ error });
          }
        },
        settle: (result) => {
          if (job.settled) return;
          job.settled = true;
          if (signal) this.#forget(signal, job);
          if ('error' in result) reject(result.error as Error);
          else resolve(result);
        },
        settled: false,
      };
      if (signal) this.#watch(signal, job);
      if (this.#queue.length === 0 && [...this.#seats].every(({ jobs }) => jobs.size === 0)) this.#burst = 0;
      this.#queue.push(job);
      this.#burst += job.triangles;
      // How many workers are worth it shows when all of a scene's builds have been asked for.
      if (this.#giving) return;
      this.#giving = true;
      queueMicrotask(() => {
        this.#giving = false;
        this.#next();
      });
    });
  }

  /** Ends all workers. Builds that are not done reject with `bvh/destroyed`. */
  destroy(): void {
    this.#destroyed = true;
    this.#spare.clear();
    for (const seat of this.#seats) {
      clearTimeout(seat.timer);
      seat.line?.terminate();
      for (const job of seat.jobs.values()) job.settle({ error: destroyed() });
      seat.jobs.clear();
    }
    this.#seats.clear();
    for (const job of this.#queue.splice(0)) job.settle({ error: destroyed() });
  }

  /** Puts a worker into a seat. Rejects if that fails, and takes the seat away. */
  #start(seat: Seat): Promise<void> {
    return new Promise<void>((resolve, reject) => {
      seat.ready = false;
      seat.warmth = 'cold';
      seat.line = undefined;
      const failed = (why: string) => {
        clearTimeout(seat.timer);
        if (seat.ready) this.#crashed(seat, why);
        else this.#remove(seat, why);
        reject(new BvhError('bvh/worker', why));
      };
      seat.timer = setTimeout(() => {
        seat.line?.terminate();
        failed(`no worker has reported within ${START_MS / 1000} s`);
      }, START_MS);
      try {
        seat.line = connect(
          this.#createWorker(),
          (message) => {
            const reply = message as BuildReply;
            if (reply.kind === 'warmed') {
              seat.warmth = 'warm';
              return this.#warmNext();
            }
            if (reply.kind !== 'ready') return this.#answered(seat, reply);
            clearTimeout(seat.timer);
            seat.ready = true;
            this.#warmNext();
            seat.line?.hold(false);
            resolve();
            this.#next();
          },
          failed,
        );
      } catch (error) {
        failed(error instanceof Error ? error.message : String(error));
      }
    });
  }

  /** Lets workers that are there warm up, a few at a time. */
  #warmNext(): void {
    if (!this.#warmUp) return;
    const seats = [...this.#seats].filter(({ ready }) => ready);
    const free = WARM_AT_ONCE - seats.filter(({ warmth }) => warmth === 'warming').length;
    for (const seat of seats.filter(({ warmth }) => warmth === 'cold').slice(0, free)) {
      seat.warmth = 'warming';
      this.#post(seat, { kind: 'warm-up' }, []);
    }
  }

  #restart(seat: Seat): void {
    seat.jobs.clear();
    seat.load = 0;
    this.#start(seat).catch(() => undefined);
  }

  #remove(seat: Seat, why: string): void {
    this.#seats.delete(seat);
    if (this.#seats.size > 0 || this.#destroyed) return;
    this.#fallback = `Hierarchies are built on the calling thread, for no worker could be started: ${why}.`;
    this.#next();
  }

  #crashed(seat: Seat, why: string): void {
    const lost = [...seat.jobs.values()];
    for (const { id } of lost) this.#teams.delete(id);
    this.#restart(seat);
    // Who builds together with a worker that is no more would wait for ever.
    for (const other of this.#seats) {
      if (!lost.some(({ id }) => other.jobs.has(id))) continue;
      other.line?.terminate();
      this.#restart(other);
    }
    for (const job of lost)
      job.settle({
        error: new BvhError(
          'bvh/worker',
          `A worker ended during a build (${why}); the mesh may need more memory than there is.`,
        ),
      });
  }

  #answered(seat: Seat, reply: Exclude<BuildReply, { kind: 'ready' | 'warmed' }>): void {
    const job = seat.jobs.get(reply.id);
    if (!job) return;
    if (reply.kind === 'started') return job.progress(0);
    this.#free(seat, job);
    this.#leave(reply);
    // First the next build, then whatever the caller does with this one.
    this.#next();
    if (reply.kind === 'helped') return;
    if (reply.kind === 'failed') return job.settle({ error: receivedError(reply.error) });
    job.progress(1);
    job.settle(reply.blas);
  }

  /** Keeps what two workers have shared once both are done with it. */
  #leave({ id, kind }: { readonly id: number; readonly kind: BuildReply['kind'] }): void {
    const team = this.#teams.get(id);
    if (!team) return;
    if (kind === 'failed') this.#teams.delete(id);
    else if (!team.half) team.half = true;
    else {
      this.#teams.delete(id);
      this.#spare.leave(team.memory);
    }
  }

  #watch(signal: AbortSignal, job: Job): void {
    let watched = this.#signals.get(signal);
    if (!watched) {
      const jobs = new Set<Job>();
      watched = { jobs, abort: () => jobs.forEach((each) => this.#abort(each, signal.reason)) };
      this.#signals.set(signal, watched);
      signal.addEventListener('abort', watched.abort);
    }
    watched.jobs.add(job);
  }

  #forget(signal: AbortSignal, job: Job): void {
    const watched = this.#signals.get(signal);
    watched?.jobs.delete(job);
    if (!watched || watched.jobs.size > 0) return;
    this.#signals.delete(signal);
    signal.removeEventListener('abort', watched.abort);
  }

  #abort(job: Job, reason: unknown): void {
    job.settle({ error: reason });
    this.#teams.delete(job.id);
    const at = this.#queue.indexOf(job);
    if (at >= 0) this.#queue.splice(at, 1);
    for (const seat of this.#seats) {
      if (!seat.jobs.has(job.id) || seat.jobs.size > 1 || job.triangles < WORTH_ENDING) continue;
      seat.line?.terminate();
      this.#restart(seat);
    }
  }

  /** Gives what waits to the workers that have least to do, or builds it here. */
  #next(): void {
    if (this.#fallback !== undefined) void this.#here.run(this.#queue);
    const seats = seatsWorth(this.#seats, this.#burst);
    for (;;) {
      let free: Seat | undefined;
      for (const seat of seats)
        if ((seat.jobs.size === 0 || seat.load < AHEAD) && seat.load < (free?.load ?? Infinity)) free = seat;
      const job = free && this.#queue.shift();
      if (!free || !job) return;
      const idle = seats.filter(({ jobs }) => jobs.size === 0);
      if (this.#together && idle.length >= 2 && this.#queue.length === 0 && canShare(job))
        this.#sendTogether(idle.slice(0, 2), job);
      else this.#send(free, job);
    }
  }

  #send(seat: Seat, job: Job): void {
    const { id, options, transfer } = job;
    const { positions, indices } = job.mesh;
    const copies: Copy[] = [];
    const sent = <T extends Float32Array | Uint32Array | Uint16Array>(from: T): T => {
      if (!(from.buffer instanceof ArrayBuffer) || (transfer && from.byteLength === from.buffer.byteLength))
        return from;
      const to = roomFor(from);
      copies.push({ from, to });
      return to;
    };
    // A worker that ended meanwhile, or was ended by an abort, has another in its seat.
    const waiting = () => seat.jobs.get(id) === job;
    const attempt = (step: () => unknown) => {
      try {
        return step();
      } catch (error) {
        // What fails: options that cannot be cloned, arrays that are none or were given away.
        if (!waiting()) return;
        this.#free(seat, job);
        job.settle({ error });
      }
    };
    this.#occupy(seat, job);
    attempt(() => {
      const mesh = { positions: sent(positions), indices: indices && sent(indices) };
      const go = () =>
        waiting() &&
        this.#post(
          seat,
          { kind: 'build', id, mesh, options: sendableOptions(options) },
          buffersOf(mesh.positions, mesh.indices),
        );
      const copied = copyAll(copies);
      if (!copied) return go();
      const fail = (error: unknown) =>
        attempt(() => {
          throw error;
        });
      void copied.then(() => attempt(go), fail).then(() => this.#next());
    });
  }

  /** Lets two workers build one mesh. They begin with what is there, while the rest of it is copied. */
  #sendTogether(seats: readonly Seat[], job: Job): void {
    const { id, options } = job;
    let team: ReturnType<typeof teamMemory>;
    for (const seat of seats) this.#occupy(seat, job);
    try {
      team = teamMemory(job.mesh, job.triangles, this.#spare.take());
      const { memory, mesh } = team;
      this.#teams.set(id, { memory, half: false });
      seats.forEach((seat, index) =>
        this.#post(seat, { kind: 'together', id, mesh, options: sendableOptions(options), index, memory }, []),
      );
    } catch {
      // No memory of that kind or not enough: one worker will do. Where the mesh is at fault, it will tell.
      this.#teams.delete(id);
      for (const seat of seats) this.#free(seat, job);
      return this.#send(seats[0] as Seat, job);
    }
    const { memory, copies } = team;
    const fail = (error: unknown) => {
      job.settle({ error });
      release(memory);
    };
    try {
      copyAll(copies, (entries) => tellCopied(memory, entries))?.catch(fail);
    } catch (error) {
      fail(error);
    }
  }

  #occupy(seat: Seat, job: Job): void {
    seat.jobs.set(job.id, job);
    seat.load += job.triangles;
    seat.line?.hold(true);
  }

  #free(seat: Seat, job: Job): void {
    seat.jobs.delete(job.id);
    seat.load -= job.triangles;
    if (seat.jobs.size === 0) seat.line?.hold(false);
  }

  #post(seat: Seat, request: BuildRequest, transfer: readonly ArrayBuffer[]): void {
    seat.line?.post(request, transfer);
  }
}

/** Whether two workers may build it: memory can be shared, it is large, and it is not to be handed over. */
const canShare = ({ triangles, transfer, options: { builder } }: Job) =>
  typeof SharedArrayBuffer === 'function' &&
  triangles >= TOGETHER &&
  !transfer &&
  (builder === undefined || builder === 'balanced');

const destroyed = () =>
  new BvhError('bvh/destroyed', 'The workers were destroyed: create them anew for further builds.');
