import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import type { Material } from '@glanz/scene';
import { toneMapPixels } from '@glanz/tonemap';
import { groupControls, groupParameters } from './live/groups';
import { LENS_COLOURS } from './live/lens-colours';
import { createLiveScene, type LiveSceneName } from './live/scenes';
import { SPHERE_SLIDERS, sphereParameters } from './live/sphere-sliders';

interface Shot {
  readonly scene: LiveSceneName;
  readonly material?: string;
  readonly parameters?: Material['parameters'];
}

const GROUPS = [
  'base',
  'specular',
  'transmission',
  'subsurface',
  'coat',
  'fuzz',
  'emission',
  'thin_film',
  'geometry',
] as const;

/** What each live image of the site shows before it is started, by the name of its file. */
const SHOTS: Readonly<Record<string, Shot>> = {
  spheres: { scene: 'spheres' },
  'push-button': { scene: 'push-button', material: 'lens green', parameters: LENS_COLOURS[0]!.parameters },
  sphere: {
    scene: 'sphere',
    material: 'sphere',
    parameters: sphereParameters(Object.fromEntries(SPHERE_SLIDERS.map(({ name, value }) => [name, value])), '#c8501e'),
  },
  ...Object.fromEntries(
    GROUPS.map((group) => [
      `material-${group}`,
      {
        scene: 'material',
        material: 'sphere',
        parameters: groupParameters(
          group,
          Object.fromEntries(groupControls(group).map(({ name, value }) => [name, value])),
        ),
      } satisfies Shot,
    ]),
  ),
};

/** Path-traces the posters: sRGB codes, RGBA. */
export async function* renderPosters(options: {
  readonly samples: number;
  readonly names: readonly string[];
  readonly report: (line: string) => void;
}): AsyncGenerator<{
  readonly name: string;
  readonly width: number;
  readonly height: number;
  readonly data: Uint8ClampedArray;
}> {
  const [width, height] = [600, 400];
  const device = await requestDevice({ gpu: (await createGpu()).gpu });
  for (const [name, { scene, material, parameters }] of Object.entries(SHOTS)) {
    if (options.names.length > 0 && !options.names.includes(name)) continue;
    const tracer = await PathTracer.create(device, createLiveScene(scene), { width, height, maxDepth: 5 });
    if (material && parameters) await tracer.setMaterial(material, parameters);
    for await (const { samples } of tracer.render({ samples: options.samples }))
      options.report(`${name}: ${samples} samples`);
    yield {
      name,
      width,
      height,
      data: toneMapPixels(await tracer.read('beauty'), width, height, { toneMap: 'neutral', alpha: 'opaque' }),
    };
    tracer.destroy();
  }
  device.destroy();
}
