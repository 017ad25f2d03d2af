import { fromThree } from '@glanz/three';
import { createViewer } from '@glanz/viewer';
import { PerspectiveCamera, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { createScene } from './scene';

const canvas = (id: string) =>
  document.querySelector<HTMLCanvasElement>(`#${id}`)!;
const status = document.querySelector('output')!;
const traced = canvas('traced');

const scene = await createScene();
const camera = new PerspectiveCamera(35, 1, 0.1, 100);
camera.position.set(2.2, 1.9, 3.4);

const renderer = new WebGLRenderer({
  canvas: canvas('rasterised'),
  antialias: true,
});
const controls = new OrbitControls(camera, renderer.domElement);
controls.target.set(0, 0.6, 0);
controls.update();

function rasterise(): void {
  const { clientWidth, clientHeight } = document.body;
  renderer.setPixelRatio(devicePixelRatio);
  renderer.setSize(clientWidth, clientHeight, false);
  camera.aspect = clientWidth / clientHeight;
  camera.updateProjectionMatrix();
  renderer.render(scene, camera);
}

// The pointer belongs to three.js, so the viewer has no controls of its own.
const viewer = createViewer(traced, { controls: false });
viewer.on('sample', ({ samples, target }) => {
  status.textContent = `path-traced: ${samples} of ${target} samples`;
  traced.classList.add('ready');
});
viewer.on('error', ({ message }) => {
  status.textContent = message;
});

/** Path-traces what three.js shows now. */
async function trace(): Promise<void> {
  scene.updateMatrixWorld();
  await viewer.load(await fromThree(scene, camera), { camera: 0 });
}

controls.addEventListener('start', () => {
  viewer.paused = true;
  traced.classList.remove('ready');
  status.textContent = 'rasterised while it moves';
});
controls.addEventListener('change', rasterise);
controls.addEventListener('end', () => {
  viewer.paused = false;
  void trace();
});
new ResizeObserver(rasterise).observe(document.body);

rasterise();
await trace();
