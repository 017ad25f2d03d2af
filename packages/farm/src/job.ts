/** What a job does: renders an image, renders some of its samples, or merges these. */
export type FarmJobKind = 'image' | 'part' | 'merge';

/** A job as the queue holds it: plain data, some hundred bytes. */
export interface FarmJob {
  /** By content, see `contentId`: the same work has the same id. */
  readonly id: string;
  readonly kind: FarmJobKind;
  /** For people, such as `shoe · red · front`. */
  readonly label: string;
  /** What the renderer's process gets. */
  readonly payload: unknown;
  /** Of a merge: the jobs whose results it needs. */
  readonly parts?: readonly string[];
  /** Of a part: the merge that is due when all parts are done. */
  readonly merge?: FarmJob;
}

/** Where the files of a result are copied to. */
export interface Destination {
  /** The folder below which the paths lie. */
  readonly root: string;
  /** Relative to the root, one for each file of the result. */
  readonly paths: readonly string[];
}

/** A job with what is to become of its result. */
export interface FarmRequest {
  readonly job: FarmJob;
  /** Absent: the result stays in the store. */
  readonly destination?: Destination;
}

/** A file of a result. */
export interface ResultFile {
  readonly name: string;
  readonly bytes: number;
  readonly sha256: string;
}

/** The record of a finished job in the store, in addition to its files. */
export interface JobResult {
  readonly id: string;
  readonly label: string;
  readonly files: readonly ResultFile[];
  /** How long rendering took, of the attempt that finished it. */
  readonly seconds: number;
  /** The worker that finished it. */
  readonly worker: string;
  /** ISO 8601. */
  readonly finished: string;
  /** Information from the renderer's process. */
  readonly info?: unknown;
}
