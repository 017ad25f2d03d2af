import { PhysicalCamera, WebGLPathTracer } from '@glanz/three/compat';
import * as THREE from 'three';

/** A row of blocks that a lens shows sharp in the middle alone. */
export function depthOfField(renderer: THREE.WebGLRenderer) {
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0x101418);
  scene.add(new THREE.HemisphereLight(0xffffff, 0x554433, 2));
  const sun = new THREE.DirectionalLight(0xfff0e0, 3);
  sun.position.set(2, 4, 3);
  sun.castShadow = true;
  scene.add(sun);

  const blocks = new THREE.InstancedMesh(
    new THREE.BoxGeometry(0.5, 1, 0.5),
    new THREE.MeshStandardMaterial({ roughness: 0.4 }),
    9,
  );
  for (let i = 0; i < 9; i++) {
    blocks.setMatrixAt(i, new THREE.Matrix4().makeTranslation((i - 4) * 0.6, 0, (4 - i) * 0.9));
    blocks.setColorAt(i, new THREE.Color().setHSL(i / 9, 0.8, 0.5));
  }
  const floor = new THREE.Mesh(new THREE.PlaneGeometry(30, 30), new THREE.MeshStandardMaterial({ color: 0x888888 }));
  floor.rotation.x = -Math.PI / 2;
  floor.position.y = -0.5;
  scene.add(blocks, floor);

  const camera = new PhysicalCamera(45, 4 / 3, 0.1, 100);
  camera.position.set(0, 1.2, 7);
  camera.lookAt(0, 0, 0);
  camera.focusDistance = 7.1;
  camera.apertureBlades = 6;
  // Millimetres, for blocks of a metre.
  camera.bokehSize = 300;

  const pathTracer = new WebGLPathTracer(renderer);
  pathTracer.bounces = 4;
  pathTracer.setScene(scene, camera);
  return { pathTracer, scene, camera };
}
