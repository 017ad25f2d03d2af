import { createGpu } from '@glanz/renderer/node';
import { requestDevice } from '@glanz/renderer';
import { measureFurnace, type FurnaceMaterial } from '@glanz/reference';
import { estimated, type Benchmark, type Figure } from '../benchmark';

const MATERIALS: readonly FurnaceMaterial[] = ['diffuse', 'metal', 'dielectric'];
const ROUGHNESSES = [0.05, 0.1, 0.25, 0.5, 0.75, 1];

/** White furnaces: how far the light that comes back is from all of it. */
export const benchmark: Benchmark = {
  description: 'white furnaces: diffuse, metal and dielectric balls at roughness 0.05 to 1',
  async run({ log, quick, gpu }) {
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const device = await requestDevice({ gpu: api });
    const settings = { size: quick ? 16 : 64, samples: quick ? 16 : software ? 64 : 1024, runs: 4 };
    const figures: Figure[] = [];
    let worst = 0;
    for (const material of MATERIALS) {
      for (const roughness of ROUGHNESSES) {
        const { whole, rim } = await measureFurnace(device, material, roughness, settings);
        const figure = estimated(`${material}, roughness ${roughness}: light returned`, '1', whole);
        figures.push(figure, estimated(`${material}, roughness ${roughness}: light returned at the rim`, '1', rim));
        worst = Math.max(worst, Math.abs((figure.mean as number) - 1));
        log(`${material} ${roughness}: ${figure.mean!.toFixed(5)} ± ${figure.ci95!.toFixed(5)}`);
      }
    }
    figures.push({
      name: 'largest distance from 1',
      unit: '1',
      runs: 1,
      mean: worst,
      ci95: 0,
      target: { value: 0.01, relation: '<=', source: 'white furnace within 1 %' },
    });
    device.destroy();
    return {
      settings: { ...settings, multipleScattering: true, radiance: 1 },
      gpu: { name: adapterName, software },
      figures,
    };
  },
};
