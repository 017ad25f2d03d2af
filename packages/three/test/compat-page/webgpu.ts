import { WebGPUPathTracer, type CompatRenderer } from '@glanz/three/compat';
import * as THREE from 'three';
import { WebGPURenderer } from 'three/webgpu';

/** What the scene needs of it: the project declares only what its benchmark does. */
type Renderer = CompatRenderer &
  Pick<THREE.WebGLRenderer, 'setPixelRatio' | 'setSize' | 'setAnimationLoop' | 'domElement'> & {
    init(): Promise<unknown>;
  };

/** A red ball under white light, drawn by three's WebGPU renderer. */
export async function startWebGpu() {
  const renderer = new (WebGPURenderer as unknown as new () => Renderer)();
  renderer.setPixelRatio(1);
  renderer.setSize(64, 48, false);
  document.body.append(renderer.domElement);
  const scene = new THREE.Scene();
  scene.add(new THREE.HemisphereLight(0xffffff, 0xffffff, 3));
  scene.add(new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), new THREE.MeshStandardMaterial({ color: 0xff1000 })));
  const camera = new THREE.PerspectiveCamera(45, 4 / 3, 0.1, 10);
  camera.position.z = 3;
  const pathTracer = new WebGPUPathTracer(renderer);
  Object.assign(pathTracer, { renderDelay: 0, minSamples: 1, fadeDuration: 0, maxSamples: 3 });
  pathTracer.setScene(scene, camera);
  // Before the renderer is initialised nothing is drawn, and nothing thrown.
  pathTracer.renderSample();
  await renderer.init();
  const drawn = { rasterised: 0, pathTraced: 0 };
  const { rasterizeSceneCallback, renderToCanvasCallback } = pathTracer;
  pathTracer.rasterizeSceneCallback = (...given) => {
    drawn.rasterised++;
    rasterizeSceneCallback(...given);
  };
  pathTracer.renderToCanvasCallback = (...given) => {
    drawn.pathTraced++;
    renderToCanvasCallback(...given);
  };
  renderer.setAnimationLoop(() => pathTracer.renderSample());
  return { pathTracer, drawn };
}
