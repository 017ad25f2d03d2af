import { isModelFile, loadModelFile } from '@glanz/formats/node';
import { loadGltfFile } from '@glanz/gltf/node';
import { encodePng } from '@glanz/image/png';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { frameCamera, validateScene, type Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { toneMapPixels } from '@glanz/tonemap';
import type { Model } from './models';

/** What became of a model. */
export interface Row {
  readonly name: string;
  readonly id: string;
  readonly note: string;
  readonly error?: string;
  readonly warnings: readonly string[];
  readonly triangles: number;
  readonly instances: number;
  /** Mean of the image's display codes, 0..1; images that came out black or white show in it. */
  readonly mean: number;
  readonly badSamples: number;
  readonly loadMs: number;
  readonly prepareMs: number;
  readonly renderMs: number;
}

/** Time limit of one model. */
const LIMIT_MS = 300_000;

/** A GPU that renders one model after the other. A device that is lost is replaced. */
export async function openRenderer({
  size,
  samples,
  gpu: name,
}: {
  readonly size: number;
  readonly samples: number;
  readonly gpu?: string;
}) {
  const { gpu } = await createGpu(name === undefined ? { software: 'only' } : { gpu: name });
  const open = async () => {
    const made = await requestDevice({ gpu });
    void made.lost.then(() => (device = undefined));
    return made;
  };
  let device: GPUDevice | undefined;
  const environment = studioEnvironment();

  return {
    close: () => device?.destroy(),
    async render(model: Model): Promise<{ row: Row; png?: Uint8Array }> {
      const row = {
        name: model.name,
        id: model.id,
        note: model.note,
        warnings: [] as string[],
        triangles: 0,
        instances: 0,
        mean: 0,
        badSamples: 0,
        loadMs: 0,
        prepareMs: 0,
        renderMs: 0,
      };
      let at = performance.now();
      const lap = () => -at + (at = performance.now());
      let tracer: PathTracer | undefined;
      try {
        const scene: Scene = isModelFile(model.file) ? await loadModelFile(model.file) : await loadGltfFile(model.file);
        row.warnings = [...scene.warnings, ...validateScene(scene)].map(({ code, message }) => `${message} [${code}]`);
        row.instances = scene.instances.length;
        row.triangles = scene.instances.reduce(
          (sum, { mesh }) => sum + (scene.meshes[mesh]?.indices.length ?? 0) / 3,
          0,
        );
        row.loadMs = lap();
        const signal = AbortSignal.timeout(LIMIT_MS);
        device ??= await open();
        tracer = await PathTracer.create(
          device,
          { ...scene, environment: scene.environment ?? environment },
          { width: size, height: size, camera: frameCamera(scene, { aspect: 1 }), signal },
        );
        row.prepareMs = lap();
        for await (const _ of tracer.render({ samples, signal, maxSubmitMs: 200 }));
        if (tracer.samples < samples)
          throw new Error(`stopped after ${tracer.samples} samples: it takes more than ${LIMIT_MS / 1000} s`);
        const codes = toneMapPixels(await tracer.read('beauty'), size, size, {}) as Uint8ClampedArray;
        // Known after the image was read.
        row.badSamples = tracer.statistics.badSamples;
        row.renderMs = lap();
        for (let i = 0; i < codes.length; i++)
          if (i % 4 !== 3) row.mean += (codes[i] as number) / (255 * 3 * size * size);
        return { row, png: encodePng({ width: size, height: size, data: new Uint8Array(codes) }) };
      } catch (error) {
        const { code } = error as { code?: string };
        return {
          row: {
            ...row,
            error: `${error instanceof Error ? error.message : String(error)}${code ? ` [${code}]` : ''}`,
          },
        };
      } finally {
        tracer?.destroy();
      }
    },
  };
}
