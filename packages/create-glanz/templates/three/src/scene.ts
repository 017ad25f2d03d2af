import {
  BoxGeometry,
  CylinderGeometry,
  DataTexture,
  DirectionalLight,
  EquirectangularReflectionMapping,
  FloatType,
  Group,
  LinearFilter,
  Mesh,
  MeshPhysicalMaterial,
  MeshStandardMaterial,
  RGBAFormat,
  Scene,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

/** A sky that is light above and fades into a warm grey below, in linear light. */
function sky(): DataTexture {
  const [width, height] = [64, 32];
  const data = new Float32Array(width * height * 4);
  for (let y = 0; y < height; y++) {
    // Rows begin at the nadir.
    const up = Math.max(0, (2 * (y + 0.5)) / height - 1);
    const color = [0.45 + 0.45 * up, 0.43 + 0.52 * up, 0.4 + 0.65 * up, 1];
    for (let x = 0; x < width; x++) data.set(color, 4 * (y * width + x));
  }
  const texture = new DataTexture(data, width, height, RGBAFormat, FloatType);
  texture.mapping = EquirectangularReflectionMapping;
  texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** A model on a pedestal and a glass cube, on a floor, under a sky with a sun. */
export async function createScene(): Promise<Scene> {
  const scene = new Scene();
  scene.environment = scene.background = sky();
  scene.environmentIntensity = scene.backgroundIntensity = 0.8;

  const sun = new DirectionalLight('#fff1d6', 3);
  sun.position.set(2, 4, 3);
  scene.add(sun);

  const floor = new Mesh(
    new CylinderGeometry(3, 3, 0.02, 128),
    new MeshStandardMaterial({ color: '#b9b4aa', roughness: 0.6 }),
  );
  floor.position.y = -0.01;
  scene.add(floor);

  const pedestal = new Mesh(
    new CylinderGeometry(0.6, 0.6, 0.3, 96),
    new MeshPhysicalMaterial({
      color: '#27364f',
      roughness: 0.35,
      clearcoat: 1,
    }),
  );
  pedestal.position.y = 0.15;
  scene.add(pedestal);

  const glass = new Mesh(
    new BoxGeometry(0.3, 0.3, 0.3),
    new MeshPhysicalMaterial({
      transmission: 1,
      thickness: 0.3,
      roughness: 0,
      ior: 1.5,
    }),
  );
  glass.position.set(1, 0.15, 0.3);
  glass.rotation.y = 0.5;
  scene.add(glass);

  const { scene: model } = await new GLTFLoader().loadAsync('/push-button.glb');
  const product = new Group();
  product.add(model);
  // The model is six centimetres large and faces +Z.
  product.scale.setScalar(12);
  product.rotation.x = -Math.PI / 2.6;
  product.position.set(0, 0.95, 0);
  scene.add(product);
  return scene;
}
