import { GradientEquirectTexture, WebGLPathTracer } from '@glanz/three/compat';
import * as THREE from 'three';

/** Balls of materials from rough to smooth and from plastic to metal, under a gradient. */
export function materialBalls(renderer: THREE.WebGLRenderer) {
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  const scene = new THREE.Scene();
  const sky = new GradientEquirectTexture(128);
  sky.topColor.set(0xddeeff);
  sky.bottomColor.set(0x665544);
  sky.exponent = 1;
  sky.update();
  scene.environment = sky;
  scene.background = new THREE.Color(0x202830);

  const ball = new THREE.SphereGeometry(0.45, 48, 32);
  for (let row = 0; row < 3; row++)
    for (let column = 0; column < 4; column++) {
      const material = new THREE.MeshPhysicalMaterial({
        color: new THREE.Color().setHSL(0.08 + 0.25 * row, 0.8, 0.5),
        roughness: column / 3,
        metalness: row / 2,
        clearcoat: row === 0 ? 1 : 0,
        iridescence: row === 2 && column === 0 ? 1 : 0,
      });
      const mesh = new THREE.Mesh(ball, material);
      mesh.position.set(column - 1.5, 1 - row, 0);
      scene.add(mesh);
    }
  const wall = new THREE.Mesh(new THREE.PlaneGeometry(5.2, 4), new THREE.MeshStandardMaterial({ color: 0x999999 }));
  wall.position.z = -0.6;
  scene.add(wall);

  const camera = new THREE.PerspectiveCamera(35, 4 / 3, 0.1, 50);
  camera.position.set(1.2, 0.8, 6.4);
  camera.lookAt(0, 0, 0);

  const pathTracer = new WebGLPathTracer(renderer);
  pathTracer.tiles.set(2, 2);
  pathTracer.setScene(scene, camera);
  return { pathTracer, scene, camera };
}
