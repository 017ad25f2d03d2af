import { execFile } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { Worker } from 'node:worker_threads';
import { build } from 'esbuild';
import { tmpdir } from 'node:os';
import { pathToFileURL } from 'node:url';
import { promisify } from 'node:util';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { createGpu, listGpus } from '../../src/node';
import { weslSource } from '../../../../tools/pipeline/wesl.mjs';

const root = join(import.meta.dirname, '../../../..');
const require = createRequire(import.meta.url);
const packaged =
  process.platform === 'linux' &&
  process.arch === 'x64' &&
  existsSync(join(require.resolve('@sparticuz/chromium'), '../../../bin/swiftshader.tar.br'));

// The choice of drivers is a matter of a whole process, so each case runs in one of its own.
let folder: string;
beforeAll(async () => {
  folder = mkdtempSync(join(root, 'node_modules/.glanz-node-'));
  const contents = `import { createGpu } from ${JSON.stringify(join(root, 'packages/renderer/src/node.ts'))};
try {
  const { gpu, adapterName, software } = await createGpu(JSON.parse(process.argv[2]));
  const device = await (await gpu.requestAdapter()).requestDevice();
  const buffer = device.createBuffer({ size: 8, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  device.queue.writeBuffer(buffer, 0, new Uint32Array([41, 42]));
  await buffer.mapAsync(GPUMapMode.READ);
  console.log(JSON.stringify({ adapterName, software, values: [...new Uint32Array(buffer.getMappedRange())] }));
} catch (error) {
  console.log(JSON.stringify({ code: error.code, message: error.message }));
}`;
  await build({
    plugins: [weslSource()],
    stdin: { contents, resolveDir: root },
    bundle: true,
    platform: 'node',
    format: 'esm',
    external: ['webgpu'],
    conditions: ['@glanz/source'],
    outfile: join(folder, 'probe.mjs'),
    logLevel: 'silent',
  });
});
afterAll(() => rmSync(folder, { recursive: true, force: true }));

interface Outcome {
  adapterName?: string;
  software?: boolean;
  values?: number[];
  code?: string;
  message?: string;
}

async function probe(options: object, environment: Record<string, string> = {}): Promise<Outcome> {
  const env = { ...process.env, VK_DRIVER_FILES: undefined, VK_ICD_FILENAMES: undefined, ...environment };
  const { stdout } = await promisify(execFile)(process.execPath, [join(folder, 'probe.mjs'), JSON.stringify(options)], {
    env,
    cwd: root,
  });
  return JSON.parse(stdout) as Outcome;
}

describe('createGpu', () => {
  it('finds a software GPU that works', async () => {
    expect(await probe({ software: 'only' })).toMatchObject({ software: true, values: [41, 42] });
  });

  it.runIf(packaged)(
    'inflates and uses the SwiftShader of the npm package, also when two processes start at once',
    async () => {
      const cache = mkdtempSync(join(tmpdir(), 'glanz-cache-'));
      try {
        for (const outcome of await Promise.all(
          [1, 2].map(() => probe({ gpu: 'swiftshader' }, { XDG_CACHE_HOME: cache })),
        )) {
          expect(outcome).toMatchObject({
            adapterName: expect.stringMatching(/swiftshader/i) as string,
            software: true,
            values: [41, 42],
          });
        }
        expect(readdirSync(join(cache, 'glanz'))).toHaveLength(1);
      } finally {
        rmSync(cache, { recursive: true });
      }
    },
  );

  it('falls back to other drivers when the named one does not work', async () => {
    expect(await probe({}, { VK_DRIVER_FILES: '/nowhere/icd.json' })).toMatchObject({
      software: true,
      values: [41, 42],
    });
  });

  it('says in one line all that it tried, when nothing has the wanted name', async () => {
    const { code, message } = await probe({ gpu: 'voodoo 2' });
    expect(code).toBe('renderer/no-adapter');
    expect(message).toMatch(/No GPU called "voodoo 2".*installed drivers.*lavapipe/);
    expect(message).not.toContain('\n');
  });

  it('does not use a software adapter where the options forbid it', async () => {
    expect(await probe({ software: 'never' }, { VK_DRIVER_FILES: '/nowhere/icd.json' })).toMatchObject({
      code: 'renderer/no-adapter',
    });
  });

  it('names what to install when Dawn does not load', async () => {
    expect(await probe({}, { GPU_WEBGPU: '/nowhere/webgpu.js' })).toMatchObject({
      code: 'renderer/no-webgpu',
      message: expect.stringContaining('/nowhere/webgpu.js') as string,
    });
  });

  it('gives the same object for the same options, also to calls at the same time', async () => {
    const [a, b] = await Promise.all([createGpu({ software: 'only' }), createGpu({ software: 'only' })]);
    expect(a.gpu).toBe(b.gpu);
    const listed = await listGpus();
    expect(listed.some((gpu) => gpu.software && gpu.name === a.adapterName)).toBe(true);
  });

  it('enables toggles of Dawn', async () => {
    const featuresOf = async (options: { readonly toggles?: readonly string[] }) => {
      const { gpu } = await createGpu({ software: 'only', ...options });
      return [...(await gpu.requestAdapter())!.features];
    };
    const [usual, unsafe] = [await featuresOf({}), await featuresOf({ toggles: ['allow_unsafe_apis'] })];
    expect(usual.filter((feature) => feature.startsWith('chromium-experimental'))).toEqual([]);
    expect(unsafe.filter((feature) => feature.startsWith('chromium-experimental'))).not.toEqual([]);
  });

  it('gives devices that clear the memory of workgroups', async () => {
    const { gpu } = await createGpu({ software: 'only' });
    const device = await (await gpu.requestAdapter())!.requestDevice();
    // Each group looks whether its memory is clear and fills it, for groups that get the same memory after it.
    const code = `var<workgroup> memory: array<array<vec4u, 16>, 64>;
@group(0) @binding(0) var<storage, read_write> dirty: atomic<u32>;
@compute @workgroup_size(64) fn main(@builtin(local_invocation_index) i: u32) {
  for (var k = 0u; k < 16u; k++) {
    if (any(memory[i][k] != vec4u(0u))) { atomicAdd(&dirty, 1u); }
    memory[i][k] = vec4u(7u);
  }
}`;
    const pipeline = device.createComputePipeline({
      layout: 'auto',
      compute: { module: device.createShaderModule({ code }) },
    });
    const dirty = device.createBuffer({ size: 4, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
    const copy = device.createBuffer({ size: 4, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    const layout = pipeline.getBindGroupLayout(0);
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout, entries: [{ binding: 0, resource: { buffer: dirty } }] }));
    pass.dispatchWorkgroups(64);
    pass.end();
    encoder.copyBufferToBuffer(dirty, 0, copy, 0, 4);
    device.queue.submit([encoder.finish()]);
    await copy.mapAsync(GPUMapMode.READ);
    expect(new Uint32Array(copy.getMappedRange())[0]).toBe(0);
    device.destroy();
  });

  it('does nothing on import, in a worker thread too', async () => {
    const url = pathToFileURL(join(folder, 'import-only.mjs')).href;
    await build({
      plugins: [weslSource()],
      entryPoints: [join(root, 'packages/renderer/src/node.ts')],
      bundle: true,
      platform: 'node',
      format: 'esm',
      external: ['webgpu'],
      conditions: ['@glanz/source'],
      outfile: join(folder, 'import-only.mjs'),
      logLevel: 'silent',
    });
    const worker = new Worker(
      `import(${JSON.stringify(url)}).then((m) => require('node:worker_threads').parentPort.postMessage([Object.keys(m).length, 'GPUBufferUsage' in globalThis, process.env.VK_DRIVER_FILES]))`,
      { eval: true, stdout: true, stderr: true },
    );
    const [exports, defined] = await new Promise<unknown[]>((resolve, reject) =>
      worker.once('message', resolve).once('error', reject),
    );
    expect(exports).toBeGreaterThan(1);
    expect(defined).toBe(false);
  });
});
