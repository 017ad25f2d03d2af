import {
  BoxGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  Group,
  HemisphereLight,
  Mesh,
  MeshPhysicalMaterial,
  MeshStandardMaterial,
  PlaneGeometry,
  RectAreaLight,
  Scene,
} from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

/** A model on a pedestal, on a floor, lit from above and from the left. */
export async function createScene(): Promise<Scene> {
  const scene = new Scene();
  scene.background = new Color('#cfd3d8');
  scene.add(new HemisphereLight('#ffffff', '#8a8378', 1));

  const sun = new DirectionalLight('#fff4e0', 2);
  sun.position.set(2, 4, 3);
  scene.add(sun);

  const softbox = new RectAreaLight('#ffffff', 6, 1.5, 1.5);
  softbox.position.set(-2, 2, 1);
  softbox.lookAt(0, 0.4, 0);
  scene.add(softbox);

  const floor = new Mesh(
    new PlaneGeometry(12, 12),
    new MeshStandardMaterial({ color: '#b9b4aa', roughness: 0.6 }),
  );
  floor.rotation.x = -Math.PI / 2;
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
