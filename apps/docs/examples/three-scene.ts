import { fromThree } from '@glanz/three';
import type { Viewer } from '@glanz/viewer';
import * as THREE from 'three';

// #region build
export function build() {
  const scene = new THREE.Scene();
  scene.add(new THREE.HemisphereLight(0xffffff, 0x806040, 2));

  const knot = new THREE.Mesh(
    new THREE.TorusKnotGeometry(1, 0.3, 200, 32),
    new THREE.MeshPhysicalMaterial({
      color: 0xc03010,
      roughness: 0.2,
      clearcoat: 1,
    }),
  );
  scene.add(knot);

  const light = new THREE.RectAreaLight(0xffffff, 20, 2, 2);
  light.position.set(3, 3, 3);
  light.lookAt(0, 0, 0);
  scene.add(light);

  const camera = new THREE.PerspectiveCamera(40, 1.5);
  camera.position.set(0, 1, 6);
  camera.lookAt(0, 0, 0);
  return { scene, camera };
}
// #endregion build

// #region show
export async function show(viewer: Viewer): Promise<readonly string[]> {
  const { scene, camera } = build();
  await viewer.load(await fromThree(scene, camera));
  return viewer.scene!.warnings.map(({ message }) => message);
}
// #endregion show
