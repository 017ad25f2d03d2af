import { compose, wgslModule } from '@glanz/wgsl';
import guide from '../src/guiding/guide.wesl';
import { readFloats } from '../src/storage/read-buffer';

/** In place of the environment's functions, which the guide to panes calls: one that is evenly bright. */
const EVEN = `
fn environment_pdf(direction: vec3f) -> f32 { return 0.07957747154594767; }
fn environment_sample(u: vec2f) -> vec3f {
  let z = 1.0 - 2.0 * u.x;
  let around = 6.283185307179586 * u.y;
  return vec3f(sqrt(max(1.0 - z * z, 0.0)) * vec2f(cos(around), sin(around)), z);
}`;

/**
 * Draws directions from a guide's table, at points spread evenly over the square of random numbers. Of each eight
 * numbers: a direction and its density; the density of another one, spread evenly over the sphere; the share of
 * directions that the guide chooses at (0.25, 9, −9), where these are drawn, and at (0.2, 0, 0); the direction's length.
 *
 * @param draws A power of two.
 */
export async function drawGuide(
  device: GPUDevice,
  {
    table,
    width,
    draws,
    panes,
  }: {
    readonly table: Float32Array<ArrayBuffer>;
    readonly width: number;
    readonly draws: number;
    readonly panes: boolean;
  },
): Promise<Float32Array> {
  const size: [number, number] = [width, table.length / width];
  const texture = device.createTexture({ size, format: 'r32float', usage: 0x6 });
  device.queue.writeTexture({ texture }, table, { bytesPerRow: 4 * width }, size);
  const result = device.createBuffer({ size: 32 * draws, usage: 0x84 });
  const main = wgslModule(
    'test/guide',
    `@group(0) @binding(0) var guide: texture_2d<f32>;
@group(0) @binding(1) var<storage, read_write> result: array<vec4f>;
${panes ? EVEN : ''}
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  let place = guide_find(vec3f(0.25, 9.0, -9.0));
  let u = vec2f(f32(id.x) + 0.5, f32(reverseBits(id.x) >> 8u) * ${draws / 2 ** 24}) / ${draws}.0;
  let direction = guide_sample(place, vec2f(u.x * guide_share(place), u.y));
  result[2u * id.x] = vec4f(direction, guide_pdf(place, direction));
  let around = 6.283185307179586 * u.y;
  let z = 2.0 * u.x - 1.0;
  let even = vec3f(sqrt(1.0 - z * z) * vec2f(cos(around), sin(around)), z);
  result[2u * id.x + 1u] = vec4f(guide_pdf(place, even), guide_share(place),
    guide_share(guide_find(vec3f(0.2, 0.0, 0.0))), length(direction));
}`,
    [guide],
  );
  const { code } = compose([main], { flags: { PANES: panes } });
  const pipeline = await device.createComputePipelineAsync({
    layout: 'auto',
    compute: { module: device.createShaderModule({ code }), entryPoint: 'main' },
  });
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  const resources = [texture.createView(), { buffer: result }];
  const entries = resources.map((resource, binding) => ({ binding, resource }));
  pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
  pass.dispatchWorkgroups(draws / 64);
  pass.end();
  device.queue.submit([encoder.finish()]);
  const found = await readFloats(device, result);
  result.destroy();
  texture.destroy();
  return found;
}
