import { wgslModule } from '@glanz/wgsl';

/**
 * One thread between the big kernels: turns the queue lengths into the sizes of the next dispatches.
 * `dispatch` holds two indirect records: words 0..2 for intersect and shade, words 4..6 for connect.
 */
const write = /* wgsl */ `
fn schedule_write(at: u32, count: u32) {
  dispatch[at] = (count + 63u) / 64u;
  dispatch[at + 1u] = 1u;
  dispatch[at + 2u] = 1u;
}
`;

export const begin = wgslModule(
  'renderer/begin',
  /* wgsl */ `
${write}
@compute @workgroup_size(1)
fn main() {
  queues.depth = 0u;
  queues.active_count = batch.path_count;
  atomicStore(&queues.next_count, 0u);
  atomicStore(&queues.shadow_count, 0u);
  queues.capacity = arrayLength(&queues.items) / 2u;
  queues.rays += queues.active_count;
  schedule_write(0u, queues.active_count);
  schedule_write(4u, 0u);
}
`,
);

export const advance = wgslModule(
  'renderer/advance',
  /* wgsl */ `
${write}
@compute @workgroup_size(1)
fn main() {
  queues.depth += 1u;
  queues.active_count = atomicExchange(&queues.next_count, 0u);
  queues.shadow_active = atomicExchange(&queues.shadow_count, 0u);
  queues.rays += queues.active_count + queues.shadow_active;
  schedule_write(0u, queues.active_count);
  schedule_write(4u, queues.shadow_active);
}
`,
);
