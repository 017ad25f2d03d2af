import { FilmDenoiser, type FilmDenoiserOptions } from '@glanz/denoise/film';
import { smallUrl } from '@glanz/denoise-weights/small';
import { decodeExr } from '@glanz/image';
import { frameCamera } from '@glanz/scene';
import { createViewer, type ViewerOptions } from '@glanz/viewer';
import { denoising } from '@glanz/viewer/denoise';
import * as record from '@glanz/viewer/record';
import { ALL_FORMATS, BlobSource, Input } from 'mediabunny';

// Tests call the viewer through the window.
const bytes = (base64: string) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
Object.assign(window, {
  make: (options: ViewerOptions = {}) => createViewer(document.querySelector('canvas') as HTMLCanvasElement, options),
  file: (base64: string, name: string) => new File([bytes(base64)], name),
  frameCamera,
  record,
  packets: async (film: Blob) => {
    const input = new Input({ formats: ALL_FORMATS, source: new BlobSource(film) });
    return (await (await input.getPrimaryVideoTrack())?.computePacketStats())?.packetCount;
  },
  played,
  psnr: (a: ArrayLike<number>, b: ArrayLike<number>) => {
    let error = 0;
    for (let i = 0; i < a.length; i++) if (i % 4 < 3) error += (a[i]! - b[i]!) ** 2;
    return 10 * Math.log10((255 ** 2 * 0.75 * a.length) / error);
  },
  decodeExr,
  denoising,
  filmDenoiser: async (device: GPUDevice, options: FilmDenoiserOptions = {}) =>
    FilmDenoiser.create(device, { color: await (await fetch(smallUrl())).arrayBuffer() }, options),
});

/** What a video shows. Chromium's `seeked` may come before there is a frame to read: undefined until there is. */
function currentFrame(video: HTMLVideoElement): VideoFrame | undefined {
  try {
    return new VideoFrame(video);
  } catch (error) {
    if (video.error || !(error instanceof DOMException) || error.name !== 'InvalidStateError') throw error;
    return undefined;
  }
}

/** Frames of a film as the browser plays it, at the middles of their times. */
async function played(film: Blob, frames: number, fps: number) {
  const video = document.createElement('video');
  video.muted = true;
  const once = (type: string) =>
    new Promise((resolve, reject) => {
      video.addEventListener(type, resolve, { once: true });
      video.addEventListener('error', () => reject(new Error(video.error?.message ?? 'error')), { once: true });
    });
  const loaded = once('loadeddata');
  video.src = URL.createObjectURL(film);
  await loaded;
  const size = [video.videoWidth, video.videoHeight] as const;
  const context = new OffscreenCanvas(...size).getContext('2d', {
    willReadFrequently: true,
  }) as OffscreenCanvasRenderingContext2D;
  const images: number[][] = [];
  for (let frame = 0; frame < frames; frame++) {
    const sought = once('seeked');
    video.currentTime = (frame + 0.5) / fps;
    await sought;
    // A busy browser may still show the frame before, or none yet.
    for (;;) {
      const shown = currentFrame(video);
      const isShown = shown && Math.floor((shown.timestamp / 1e6) * fps + 0.25) === frame;
      if (isShown) context.drawImage(shown, 0, 0);
      shown?.close();
      if (isShown) break;
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
    images.push([...context.getImageData(0, 0, ...size).data]);
  }
  return { duration: video.duration, size, images };
}
