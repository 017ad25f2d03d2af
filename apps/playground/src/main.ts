import type { ModelRequest } from './input/load-messages';
import { loadScene } from './input/load-scene';
import { SAMPLES, type SampleName } from './input/samples';
import { explained } from './ui/explain';

/** The model is made, or fetched, while the renderer's script arrives. */
async function loadEarly() {
  const requested = new URLSearchParams(location.search).get('model') ?? '';
  let request: ModelRequest = {
    kind: 'sample',
    name: Object.hasOwn(SAMPLES, requested) ? (requested as SampleName) : 'push-button',
  };
  let problem: unknown;
  // Names have neither dots nor slashes.
  if (/[./]/.test(requested))
    try {
      request = await (await import('./input/address-model')).fetchModel(requested);
    } catch (error) {
      problem = error;
    }
  const scene = loadScene(request, { signal: new AbortController().signal });
  // Reported where it is awaited.
  scene.catch(() => undefined);
  return { request, scene, problem };
}

await explained(async () => {
  const [early, { App }] = await Promise.all([loadEarly(), import('./app')]);
  await App.start(early);
});
