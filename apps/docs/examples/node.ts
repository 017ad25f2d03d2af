import { writeFile } from 'node:fs/promises';
import { loadGltfFile } from '@glanz/gltf/node';
import { encodePng } from '@glanz/image/png';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { studioEnvironment } from '@glanz/scene/studio';
import { toneMapPixels } from '@glanz/tonemap';

const [width, height] = [640, 480];
const device = await requestDevice({ gpu: (await createGpu()).gpu });
const scene = await loadGltfFile('push-button.glb');
scene.environment ??= studioEnvironment();
const tracer = await PathTracer.create(device, scene, { width, height });
for await (const { samples, remainingMs } of tracer.render({ samples: 64 })) {
  process.stderr.write(`${samples}, ${Math.ceil(remainingMs / 1000)} s left\n`);
}
const film = await tracer.read('beauty');
const data = toneMapPixels(film, width, height, { toneMap: 'neutral' });
await writeFile('push-button.png', encodePng({ width, height, data }));
device.destroy();
