import { createPushButton } from '@glanz/models';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { frameCamera } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { toneMapPixels } from '@glanz/tonemap';

/** The push-button without background, at twice the size it is shown at: sRGB codes, RGBA, straight alpha. */
export async function renderHero(options: {
  readonly samples: number;
  readonly report: (line: string) => void;
}): Promise<{ width: number; height: number; data: Uint8ClampedArray }> {
  const [width, height] = [1120, 1040];
  const device = await requestDevice({ gpu: (await createGpu()).gpu });
  const scene = { ...createPushButton({ level: 'medium' }), environment: studioEnvironment() };
  const camera = frameCamera(scene, { aspect: width / height, yfov: 0.44, direction: [1, 0.52, 0.86], margin: 0.02 });
  const tracer = await PathTracer.create(device, scene, { width, height, camera, background: 'transparent' });
  for await (const { samples, remainingMs } of tracer.render({ samples: options.samples }))
    options.report(`${samples} samples, ${Math.ceil(remainingMs / 1000)} s left`);
  const data = toneMapPixels(await tracer.read('beauty'), width, height, { toneMap: 'neutral', exposure: 0.2 });
  tracer.destroy();
  device.destroy();
  return { width, height, data };
}
