import type { Blas } from '../blas';
import type { TriangleMesh } from '../layout';
import { BvhError } from '../error';
import { copyAll, allocateLike, type Copy } from './copy';
import { CallingThreadBuilds, type Job } from './calling-thread';
import { connect, hardwareThreads, startWorker, type NodeWorkerLike, type WebWorkerLike } from './connection';
import type { BvhWorkersOptions, WorkerBuildOptions } from './options';
import { buffersOf, receivedError, sendableOptions, type BuildReply, type BuildRequest } from './protocol';
import { usableSlots, type WorkerSlot } from './slot';
import { Retained } from './retained';
import { release, teamMemory, reportCopied, type TeamMemory } from './team';

export type { NodeWorkerLike, WebWorkerLike } from './connection';
export type { BvhWorkersOptions, WorkerBuildOptions } from './options';

/** Workers that warm up at a time: the calling thread is busy too, and all share the compiler threads. */
const WARM_AT_ONCE = 2;

/** Small builds are queued in a worker up to this many triangles, so that it does not wait for the next message. */
const AHEAD = 16_384;

/**
 * Triangles from which on two workers build a mesh together, where no other build is queued and they can share memory.
 */
const TOGETHER = 200_000;

/** Threads of a machine from which on a second worker for the same mesh slows nothing else down. */
const TOGETHER_MIN_THREADS = 4;

/** An aborted build of at least this many triangles ends its worker; a smaller one runs on and is ignored. */
const TERMINATE_TRIANGLES = 100_000;

/** Time limit for the start of a worker. */
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
  readonly #slots: Set<WorkerSlot>;
  readonly #queue: Job[] = [];
  readonly #callingThread = new CallingThreadBuilds();
  /** Builds by signal: one listener serves them all, however many meshes share a signal. */
  readonly #signals = new Map<AbortSignal, { readonly jobs: Set<Job>; readonly abort: () => void }>();
  /** Shared memory by build, and whether one of the two workers is done with it. */
  readonly #teams = new Map<number, { readonly memory: TeamMemory; half: boolean }>();
  /** Shared memory of the last such build. */
  readonly #retained = new Retained<TeamMemory>();
  #fallback: string | undefined;
  #nextId = 0;
  /** Triangles of all builds requested since the pool was last idle. */
  #burst = 0;
  /** Whether the distribution of builds is scheduled. */
  #scheduled = false;
  #destroyed = false;

  private constructor(
    count: number,
    {
      createWorker = startWorker,
      warmUp = false,
      together = hardwareThreads() >= TOGETHER_MIN_THREADS,
    }: BvhWorkersOptions,
  ) {
    this.#together = together;
    this.#createWorker = createWorker;
    this.#warmUp = warmUp;
    this.#slots = new Set(
      Array.from({ length: count }, () => ({
        connection: undefined,
        ready: false,
        timer: undefined,
        jobs: new Map<number, Job>(),
        load: 0,
        warmth: 'cold',
      })),
    );
  }

  /**
   * Starts the workers. Resolves as soon as one is ready, or with {@link fallback} set if none can be started,
   * which is no error.
   *
   * @throws {BvhError} `bvh/options` for a count that is not a positive integer.
   */
  static async create(options: BvhWorkersOptions = {}): Promise<BvhWorkers> {
    const count = options.count ?? Math.max(1, Math.min(8, hardwareThreads()));
    if (!(Number.isInteger(count) && count >= 1))
      throw new BvhError('bvh/options', `count is ${count}; it must be an integer of at least 1.`);
    const workers = new BvhWorkers(count, options);
    await Promise.any([...workers.#slots].map((slot) => workers.#start(slot))).catch(() => undefined);
    return workers;
  }

  /** Number of workers, including those that are starting; 0 if builds run on the calling thread. */
  get count(): number {
    return this.#slots.size;
  }

  /** Why builds run on the calling thread; undefined where workers do them. */
  get fallback(): string | undefined {
    return this.#fallback;
  }

  /**
   * Builds the hierarchy of a mesh: the same as `buildBlas(mesh, options)`, bit for bit. Builds start in the
   * order of the calls. The mesh is read when its build starts, so it must not change until the promise settles.
   *
   * @throws {BvhError} as `buildBlas` does; `bvh/worker` if the worker ends during the build, for example out of
   * memory; `bvh/destroyed` after or during {@link destroy}.
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
      if (this.#queue.length === 0 && [...this.#slots].every(({ jobs }) => jobs.size === 0)) this.#burst = 0;
      this.#queue.push(job);
      this.#burst += job.triangles;
      // Wait until all of a scene's builds are requested, to decide how many workers are worth using.
      if (this.#scheduled) return;
      this.#scheduled = true;
      queueMicrotask(() => {
        this.#scheduled = false;
        this.#next();
      });
    });
  }

  /** Ends all workers. Builds that are not done reject with `bvh/destroyed`. */
  destroy(): void {
    this.#destroyed = true;
    this.#retained.clear();
    for (const slot of this.#slots) {
      clearTimeout(slot.timer);
      slot.connection?.terminate();
      for (const job of slot.jobs.values()) job.settle({ error: destroyed() });
      slot.jobs.clear();
    }
    this.#slots.clear();
    for (const job of this.#queue.splice(0)) job.settle({ error: destroyed() });
  }

  /** Starts the worker of a slot. If that fails, rejects and removes the slot. */
  #start(slot: WorkerSlot): Promise<void> {
    return new Promise<void>((resolve, reject) => {
      slot.ready = false;
      slot.warmth = 'cold';
      slot.connection = undefined;
      const failed = (why: string) => {
        clearTimeout(slot.timer);
        if (slot.ready) this.#crashed(slot, why);
        else this.#remove(slot, why);
        reject(new BvhError('bvh/worker', why));
      };
      slot.timer = setTimeout(() => {
        slot.connection?.terminate();
        failed(`no worker has started within ${START_MS / 1000} s`);
      }, START_MS);
      try {
        slot.connection = connect(
          this.#createWorker(),
          (message) => {
            const reply = message as BuildReply;
            if (reply.kind === 'warmed') {
              slot.warmth = 'warm';
              return this.#warmNext();
            }
            if (reply.kind !== 'ready') return this.#answered(slot, reply);
            clearTimeout(slot.timer);
            slot.ready = true;
            this.#warmNext();
            slot.connection?.hold(false);
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

  /** Lets ready workers warm up, a few at a time. */
  #warmNext(): void {
    if (!this.#warmUp) return;
    const slots = [...this.#slots].filter(({ ready }) => ready);
    const free = WARM_AT_ONCE - slots.filter(({ warmth }) => warmth === 'warming').length;
    for (const slot of slots.filter(({ warmth }) => warmth === 'cold').slice(0, free)) {
      slot.warmth = 'warming';
      this.#post(slot, { kind: 'warm-up' }, []);
    }
  }

  #restart(slot: WorkerSlot): void {
    slot.jobs.clear();
    slot.load = 0;
    this.#start(slot).catch(() => undefined);
  }

  #remove(slot: WorkerSlot, why: string): void {
    this.#slots.delete(slot);
    if (this.#slots.size > 0 || this.#destroyed) return;
    this.#fallback = `Hierarchies are built on the calling thread, because no worker could be started: ${why}.`;
    this.#next();
  }

  #crashed(slot: WorkerSlot, why: string): void {
    const lost = [...slot.jobs.values()];
    for (const { id } of lost) this.#teams.delete(id);
    this.#restart(slot);
    // A worker that builds together with an ended one would wait for ever.
    for (const other of this.#slots) {
      if (!lost.some(({ id }) => other.jobs.has(id))) continue;
      other.connection?.terminate();
      this.#restart(other);
    }
    for (const job of lost)
      job.settle({
        error: new BvhError(
          'bvh/worker',
          `A worker ended during a build (${why}); the mesh may need more memory than is available.`,
        ),
      });
  }

  #answered(slot: WorkerSlot, reply: Exclude<BuildReply, { kind: 'ready' | 'warmed' }>): void {
    const job = slot.jobs.get(reply.id);
    if (!job) return;
    if (reply.kind === 'started') return job.progress(0);
    this.#free(slot, job);
    this.#retain(reply);
    // Start the next build before the caller's code runs.
    this.#next();
    if (reply.kind === 'helped') return;
    if (reply.kind === 'failed') return job.settle({ error: receivedError(reply.error) });
    job.progress(1);
    job.settle(reply.blas);
  }

  /** Keeps the memory that two workers have shared once both are done with it. */
  #retain({ id, kind }: { readonly id: number; readonly kind: BuildReply['kind'] }): void {
    const team = this.#teams.get(id);
    if (!team) return;
    if (kind === 'failed') this.#teams.delete(id);
    else if (!team.half) team.half = true;
    else {
      this.#teams.delete(id);
      this.#retained.keep(team.memory);
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
    for (const slot of this.#slots) {
      if (!slot.jobs.has(job.id) || slot.jobs.size > 1 || job.triangles < TERMINATE_TRIANGLES) continue;
      slot.connection?.terminate();
      this.#restart(slot);
    }
  }

  /** Sends queued builds to the least loaded workers, or builds them on the calling thread. */
  #next(): void {
    if (this.#fallback !== undefined) void this.#callingThread.run(this.#queue);
    const slots = usableSlots(this.#slots, this.#burst);
    for (;;) {
      let free: WorkerSlot | undefined;
      for (const slot of slots)
        if ((slot.jobs.size === 0 || slot.load < AHEAD) && slot.load < (free?.load ?? Infinity)) free = slot;
      const job = free && this.#queue.shift();
      if (!free || !job) return;
      const idle = slots.filter(({ jobs }) => jobs.size === 0);
      if (this.#together && idle.length >= 2 && this.#queue.length === 0 && canShare(job))
        this.#sendTogether(idle.slice(0, 2), job);
      else this.#send(free, job);
    }
  }

  #send(slot: WorkerSlot, job: Job): void {
    const { id, options, transfer } = job;
    const { positions, indices } = job.mesh;
    const copies: Copy[] = [];
    const sent = <T extends Float32Array | Uint32Array | Uint16Array>(from: T): T => {
      if (!(from.buffer instanceof ArrayBuffer) || (transfer && from.byteLength === from.buffer.byteLength))
        return from;
      const to = allocateLike(from);
      copies.push({ from, to });
      return to;
    };
    // A worker that ended meanwhile, or was ended by an abort, has been replaced in its slot.
    const waiting = () => slot.jobs.get(id) === job;
    const attempt = (step: () => unknown) => {
      try {
        return step();
      } catch (error) {
        // Causes: options that cannot be cloned, detached arrays, values that are no arrays.
        if (!waiting()) return;
        this.#free(slot, job);
        job.settle({ error });
      }
    };
    this.#occupy(slot, job);
    attempt(() => {
      const mesh = { positions: sent(positions), indices: indices && sent(indices) };
      const go = () =>
        waiting() &&
        this.#post(
          slot,
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

  /** Lets two workers build one mesh. They start on the copied part while the rest is being copied. */
  #sendTogether(slots: readonly WorkerSlot[], job: Job): void {
    const { id, options } = job;
    let team: ReturnType<typeof teamMemory>;
    for (const slot of slots) this.#occupy(slot, job);
    try {
      team = teamMemory(job.mesh, job.triangles, this.#retained.take());
      const { memory, mesh } = team;
      this.#teams.set(id, { memory, half: false });
      slots.forEach((slot, index) =>
        this.#post(slot, { kind: 'together', id, mesh, options: sendableOptions(options), index, memory }, []),
      );
    } catch {
      // Shared memory is unavailable or insufficient: use one worker. If the mesh is at fault, its build reports that.
      this.#teams.delete(id);
      for (const slot of slots) this.#free(slot, job);
      return this.#send(slots[0] as WorkerSlot, job);
    }
    const { memory, copies } = team;
    const fail = (error: unknown) => {
      job.settle({ error });
      release(memory);
    };
    try {
      copyAll(copies, (entries) => reportCopied(memory, entries))?.catch(fail);
    } catch (error) {
      fail(error);
    }
  }

  #occupy(slot: WorkerSlot, job: Job): void {
    slot.jobs.set(job.id, job);
    slot.load += job.triangles;
    slot.connection?.hold(true);
  }

  #free(slot: WorkerSlot, job: Job): void {
    slot.jobs.delete(job.id);
    slot.load -= job.triangles;
    if (slot.jobs.size === 0) slot.connection?.hold(false);
  }

  #post(slot: WorkerSlot, request: BuildRequest, transfer: readonly ArrayBuffer[]): void {
    slot.connection?.post(request, transfer);
  }
}

/** Whether two workers may build it: memory can be shared, it is large, and it is not transferred. */
const canShare = ({ triangles, transfer, options: { builder } }: Job) =>
  typeof SharedArrayBuffer === 'function' &&
  triangles >= TOGETHER &&
  !transfer &&
  (builder === undefined || builder === 'balanced');

const destroyed = () => new BvhError('bvh/destroyed', 'The workers were destroyed: call BvhWorkers.create() again.');
