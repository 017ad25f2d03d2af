import { mkdirSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { createPushButton } from '@glanz/models';
import { sceneToGlb } from '@glanz/models/gltf';
import { timed, type Benchmark, type Figure } from '../benchmark';
import { sphereFile } from '../main-thread/model';
import { openPlayground } from '../main-thread/page';
import { numberOption } from '../options';

const FRAME = { value: 16, relation: '<=', source: 'one frame' } as const;

/**
 * What is loaded: one mesh with and without normals, and one of many parts whose light is made of tens of thousands of
 * triangles.
 */
async function models(
  quick: boolean,
  triangles: number,
): Promise<readonly { readonly what: string; readonly name: string; readonly bytes: Uint8Array }[]> {
  const rings = quick ? 100 : Math.round(Math.sqrt(triangles / 4));
  const [smooth, flat] = [await sphereFile(rings, true), await sphereFile(rings, false)];
  const button = createPushButton({ level: quick ? 'low' : 'high' });
  const parts = button.meshes.reduce((sum, { indices }) => sum + indices.length / 3, 0);
  return [
    { what: `${smooth.triangles} triangles with normals`, name: 'sphere-normals.glb', bytes: smooth.bytes },
    { what: `${flat.triangles} triangles without normals`, name: 'sphere.glb', bytes: flat.bytes },
    {
      what: `push-button of ${parts} triangles, with a glowing lens`,
      name: 'push-button.glb',
      bytes: await sceneToGlb(button),
    },
  ];
}

/** How long the playground's own thread is not free while a large model is read, built and shown, in Chromium. */
export const benchmark: Benchmark = {
  description: "the longest task of the playground's own thread while a million triangles are loaded",
  options: {
    triangles: { type: 'string', help: 'triangles of the sphere, default 1073296' },
    runs: { type: 'string', help: 'loads of each model, default 5' },
    profile: { type: 'string', help: '"yes": say which functions the long tasks are in (an unminified page)' },
    hardware: { type: 'string', help: '"yes": on the GPU of the machine' },
  },
  async run({ log, quick, values }) {
    const triangles = numberOption(values, 'triangles', 4 * 518 ** 2);
    const runs = numberOption(values, 'runs', quick ? 1 : 5);
    const folder = resolve('.cache/main-thread-models');
    mkdirSync(folder, { recursive: true });
    const figures: Figure[] = [],
      notes: string[] = [];
    const gpu = values['hardware'] === 'yes' ? 'hardware' : 'software';
    const page = await openPlayground(values['profile'] !== undefined, gpu);
    try {
      for (const { what, name, bytes } of await models(quick, triangles)) {
        writeFileSync(join(folder, name), bytes);
        const seen = [];
        for (let i = 0; i < runs; i++) {
          const one = await page.watch(name, join(folder, name));
          seen.push(one);
          log(
            `${what}: longest task ${one.longestTask.toFixed(1)} ms of the thread's time, ${one.longestTaskWall.toFixed(1)} by the clock; longest gap ${one.longestGap.toFixed(1)} ms; ${one.longTasks.length} entries of 50 ms and more; ${one.ms.toFixed(0)} ms in all`,
          );
          for (const line of one.profile ?? []) log(line);
        }
        figures.push(
          timed(
            `${what}: longest task, the thread's own time`,
            'ms',
            seen.map(({ longestTask }) => longestTask),
            quick ? undefined : FRAME,
          ),
          timed(
            `${what}: longest task by the clock`,
            'ms',
            seen.map(({ longestTaskWall }) => longestTaskWall),
          ),
          timed(
            `${what}: longest gap between messages, by the clock`,
            'ms',
            seen.map(({ longestGap }) => longestGap),
          ),
          timed(
            `${what}: entries of 50 ms and more`,
            '1',
            seen.map(({ longTasks }) => longTasks.length),
          ),
          timed(
            `${what}: from the file to the image`,
            'ms',
            seen.map(({ ms }) => ms),
          ),
        );
      }
    } finally {
      await page.close();
    }
    notes.push(
      `The time of the thread itself leaves out what else the machine does${gpu === 'software' ? '; the GPU is software and shares the processor' : ''}.`,
    );
    return {
      settings: {
        runs,
        browser: `Chromium ${page.version}, headless`,
        gpu,
        viewport: '700 × 500',
        scale: 0.25,
        samples: 1,
      },
      figures,
      notes,
    };
  },
};
