import type { AovName, PathTracer } from '../src/index';
import { readFloats } from '../src/storage/read-buffer';

/** Copies an AOV from its buffer on the GPU: its channels, pixel by pixel. */
export async function readAov(device: GPUDevice, tracer: PathTracer, name: AovName): Promise<Float32Array> {
  const { buffer, stride, offset, channels } = tracer.aov(name);
  const pixels = tracer.width * tracer.height;
  const all = await readFloats(device, buffer, 4 * stride * pixels);
  return Float32Array.from(
    { length: channels * pixels },
    (_, i) => all[stride * Math.floor(i / channels) + offset + (i % channels)] as number,
  );
}
