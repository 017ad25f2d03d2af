import { loadScene } from './input/load-scene';
import { SAMPLES, type SampleName } from './input/samples';
import { explained } from './ui/explain';

/** The model is made while the renderer's script arrives. */
function loadEarly() {
  const requested = new URLSearchParams(location.search).get('model');
  const name: SampleName =
    requested !== null && Object.hasOwn(SAMPLES, requested) ? (requested as SampleName) : 'push-button';
  const request = { kind: 'sample', name } as const;
  const scene = loadScene(request, { signal: new AbortController().signal });
  // Reported where it is awaited.
  scene.catch(() => undefined);
  return { request, scene };
}

await explained(async () => {
  const early = loadEarly();
  const { App } = await import('./app');
  await App.start(early);
});
