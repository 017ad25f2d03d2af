import { FilmDenoiser } from '@glanz/denoise/film';
import { smallUrl } from '@glanz/denoise-weights/small';
import { decodeExr } from '@glanz/image';
import { frameCamera } from '@glanz/scene';
import { createViewer, type ViewerOptions } from '@glanz/viewer';
import { denoising } from '@glanz/viewer/denoise';

// Tests call the viewer through the window.
const bytes = (base64: string) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
Object.assign(window, {
  make: (options: ViewerOptions = {}) => createViewer(document.querySelector('canvas') as HTMLCanvasElement, options),
  file: (base64: string, name: string) => new File([bytes(base64)], name),
  frameCamera,
  decodeExr,
  denoising,
  filmDenoiser: async (device: GPUDevice) =>
    FilmDenoiser.create(device, { color: await (await fetch(smallUrl())).arrayBuffer() }),
});
