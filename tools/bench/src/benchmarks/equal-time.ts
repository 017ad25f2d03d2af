import type { Benchmark } from '../benchmark';
import { BenchError } from '../error';

/** Equal-time error against other renderers. */
export const benchmark: Benchmark = {
  description: 'error at equal time against other renderers (not built yet)',
  run: () =>
    Promise.reject(
      new BenchError('bench/not-available', 'equal-time does not exist yet: it needs high-sample references and adapters for the other renderers. What there is: groundtruth (error per sample against references), paper-gpu (time per sample), bvh, paper-cpu, furnace.'),
    ),
};
