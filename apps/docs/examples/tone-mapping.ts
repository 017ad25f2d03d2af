import type { PathTracer } from '@glanz/renderer';
import { ToneMapPass, toneMapPixels } from '@glanz/tonemap';

// #region canvas
export async function createView(
  device: GPUDevice,
  canvas: HTMLCanvasElement,
  tracer: PathTracer,
) {
  const format = navigator.gpu.getPreferredCanvasFormat();
  const context = canvas.getContext('webgpu')!;
  context.configure({ device, format, alphaMode: 'premultiplied' });
  const pass = await ToneMapPass.create(device, {
    format,
    toneMap: 'agx',
    exposure: -0.5,
  });
  const draw = () => {
    const encoder = device.createCommandEncoder();
    pass.draw(
      encoder,
      tracer.beautyBuffer,
      [tracer.width, tracer.height],
      context.getCurrentTexture().createView(),
    );
    device.queue.submit([encoder.finish()]);
  };
  return { pass, draw };
}
// #endregion canvas

// #region change
export async function brighter(view: Awaited<ReturnType<typeof createView>>) {
  // Compiles in the background and is then used.
  await view.pass.setOptions({ exposure: 1, toneMap: 'neutral' });
  view.draw(); // no new samples needed
}
// #endregion change

// #region pixels
export async function toImageData(tracer: PathTracer) {
  const codes = toneMapPixels(
    await tracer.read('beauty'),
    tracer.width,
    tracer.height,
    { toneMap: 'neutral', exposure: 0 },
  );
  return new ImageData(codes, tracer.width, tracer.height);
}
// #endregion pixels
