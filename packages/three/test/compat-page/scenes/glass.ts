import { WebGLPathTracer } from '@glanz/three/compat';
import * as THREE from 'three';

/** Glass and coloured glass under an environment with a bright window, which is the background too. */
export function glass(renderer: THREE.WebGLRenderer) {
  renderer.toneMapping = THREE.NeutralToneMapping;
  const scene = new THREE.Scene();
  const [width, height] = [64, 32];
  const data = new Float32Array(4 * width * height);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const up = y / height;
      const window = x > 44 && x < 52 && y > 18 && y < 26;
      data.set(window ? [9, 8, 7, 1] : [0.25 + 0.4 * up, 0.3 + 0.45 * up, 0.35 + 0.6 * up, 1], 4 * (y * width + x));
    }
  const environment = new THREE.DataTexture(data, width, height, THREE.RGBAFormat, THREE.FloatType);
  environment.mapping = THREE.EquirectangularReflectionMapping;
  environment.minFilter = environment.magFilter = THREE.LinearFilter;
  environment.needsUpdate = true;
  scene.environment = scene.background = environment;

  const clear = new THREE.MeshPhysicalMaterial({ roughness: 0, transmission: 1, thickness: 1, ior: 1.5 });
  const green = new THREE.MeshPhysicalMaterial({
    roughness: 0.15,
    transmission: 1,
    thickness: 1,
    attenuationColor: new THREE.Color(0x30c060),
    attenuationDistance: 0.6,
  });
  const knot = new THREE.Mesh(new THREE.TorusKnotGeometry(0.55, 0.2, 128, 24), clear);
  knot.position.set(-0.7, 0.1, 0);
  const ball = new THREE.Mesh(new THREE.SphereGeometry(0.6, 48, 32), green);
  ball.position.set(0.95, -0.3, 0.2);
  const checks = new Uint8Array(8 * 8 * 4);
  for (let i = 0; i < 64; i++) checks.set((i + (i >> 3)) % 2 ? [220, 220, 220, 255] : [60, 60, 60, 255], 4 * i);
  const map = new THREE.DataTexture(checks, 8, 8);
  map.colorSpace = THREE.SRGBColorSpace;
  map.magFilter = THREE.NearestFilter;
  map.needsUpdate = true;
  const floor = new THREE.Mesh(new THREE.PlaneGeometry(5, 5), new THREE.MeshStandardMaterial({ map, roughness: 0.6 }));
  floor.rotation.x = -Math.PI / 2;
  floor.position.y = -0.9;
  scene.add(knot, ball, floor);

  const camera = new THREE.PerspectiveCamera(40, 4 / 3, 0.1, 50);
  camera.position.set(0, 0.7, 4.4);
  camera.lookAt(0, -0.1, 0);

  const pathTracer = new WebGLPathTracer(renderer);
  pathTracer.transmissiveBounces = 6;
  pathTracer.filterGlossyFactor = 0.25;
  pathTracer.setScene(scene, camera);
  return { pathTracer, scene, camera };
}
