import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { loadGltfFile } from '@glanz/gltf/node';
import { decodeExr } from '@glanz/image';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { frameCamera } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { expect, it } from 'vitest';
import { runCli } from '../src/index';
import { fakeIo, temporaryFolder } from './fakes';
import { makeGlb } from './glb';

const SIZE = [20, 16] as const,
  SAMPLES = 9,
  SEED = 5,
  DEPTH = 4;
const VARIANTS = ['red', 'green', 'deep blue'],
  VIEWS = [
    [30, 20],
    [0, 5],
    [-70, 40],
    [10, -30],
  ] as const;

/**
 * Adds samples until there are so many, with interruptions, as the loop of a viewer does whenever something happens.
 */
async function refine(tracer: PathTracer, samples: number, stops: number): Promise<void> {
  for (let stop = 0; stop < stops && tracer.samples < samples - 1; stop++) {
    const interrupt = new AbortController();
    try {
      for await (const { samples: done } of tracer.render({ samples, signal: interrupt.signal, maxSubmitMs: 1 }))
        if (done > stop) interrupt.abort();
    } catch (error) {
      if (!interrupt.signal.aborted) throw error;
    }
  }
  for await (const _ of tracer.render({ samples, maxSubmitMs: 2 }));
}

it(
  "three variants from four views by one command: bit for bit the film that a viewer's tracer comes to",
  { timeout: 300_000 },
  async () => {
    const folder = temporaryFolder({ 'm.glb': makeGlb({ camera: true, variants: true }) });
    const io = fakeIo(folder);
    io.time = 0;
    const argv = [
      'render',
      'm.glb',
      '-o',
      '{variant}/{view}.exr',
      '--bits',
      '32',
      '--variant',
      'all',
      ...VIEWS.flatMap(([azimuth, elevation]) => [`--view=${azimuth},${elevation}`]),
    ];
    const code = await runCli(
      [
        ...argv,
        '--size',
        SIZE.join('x'),
        '--samples',
        String(SAMPLES),
        '--seed',
        String(SEED),
        '--max-depth',
        String(DEPTH),
        '--gpu',
        'software',
        '--json',
      ],
      io,
    );
    expect(code, io.err.join('')).toBe(0);
    const { images } = JSON.parse(io.out.join('')) as {
      images: { variant: string; view: string; files: { path: string }[] }[];
    };
    expect(images.length).toBe(VARIANTS.length * VIEWS.length);

    const { gpu } = await createGpu({ software: 'only' });
    const device = await requestDevice({ gpu });
    const scene = await loadGltfFile(join(folder, 'm.glb'));
    const [width, height] = SIZE;
    const camera = ([azimuth, elevation]: readonly [number, number]) => {
      const [a, e] = [(azimuth * Math.PI) / 180, (elevation * Math.PI) / 180];
      return frameCamera(scene, {
        aspect: width / height,
        direction: [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)],
      });
    };
    // Another view and another size come first, as while the user turns the model.
    const tracer = await PathTracer.create(
      device,
      { ...scene, environment: studioEnvironment() },
      { width: 5, height: 4, maxDepth: DEPTH, seed: SEED, camera: camera([45, 45]) },
    );
    await refine(tracer, 2, 0);
    const different = new Set<string>();
    let stops = 0;
    // The other way round than the command, so that nothing can have been left over in the same order.
    for (const [v, view] of [...VIEWS.entries()].reverse()) {
      for (const variant of [...VARIANTS].reverse()) {
        await tracer.setCamera(camera(view));
        await tracer.setVariant(variant);
        await tracer.resize(5, 4);
        await refine(tracer, 1, 0);
        await tracer.resize(width, height);
        await refine(tracer, SAMPLES, stops++ % 4);
        expect(tracer.samples).toBe(SAMPLES);
        const film = await tracer.read('beauty');
        const file = images.find((one) => one.variant === variant && one.view === images[v]!.view)!.files[0]!.path;
        const { channels } = decodeExr(new Uint8Array(readFileSync(join(folder, file))));
        const written = [0, 1, 2].map((c) => channels.get('RGB'[c]!)!.data);
        const shown = [0, 1, 2].map((c) => Float32Array.from({ length: width * height }, (_, i) => film[4 * i + c]!));
        for (const c of [0, 1, 2])
          expect(
            Buffer.compare(Buffer.from(Float32Array.from(written[c]!).buffer), Buffer.from(shown[c]!.buffer)),
            `${file}, channel ${c}`,
          ).toBe(0);
        different.add(shown.map((plane) => plane.join()).join());
      }
    }
    // Twelve images that differ: nothing was compared with itself.
    expect(different.size).toBe(12);
    tracer.destroy();
    device.destroy();
  },
);
