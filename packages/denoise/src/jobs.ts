/** Dispatches of one shader with one set of bindings, which can be cut by rows of workgroups. */
export interface Job {
  /** For GPU debuggers and profilers. */
  readonly name: string;
  readonly pipeline: GPUComputePipeline;
  readonly group: GPUBindGroup;
  /** Workgroups along x and z; along y for each row. */
  readonly x: number;
  readonly yOfRow: number;
  readonly z: number;
  readonly fromRow: number;
  readonly toRow: number;
  /** Multiply-adds, or what takes as long, of a row. */
  readonly costOfRow: number;
  /** Dynamic offsets, by the first row; in the order of the bindings. */
  readonly offsets: (firstRow: number) => readonly number[];
}

/** Total cost. */
export const costOf = (jobs: readonly Job[]): number =>
  jobs.reduce((sum, job) => sum + (job.toRow - job.fromRow) * job.costOfRow, 0);

/** Walks through jobs in pieces of a given cost. */
export class JobCursor {
  readonly #jobs: readonly Job[];
  #job = 0;
  #row: number;

  constructor(jobs: readonly Job[]) {
    this.#jobs = jobs;
    this.#row = jobs[0]?.fromRow ?? 0;
  }

  /** Whether nothing is left. */
  get done(): boolean {
    return this.#job >= this.#jobs.length;
  }

  /**
   * Records dispatches that cost about `work`, at least one row.
   *
   * @returns What they cost.
   */
  encode(pass: GPUComputePassEncoder, work: number): number {
    let spent = 0;
    while (!this.done && (spent === 0 || spent < work)) {
      const job = this.#jobs[this.#job]!;
      const affordable = Math.floor((work - spent) / job.costOfRow);
      if (spent > 0 && affordable < 1) break;
      const rows = Math.min(job.toRow - this.#row, Math.max(1, affordable));
      pass.pushDebugGroup(job.name);
      pass.setPipeline(job.pipeline);
      pass.setBindGroup(0, job.group, job.offsets(this.#row) as number[]);
      pass.dispatchWorkgroups(job.x, rows * job.yOfRow, job.z);
      pass.popDebugGroup();
      spent += rows * job.costOfRow;
      this.#row += rows;
      if (this.#row < job.toRow) continue;
      this.#job++;
      this.#row = this.#jobs[this.#job]?.fromRow ?? 0;
    }
    return spent;
  }
}
