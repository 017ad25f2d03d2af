import { fromThree, type ThreeObject } from '@glanz/three';
import { createViewer, type ViewerOptions } from '@glanz/viewer';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

const bytes = (base64: string) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
Object.assign(window, {
  make: (options: ViewerOptions) => createViewer(document.querySelector('canvas') as HTMLCanvasElement, options),
  file: (base64: string) => new File([bytes(base64)], 'model.glb'),
  byThree: async (base64: string) => {
    const { scene } = await new GLTFLoader().parseAsync(bytes(base64).buffer, '');
    return fromThree(scene as unknown as ThreeObject);
  },
});
