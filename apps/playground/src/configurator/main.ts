import { loadScene } from '../input/load-scene';
import { explain } from '../ui/explain';

try {
  const level = new URLSearchParams(location.search).get('level') === 'low' ? 'low' : 'medium';
  // The parts are made while the renderer's script arrives.
  const kit = loadScene({ kind: 'kit', level }, { signal: new AbortController().signal });
  kit.catch(() => undefined);
  const { Configurator } = await import('./app');
  await Configurator.start(kit);
} catch (error) {
  explain(error);
}
