import { PhysicalSpotLight, ShapedAreaLight, WebGLPathTracer } from '@glanz/three/compat';
import * as THREE from 'three';

/** A room that is lit by a rectangle, a disk and a spot light. */
export function interior(renderer: THREE.WebGLRenderer) {
  renderer.toneMapping = THREE.ACESFilmicToneMapping;
  renderer.toneMappingExposure = 1.2;
  const scene = new THREE.Scene();
  const paint = (color: THREE.ColorRepresentation) => new THREE.MeshStandardMaterial({ color, roughness: 0.9 });
  const wall = (color: THREE.ColorRepresentation, place: (mesh: THREE.Mesh) => void) => {
    const mesh = new THREE.Mesh(new THREE.PlaneGeometry(4, 4), paint(color));
    place(mesh);
    scene.add(mesh);
  };
  wall(0xcccccc, (mesh) => mesh.position.set(0, 0, -2));
  wall(0x9a6a4a, (mesh) => (mesh.position.set(0, -2, 0), mesh.rotateX(-Math.PI / 2)));
  wall(0xdddddd, (mesh) => (mesh.position.set(0, 2, 0), mesh.rotateX(Math.PI / 2)));
  wall(0xb03020, (mesh) => (mesh.position.set(-2, 0, 0), mesh.rotateY(Math.PI / 2)));
  wall(0x2050a0, (mesh) => (mesh.position.set(2, 0, 0), mesh.rotateY(-Math.PI / 2)));

  const table = new THREE.Group();
  const wood = paint(0xc09060);
  const top = new THREE.Mesh(new THREE.BoxGeometry(1.8, 0.1, 1), wood);
  table.add(top);
  for (const [x, z] of [
    [-0.8, -0.4],
    [0.8, -0.4],
    [-0.8, 0.4],
    [0.8, 0.4],
  ] as const) {
    const leg = new THREE.Mesh(new THREE.CylinderGeometry(0.05, 0.05, 1, 12), wood);
    leg.position.set(x, -0.5, z);
    table.add(leg);
  }
  table.position.set(0, -1, 0);
  const vase = new THREE.Mesh(
    new THREE.LatheGeometry(
      [
        [0.15, 0],
        [0.25, 0.2],
        [0.1, 0.5],
        [0.16, 0.6],
      ].map(([x, y]) => new THREE.Vector2(x, y)),
      32,
    ),
    new THREE.MeshStandardMaterial({ color: 0xf0e0d0, roughness: 0.2, side: THREE.DoubleSide }),
  );
  vase.position.set(0.3, 0.05, 0);
  table.add(vase);
  scene.add(table);

  const panel = new THREE.RectAreaLight(0xfff0dd, 6, 1.4, 0.8);
  panel.position.set(0, 1.98, 0);
  panel.lookAt(0, -2, 0);
  const disk = new ShapedAreaLight(0x88aaff, 4, 0.8, 0.8);
  disk.isCircular = true;
  disk.position.set(-1.96, 0.6, 0);
  disk.lookAt(2, 0.6, 0);
  const spot = new PhysicalSpotLight(0xffffff, 40, 0, 0.35, 0.4);
  spot.position.set(1.6, 1.8, 1.4);
  spot.target.position.set(-0.3, -1, 0);
  spot.castShadow = true;
  scene.add(panel, disk, spot, spot.target);

  const camera = new THREE.PerspectiveCamera(50, 4 / 3, 0.1, 50);
  camera.position.set(0, 0, 5.4);
  camera.lookAt(0, -0.2, 0);

  const pathTracer = new WebGLPathTracer(renderer);
  pathTracer.bounces = 6;
  pathTracer.setScene(scene, camera);
  return { pathTracer, scene, camera };
}
