import { readFileSync } from 'node:fs';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import * as wgsl from '@glanz/wgsl';
import { expect, it } from 'vitest';
import { prepareBsdf, sampleBsdf } from '../src/cpu/index';
import * as main from '../src/index';
import { OPENPBR_TABLES, type OpenPbrTable } from '../src/tables/index';

/** The bits of a half float, rounded towards zero; for numbers from 0 to 2. */
function half(value: number): number {
  const bits = new Uint32Array(new Float32Array([value]).buffer)[0] as number;
  const exponent = (bits >>> 23) - 112;
  return exponent <= 0 ? 0 : (exponent << 10) | ((bits >>> 13) & 0x3ff);
}

it("the README's example runs as it stands, with tables in half floats", async () => {
  const readme = readFileSync(new URL('../README.md', import.meta.url), 'utf8');
  const [, ours = '', theirs = '', body = ''] =
    /```ts\nimport \{ ([^}]*) \} from '@glanz\/openpbr';\nimport \{ ([^}]*) \} from '@glanz\/wgsl';\n([\s\S]*?)```/.exec(
      readme,
    ) ?? [];
  // The example is plain JavaScript; it becomes the body of a function whose parameters are its imports.
  const run = new Function(
    'main',
    'wgsl',
    `const { ${ours} } = main; const { ${theirs} } = wgsl;\n${body}\nreturn { shader, material, gold };`,
  ) as (...modules: unknown[]) => { shader: wgsl.ComposedWgsl; material: ArrayBuffer; gold: main.OpenPbrParameters };
  const { shader, material, gold } = run(main, wgsl);
  expect(shader.modules).toContain('openpbr/metal');
  expect(shader.modules).not.toContain('openpbr/eon');

  const device = await testDevice();
  const pipeline = await device.createComputePipelineAsync({
    layout: 'auto',
    compute: { module: await wgsl.createShaderModule(device, shader, 'readme'), entryPoint: 'main' },
  });
  const texture = ({ width, height, depth, data }: OpenPbrTable, dimension: GPUTextureDimension): GPUTexture => {
    const made = device.createTexture({
      size: [width, height, depth],
      dimension,
      format: 'r16float',
      usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
    });
    device.queue.writeTexture(
      { texture: made },
      Uint16Array.from(data, half),
      { bytesPerRow: width * 2, rowsPerImage: height },
      [width, height, depth],
    );
    return made;
  };
  const storage = device.createBuffer({
    size: material.byteLength,
    usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST,
  });
  device.queue.writeBuffer(storage, 0, material);
  const result = device.createBuffer({ size: 16, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
  const staging = device.createBuffer({ size: 16, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  // A metal reads the conductor's table only: what the shader does not use is not in its layout.
  const conductor = texture(OPENPBR_TABLES.conductor, '2d');
  const entries: GPUBindGroupEntry[] = [
    { binding: 0, resource: { buffer: storage } },
    { binding: 1, resource: { buffer: result } },
    { binding: 3, resource: conductor.createView() },
    { binding: 4, resource: device.createSampler({ minFilter: 'linear', magFilter: 'linear' }) },
  ];
  const encoder = device.createCommandEncoder();
  const pass = encoder.beginComputePass();
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
  pass.dispatchWorkgroups(1);
  pass.end();
  encoder.copyBufferToBuffer(result, 0, staging, 0, 16);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(GPUMapMode.READ);
  const [r, g, b, pdf] = new Float32Array(staging.getMappedRange().slice(0)) as unknown as [
    number,
    number,
    number,
    number,
  ];
  const length = Math.hypot(0.3, 0.9);
  const wo = [0.3 / length, 0, 0.9 / length] as const;
  const expected = sampleBsdf(prepareBsdf(gold, wo), wo, [0.1, 0.2, 0.3]);
  // Filters of textures have 8 bits of fraction.
  [r, g, b, pdf].forEach((value, i) =>
    expect(Math.abs(value / ([...expected.weight, expected.pdf][i] as number) - 1)).toBeLessThan(3e-3),
  );
  for (const thing of [storage, result, staging, conductor]) thing.destroy();
  await expectNoGpuErrors();
});
