import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { encodePng } from '@glanz/image';
import { OPENPBR_PRESET_NAMES, OPENPBR_PRESETS } from '@glanz/openpbr/presets';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { toneMapPixels } from '@glanz/tonemap';
import { createLiveScene } from './live/scenes';

/** Twice what the page shows. */
const SIZE = 320;
/** Emission of emissive presets, dimmed so that their image shows more than white. */
const EMISSION = 2;

/**
 * Path-traces a sphere of each preset, one after the other, into PNG files.
 *
 * @param args The folder, samples a pixel (256), and names (all).
 */
export async function presetsMain([folder = '.', samples = '256', ...names]: readonly string[]): Promise<void> {
  mkdirSync(folder, { recursive: true });
  const device = await requestDevice({ gpu: (await createGpu()).gpu });
  const scene = createLiveScene('material');
  const camera = {
    type: 'perspective',
    name: 'close',
    yfov: 0.36,
    transform: [1, 0, 0, 0, 0, 0.96, -0.28, 0, 0, 0.28, 0.96, 0, 0, 1.85, 6.4, 1],
  } as const;
  for (const name of OPENPBR_PRESET_NAMES) {
    if (names.length > 0 && !names.includes(name)) continue;
    const from = performance.now();
    const parameters = OPENPBR_PRESETS[name];
    scene.materials[0] = {
      name: 'sphere',
      parameters: parameters.emission_luminance ? { ...parameters, emission_luminance: EMISSION } : parameters,
    };
    const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera, maxDepth: 24 });
    for await (const _ of tracer.render({ samples: Number(samples) }));
    const data = toneMapPixels(await tracer.read('beauty'), SIZE, SIZE, {
      toneMap: 'neutral',
      exposure: 0.1,
    }) as Uint8ClampedArray<ArrayBuffer>;
    tracer.destroy();
    writeFileSync(
      join(folder, `${name}.png`),
      encodePng({ width: SIZE, height: SIZE, data: new Uint8Array(data.buffer) }),
    );
    process.stderr.write(`${name}: ${((performance.now() - from) / 1000).toFixed(1)} s\n`);
  }
  device.destroy();
}
