const THREADS = 256;
const ITERATIONS = 512;

// Eight chains of four: enough independent operations for any pipeline, in registers alone.
const CODE = /* wgsl */ `
@group(0) @binding(0) var<storage, read_write> result: array<vec4f>;
@compute @workgroup_size(${THREADS}) fn main(@builtin(global_invocation_id) id: vec3u) {
  let a = vec4f(0.999 + 1e-6 * f32(id.x % 7u));
  let b = vec4f(1e-3 * f32(id.x % 5u));
  ${Array.from({ length: 8 }, (_, i) => `var s${i} = vec4f(${i}.0);`).join(' ')}
  for (var i = 0u; i < ${ITERATIONS}u; i++) {
    ${Array.from({ length: 8 }, (_, i) => `s${i} = fma(s${i}, a, b);`).join(' ')}
  }
  result[id.x] = ${Array.from({ length: 8 }, (_, i) => `s${i}`).join(' + ')};
}`;

/**
 * Measures the peak of single-precision arithmetic: multiply-adds on registers.
 *
 * @param clock The GPU's milliseconds of what `work` submits.
 * @returns Operations a second, two a multiply-add; the best of several runs.
 */
export async function measurePeak(
  device: GPUDevice,
  clock: (work: () => Promise<void>) => Promise<number>,
  workgroups: number,
): Promise<number> {
  const buffer = device.createBuffer({ size: workgroups * THREADS * 16, usage: GPUBufferUsage.STORAGE });
  const pipeline = await device.createComputePipelineAsync({
    layout: 'auto',
    compute: { module: device.createShaderModule({ code: CODE }), entryPoint: 'main' },
  });
  const group = device.createBindGroup({
    layout: pipeline.getBindGroupLayout(0),
    entries: [{ binding: 0, resource: { buffer } }],
  });
  let best = Infinity;
  for (let i = 0; i < 6; i++) {
    const milliseconds = await clock(async () => {
      const encoder = device.createCommandEncoder();
      const pass = encoder.beginComputePass();
      pass.setPipeline(pipeline);
      pass.setBindGroup(0, group);
      pass.dispatchWorkgroups(workgroups);
      pass.end();
      device.queue.submit([encoder.finish()]);
      await device.queue.onSubmittedWorkDone();
    });
    best = Math.min(best, milliseconds);
  }
  buffer.destroy();
  return (workgroups * THREADS * ITERATIONS * 8 * 4 * 2) / (best / 1e3);
}
