import { OPENPBR_PRESET_NAMES, OPENPBR_PRESETS, type OpenPbrPresetName } from '@glanz/openpbr/presets';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { toneMapPixels } from '@glanz/tonemap';
import { createLiveScene } from './live/scenes';

/** A picture of a preset: sRGB codes, RGBA. */
export interface PresetPicture {
  readonly name: OpenPbrPresetName;
  readonly size: number;
  readonly data: Uint8ClampedArray;
}

/** What a lamp is dimmed to, so that its picture shows more than white. */
const LAMP = 2;

/** Path-traces a sphere of each preset, one after the other. */
export async function* renderPresets(options: { readonly size: number; readonly samples: number; readonly names?: readonly string[] }): AsyncGenerator<PresetPicture> {
  const { size, samples } = options;
  const device = await requestDevice({ gpu: (await createGpu()).gpu });
  const scene = createLiveScene('material');
  const camera = { type: 'perspective', name: 'close', yfov: 0.36, transform: [1, 0, 0, 0, 0, 0.96, -0.28, 0, 0, 0.28, 0.96, 0, 0, 1.85, 6.4, 1] } as const;
  for (const name of OPENPBR_PRESET_NAMES) {
    if (options.names && !options.names.includes(name)) continue;
    const parameters = OPENPBR_PRESETS[name];
    scene.materials[0] = { name: 'sphere', parameters: parameters.emission_luminance ? { ...parameters, emission_luminance: LAMP } : parameters };
    const tracer = await PathTracer.create(device, scene, { width: size, height: size, camera, maxDepth: 24 });
    for await (const _ of tracer.render({ samples }));
    const data = toneMapPixels(await tracer.read('beauty'), size, size, { toneMap: 'neutral', exposure: 0.1 }) as Uint8ClampedArray;
    tracer.destroy();
    yield { name, size, data };
  }
  device.destroy();
}
