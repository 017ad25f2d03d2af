import { createViewer, type Viewer } from '@glanz/viewer';

// #region start
export async function start(
  canvas: HTMLCanvasElement,
  url: string,
): Promise<Viewer> {
  const viewer = createViewer(canvas, {
    samples: 256,
    environment: 'studio',
    background: 'transparent',
  });
  await viewer.load(url);
  return viewer;
}
// #endregion start

// #region events
export function showEvents(
  viewer: Viewer,
  bar: HTMLProgressElement,
  line: HTMLElement,
): void {
  viewer.on('progress', ({ total }) => void (bar.value = total));
  viewer.on('sample', ({ samples, target, remainingMs }) => {
    const seconds = Math.round(remainingMs / 1000);
    line.textContent = `${samples} of ${target} samples, ${seconds} s left`;
  });
  viewer.on(
    'converged',
    ({ milliseconds }) =>
      void (line.textContent = `Done in ${(milliseconds / 1000).toFixed(1)} s.`),
  );
  viewer.on('error', ({ message, retry }) => {
    line.textContent = message;
    if (retry) line.onclick = retry;
  });
}
// #endregion events

// #region edit
export async function dress(viewer: Viewer): Promise<void> {
  await viewer.setVariant('night');
  await viewer.setMaterial('left', {
    base_color: 'gold',
    specular_roughness: 0.2,
  });
  await viewer.edit((tracer) => tracer.setVisibility('right', false), {
    key: 'right',
  });
}
// #endregion edit

// #region animation
export async function openLid(viewer: Viewer): Promise<void> {
  const animation = await viewer.animation();
  const [first] = animation.animations;
  animation.name = first?.name;
  animation.play({ repetitions: 1 });
  viewer.on('finished', () => void (animation.currentTime = 0));
}
// #endregion animation

// #region look
export function look(viewer: Viewer): void {
  viewer.orbitLimits = { phi: [0.2, Math.PI / 2], radius: [2, 8] };
  viewer.setOrbit({ theta: Math.PI / 4, phi: 1.2 });
  viewer.autoRotate = 0.3;
}
// #endregion look

// #region pin
export function pin(
  viewer: Viewer,
  element: HTMLElement,
  place: readonly [number, number, number],
): () => void {
  return viewer.on('frame', () => {
    const at = viewer.project(place);
    element.hidden = !at?.inside;
    if (at) element.style.translate = `${100 * at.x}cqw ${100 * at.y}cqh`;
  });
}
// #endregion pin

// #region drop
export function acceptDrops(viewer: Viewer): void {
  const { canvas } = viewer;
  canvas.addEventListener('dragover', (event) => event.preventDefault());
  canvas.addEventListener('drop', (event) => {
    event.preventDefault();
    if (event.dataTransfer)
      viewer.load(event.dataTransfer.files).catch(() => undefined); // 'error'
  });
}
// #endregion drop

// #region save
export async function save(viewer: Viewer): Promise<Blob> {
  return viewer.toBlob({ type: 'image/png', samples: 64 });
}
// #endregion save

// #region render
export async function render(
  viewer: Viewer,
  bar: HTMLProgressElement,
  signal: AbortSignal,
  [width, height] = [3840, 2160],
): Promise<Blob> {
  return viewer.toBlob({
    type: 'image/png', // or jpeg, webp, x-exr
    width,
    height,
    samples: 1024, // or noise: 0.01
    background: 'transparent', // gives an alpha channel
    onProgress: ({ share }) => void (bar.value = share),
    signal,
  });
}
// #endregion render
