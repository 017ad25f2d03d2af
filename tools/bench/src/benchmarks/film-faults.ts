import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { loadModelFile, isModelFile } from '@glanz/formats/node';
import { loadGltfFile } from '@glanz/gltf/node';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { frameCamera, type Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import type { Benchmark, Figure } from '../benchmark';
import { assetFile } from '../equal-time/load';
import { BenchError } from '../error';

interface Asset {
  readonly name: string;
  readonly main: string;
}

function wholeNumber(name: string, text: string | undefined, otherwise: number): number {
  const value = text === undefined ? otherwise : Number(text);
  if (!Number.isInteger(value) || value < 1)
    throw new BenchError('bench/option', `--${name} ${text}: it must be a whole number of at least 1.`);
  return value;
}

/**
 * Counts samples that are NaN, infinite or negative, as the kernel that adds them to the film counts them, over all
 * sample assets.
 */
export const benchmark: Benchmark = {
  description: 'NaN, infinite and negative samples over all sample assets: none',
  options: {
    models: { type: 'string', help: 'only these, by name, separated by commas' },
    size: { type: 'string', help: 'edge of the images, pixels' },
    samples: { type: 'string', help: 'samples per pixel, 64 by default' },
    deadline: { type: 'string', help: 'most seconds for a model' },
  },
  async run({ log, quick, gpu, values }) {
    const index = assetFile('index.json');
    if (index === undefined)
      throw new BenchError(
        'bench/missing-data',
        'film-faults needs the sample assets: set GLANZ_ASSETS to their folder.',
      );
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const size = wholeNumber('size', values['size'], software ? 48 : 512);
    const samples = wholeNumber('samples', values['samples'], quick ? 4 : 64);
    const deadline = 1000 * wholeNumber('deadline', values['deadline'], 600);
    const requested = values['models']?.split(',');
    const assets = (JSON.parse(readFileSync(index, 'utf8')) as readonly Asset[]).filter(
      ({ name, main }) => /\.(glb|gltf|obj|stl)$/i.test(main) && (requested?.includes(name) ?? true),
    );
    const environment = studioEnvironment();
    const notes: string[] = [];
    const faulty: { name: string; bad: number; strange: number }[] = [];
    let device: GPUDevice | undefined;
    let counted = 0;
    let complete = 0;
    let bad = 0;
    let strange = 0;
    for (const { name, main } of assets) {
      const file = join(dirname(index), main);
      let tracer: PathTracer | undefined;
      const start = performance.now();
      try {
        const scene: Scene = isModelFile(file) ? await loadModelFile(file) : await loadGltfFile(file);
        if (!device) {
          device = await requestDevice({ gpu: api });
          void device.lost.then(() => (device = undefined));
        }
        const signal = AbortSignal.timeout(deadline);
        tracer = await PathTracer.create(
          device,
          { ...scene, environment: scene.environment ?? environment },
          { width: size, height: size, camera: frameCamera(scene, { aspect: 1 }), maxDepth: 12, signal },
        );
        for await (const progress of tracer.render({ samples, signal, maxSubmitMs: 200 })) void progress;
        // What is in the film is looked at as well: the kernel's word is not taken for it.
        const beauty = await tracer.read('beauty');
        const here = beauty.reduce((sum, value) => sum + (value >= 0 && value < Infinity ? 0 : 1), 0);
        const found = tracer.statistics.badSamples;
        counted += tracer.samples * size * size;
        bad += found;
        strange += here;
        if (tracer.samples >= samples) complete++;
        else notes.push(`${name}: ${tracer.samples} samples in ${deadline / 1000} s.`);
        if (found + here > 0) faulty.push({ name, bad: found, strange: here });
        log(
          `${name}: ${found} bad samples, ${here} bad numbers in the film, ${tracer.samples} samples, ${((performance.now() - start) / 1000).toFixed(1)} s`,
        );
      } catch (error) {
        notes.push(`${name} left out: ${(error as Error).message.split('\n', 1)[0]}`);
        log(`${name}: left out: ${(error as Error).message.split('\n', 1)[0]}`);
      } finally {
        tracer?.destroy();
      }
    }
    device?.destroy();
    for (const row of faulty)
      notes.push(`${row.name}: ${row.bad} bad samples, ${row.strange} bad numbers in the film.`);
    const one = (name: string, unit: string, mean: number, target?: Figure['target']): Figure => ({
      name,
      unit,
      runs: 1,
      mean,
      ci95: 0,
      ...(target ? { target } : {}),
    });
    const none = { value: 0, relation: '<=', source: 'none at all' } as const;
    return {
      settings: { size, samples, maxDepth: 12 },
      gpu: { name: adapterName, software },
      figures: [
        one('samples that are NaN, infinite or negative', '1', bad, none),
        one('numbers in the film that are', '1', strange, none),
        one('samples looked at', '1', counted),
        one('models with all their samples', `of ${assets.length}`, complete),
      ],
      notes,
    };
  },
};
