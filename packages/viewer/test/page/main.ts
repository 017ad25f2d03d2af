import { decodeExr } from '@glanz/image';
import { frameCamera } from '@glanz/scene';
import { createViewer, type ViewerOptions } from '@glanz/viewer';

// Tests call the viewer through the window.
const bytes = (base64: string) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
Object.assign(window, {
  make: (options: ViewerOptions = {}) => createViewer(document.querySelector('canvas') as HTMLCanvasElement, options),
  file: (base64: string, name: string) => new File([bytes(base64)], name),
  frameCamera,
  decodeExr,
});
