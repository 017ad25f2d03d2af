import { PathTracer } from '@glanz/renderer';
import { fromThree, type ThreeCamera, type ThreeObject } from '@glanz/three';
import * as THREE from 'three';
import { depthOfField } from './scenes/depth-of-field';
import { glass } from './scenes/glass';
import { interior } from './scenes/interior';
import { materialBalls } from './scenes/material-balls';

const SCENES = { materialBalls, interior, glass, depthOfField };
type Case = ReturnType<typeof materialBalls>;
let renderer: THREE.WebGLRenderer | undefined;
let running: Case | undefined;

Object.assign(window, {
  /** Sets a scene up and renders frames. */
  start: (name: keyof typeof SCENES) => {
    running?.pathTracer.dispose();
    renderer?.setAnimationLoop(null);
    renderer?.dispose();
    renderer?.domElement.remove();
    renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
    renderer.setPixelRatio(1);
    renderer.setSize(...((window as unknown as { size?: [number, number] }).size ?? [64, 48]), false);
    document.body.append(renderer.domElement);
    running = SCENES[name](renderer) as Case;
    const { pathTracer } = running;
    Object.assign(pathTracer, { stableNoise: true, renderDelay: 0, minSamples: 1, fadeDuration: 0 });
    renderer.setAnimationLoop(() => pathTracer.renderSample());
    return pathTracer.isCompiling;
  },
  state: () => {
    const { samples, isCompiling, error, threePathTracer } = running!.pathTracer;
    return { samples, film: threePathTracer?.samples ?? 0, isCompiling, error: error && String(error) };
  },
  running: () => running,
  /** The same by three's WebGPU renderer. */
  startWebGpu: async () => Object.assign(window, await (await import('./webgpu')).startWebGpu()).drawn.pathTraced,
  pause: (pause: boolean) => void (running!.pathTracer.pausePathTracing = pause),
  /** Largest differences between the texels and a film of `fromThree` and `PathTracer`, and the mean of that. */
  compare: async () => {
    const { pathTracer, scene, camera } = running!;
    // What is shown now; a sample that is under way may replace it meanwhile.
    const { samples } = pathTracer;
    const { texture, width, height } = pathTracer.target;
    const halves = (texture.image.data as unknown as Uint16Array).slice();
    // Its kernels are compiled there.
    const { device } = pathTracer.threePathTracer!;
    const converted = await fromThree(scene as unknown as ThreeObject, camera as unknown as ThreeCamera);
    const transmits = converted.materials.some(({ parameters }) => Number(parameters.transmission_weight) > 0);
    const tracer = await PathTracer.create(device, converted, {
      width,
      height,
      maxDepth: pathTracer.bounces + (transmits ? pathTracer.transmissiveBounces : 0),
      regularization: pathTracer.filterGlossyFactor,
      background: scene.environment && scene.background === scene.environment ? 'environment' : 'transparent',
    });
    for await (const progress of tracer.render({ samples })) void progress;
    const film = await tracer.read('beauty');
    tracer.destroy();
    let [worst, sum] = [0, 0];
    for (let y = 0; y < height; y++)
      for (let x = 0; x < width; x++)
        for (let k = 0; k < 4; k++) {
          const from = 4 * (y * width + x);
          const alpha = film[from + 3]!;
          const expected = k === 3 ? alpha : alpha > 1e-6 ? film[from + k]! / alpha : 0;
          const got = THREE.DataUtils.fromHalfFloat(halves[4 * ((height - 1 - y) * width + x) + k]!);
          worst = Math.max(worst, Math.abs(got - expected) / Math.max(1e-3, Math.abs(expected)));
          sum += expected;
        }
    return { worst, mean: sum / film.length, width, height };
  },
});
