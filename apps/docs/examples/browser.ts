import { loadGltf } from '@glanz/gltf';
import { PathTracer, requestDevice } from '@glanz/renderer';
import { studioEnvironment } from '@glanz/scene/studio';
import { ToneMapPass } from '@glanz/tonemap';

export async function show(canvas: HTMLCanvasElement, url: string) {
  const device = await requestDevice();
  const scene = await loadGltf(url);
  scene.environment ??= studioEnvironment();

  const { width, height } = canvas;
  const tracer = await PathTracer.create(device, scene, { width, height });

  const format = navigator.gpu.getPreferredCanvasFormat();
  const context = canvas.getContext('webgpu') as GPUCanvasContext;
  context.configure({ device, format, alphaMode: 'premultiplied' });
  const pass = await ToneMapPass.create(device, { format, toneMap: 'neutral' });

  for await (const _ of tracer.render({ samples: 256 })) {
    const encoder = device.createCommandEncoder();
    pass.draw(
      encoder,
      tracer.beautyBuffer,
      [width, height],
      context.getCurrentTexture().createView(),
    );
    device.queue.submit([encoder.finish()]);
  }
}
