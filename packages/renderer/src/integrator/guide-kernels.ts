import guideBegin from './guide_begin.wesl';
import guideGather from './guide_gather.wesl';
import guideStart from './guide_start.wesl';
import guidedClosure from './guided_closure.wesl';
import type { KernelParts } from './pipelines';

/** Parts of kernels that guides need. Loaded where one is requested. */
export const GUIDED_SHADE: KernelParts = { host: [guidedClosure] };

/** The kernels that differ while a guide is trained, in place of those of these names. */
export const TRAINING_KERNELS = {
  begin: { root: guideBegin },
  generate: { root: guideStart, resources: ['frame', 'batch', 'paths', 'queues', 'guide_points'] },
  resolve: { root: guideGather, resources: ['batch', 'paths', 'beauty'] },
} as const satisfies Record<string, KernelParts>;
