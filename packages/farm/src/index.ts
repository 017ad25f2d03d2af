export { FarmError } from './error';
export { canonicalJson, contentId } from './identity';
export type { Destination, FarmJob, FarmJobKind, FarmRequest, JobResult, ResultFile } from './job';
export type { BundleFile, Cleaned, FarmStore, StoreAddress } from './store/store';
export { FolderStore } from './store/folder-store';
export { S3Store } from './store/s3/s3-store';
export { importS3, type S3Answer, type S3Module } from './store/s3/s3-module';
export { openFarmStore } from './store/open-store';
export { FarmQueue, openFarmQueue, type DeadLetter, type FarmQueueOptions, type Submission } from './queue/farm-queue';
export type { QueueKeys } from './queue/keys';
export {
  importQueueModules,
  type BullQueue,
  type BullWorker,
  type QueuedJob,
  type QueueModules,
  type RedisClient,
} from './queue/redis';
export type { FarmStatus, WorkerState } from './queue/status';
export { FarmWorker, type FarmWorkerOptions, type WorkerEvent } from './worker/farm-worker';
export { startFarmWorker } from './worker/start-worker';
export { MAX_TRIES, pauseAfter, verdictOn, type Tries, type Verdict } from './worker/failure-policy';
export {
  RendererProcess,
  RenderFailure,
  type FromRenderer,
  type RenderEnd,
  type RendererFailure,
  type RendererProcessOptions,
  type ToRenderer,
} from './worker/renderer-process';
export { serveRenderer, type JobRenderer } from './worker/serve-renderer';
export { farmMetrics } from './metrics';
export { acceptsHost } from './serve/loopback-host';
export { statusServer, type StatusServer } from './serve/status-server';
