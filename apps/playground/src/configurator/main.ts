import { loadScene } from '../input/load-scene';
import { explained } from '../ui/explain';

await explained(async () => {
  const level = new URLSearchParams(location.search).get('level') === 'low' ? 'low' : 'medium';
  // The parts are made while the renderer's script arrives.
  const kit = loadScene({ kind: 'kit', level }, { signal: new AbortController().signal });
  kit.catch(() => undefined);
  const { Configurator } = await import('./app');
  await Configurator.start(kit);
});
