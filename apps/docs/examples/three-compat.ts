import { WebGLPathTracer } from '@glanz/three/compat';
import * as THREE from 'three';
import { build } from './three-scene';

// #region compat
export function start(canvas: HTMLCanvasElement) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  const { scene, camera } = build();

  const pathTracer = new WebGLPathTracer(renderer);
  pathTracer.bounces = 6;
  pathTracer.setScene(scene, camera);
  renderer.setAnimationLoop(() => pathTracer.renderSample());
  return pathTracer;
}
// #endregion compat
