import type { MemoryReport, RenderStatistics } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import { element } from './elements';

const whole = new Intl.NumberFormat('en');
const ms = (value: number) =>
  value < 10 ? `${value.toFixed(1)} ms` : value < 10_000 ? `${Math.round(value)} ms` : `${(value / 1000).toFixed(1)} s`;
const mebibytes = (bytes: number) => `${(bytes / 1048576).toFixed(bytes < 10485760 ? 1 : 0)} MiB`;

/** A number of something per second: `12 M/s`. */
const spokenMany = (rate: number) =>
  rate >= 1e9
    ? `${(rate / 1e9).toPrecision(3)} G/s`
    : rate >= 1e6
      ? `${(rate / 1e6).toPrecision(3)} M/s`
      : `${(rate / 1e3).toPrecision(3)} k/s`;

const PURPOSES = [
  ['shapes', 'Geometry', '#7c9cc0'],
  ['textures', 'Textures', '#7fb08a'],
  ['environment', 'Environment', '#d9a441'],
  ['paths', 'Paths', '#b884b0'],
  ['film', 'Film', '#cf7b62'],
] as const satisfies readonly (readonly [keyof MemoryReport, string, string])[];

/** Figures of the scene, its preparation and the speed. */
export class StatisticsPanel {
  readonly element = element('div', {});
  readonly #list = element('dl', { id: 'statistics', class: 'figures' });
  readonly #bar = element('div', { class: 'memory-bar', 'aria-hidden': 'true' });
  readonly #legend = element('div', { class: 'legend' });
  readonly #warnings = element('ul', { id: 'warnings', class: 'warnings' });

  constructor() {
    this.element.append(this.#list, this.#bar, this.#legend, this.#warnings);
  }

  show(
    scene: Scene,
    statistics: RenderStatistics,
    film: readonly [number, number],
    adapter: string,
    sampleMs: number | undefined,
    raysPerSecond: number | undefined,
  ): void {
    const rows: [key: string, title: string, value: string][] = [
      ['sample', 'A sample takes', sampleMs === undefined ? '…' : ms(sampleMs)],
      ['paths', 'Camera paths', sampleMs === undefined ? '…' : spokenMany((film[0] * film[1] * 1000) / sampleMs)],
      ['rays', 'Rays', raysPerSecond === undefined ? '…' : spokenMany(raysPerSecond)],
      ['film', 'Film', `${film[0]} × ${film[1]}`],
      ['triangles', 'Triangles', whole.format(statistics.triangles)],
      ['instances', 'Parts', whole.format(statistics.instances)],
      ['materials', 'Materials', whole.format(scene.materials.length)],
      ['textures', 'Textures', whole.format(scene.textures.length)],
      ['lights', 'Light sources', whole.format(statistics.lights)],
      ['bvh', 'BVH build time', ms(statistics.bvhMs)],
      ['upload', 'Upload time', ms(statistics.uploadMs)],
      ['compile', 'Shader compile time', ms(statistics.compileMs)],
      ['adapter', 'GPU', adapter],
      ['memory', 'GPU memory', mebibytes(statistics.gpuBytes)],
    ];
    this.#list.replaceChildren(
      ...rows.flatMap(([key, name, value]) => [
        element('dt', {}, name),
        element('dd', { 'data-statistic': key }, value),
      ]),
    );
    const { memory } = statistics;
    const parts = PURPOSES.filter(([name]) => memory[name] > 0);
    this.#bar.replaceChildren(
      ...parts.map(([name, , colour]) =>
        element('span', {
          style: `width:${(100 * memory[name]) / Math.max(1, statistics.gpuBytes)}%;background:${colour}`,
        }),
      ),
    );
    this.#legend.replaceChildren(
      ...parts.map(([name, title, colour]) =>
        element('span', {}, element('i', { style: `background:${colour}` }), `${title} ${mebibytes(memory[name])}`),
      ),
    );
    this.#warnings.replaceChildren(...scene.warnings.map(({ message }) => element('li', {}, message)));
  }
}
