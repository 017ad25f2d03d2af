import { readFileSync } from 'node:fs';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { expect, it } from 'vitest';
import * as wgsl from '../src';

it("the README's example runs as it stands", async () => {
  const readme = readFileSync(new URL('../README.md', import.meta.url), 'utf8');
  const [, names = '', body = ''] =
    /```ts\nimport \{ ([^}]*) \} from '@glanz\/wgsl';\n([\s\S]*?)```/.exec(readme) ?? [];
  const device = await testDevice();
  const buffer = device.createBuffer({ size: 16, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST });
  // The example is plain JavaScript; it becomes the body of a function whose parameters are its imports.
  const run = new Function(
    'wgsl',
    'device',
    'buffer',
    `return (async () => { const { ${names} } = wgsl;\n${body}\nreturn { module, shader, bytes }; })();`,
  ) as (...args: unknown[]) => Promise<{ module: GPUShaderModule; shader: wgsl.ComposedWgsl; bytes: ArrayBuffer }>;
  const { module, shader, bytes } = await run(wgsl, device, buffer);
  expect(shader.modules).toEqual(['struct/Frame', 'demo/coat', 'demo/shade']);
  expect([...new Uint32Array(bytes, 0, 3), new Float32Array(bytes)[3]]).toEqual([640, 480, 0, 1]);
  await device.createComputePipelineAsync({ layout: 'auto', compute: { module, entryPoint: 'main' } });
  buffer.destroy();
  await expectNoGpuErrors();
});
