import { testDevice } from '@glanz/gpu';
import { it } from 'vitest';
import { compareEstimates } from '../src/estimator/agreement';
import { imageMean } from '../src/estimator/glass-reference';
import { estimate } from '../src/estimator/estimate';
import { GLASS_SCENES, glassScene } from '../src/estimator/glass-scenes';
import { renderGlass } from '../src/estimator/render-glass';
it.each(GLASS_SCENES)('%s', async (name) => {
  const device = await testDevice();
  const g = glassScene(name);
  let t = performance.now();
  const image = await renderGlass(device, g, { samples: 256 });
  console.log(name, 'gpu', performance.now() - t, imageMean(image));
  t = performance.now();
  const ref = estimate(g.scene, { ...g, samples: 128, seed: 7 });
  console.log(name, 'cpu', performance.now() - t, imageMean(ref), compareEstimates(image, ref, g));
});
