import { ThreePathTracer } from '@glanz/three';
import { build } from './three-scene';

// #region follow
export async function follow(canvas: HTMLCanvasElement, signal: AbortSignal) {
  const { scene, camera } = build();
  const tracer = await ThreePathTracer.create(scene, camera, {
    canvas,
    toneMap: 'aces',
    tracer: { maxDepth: 6 },
    signal,
  });
  const frame = async () => {
    if (signal.aborted) return tracer.destroy();
    // The changes that the application has made since the last frame.
    await tracer.update();
    await tracer.sample();
    tracer.render();
    requestAnimationFrame(() => void frame());
  };
  await frame();
  return { tracer, scene, camera };
}
// #endregion follow
