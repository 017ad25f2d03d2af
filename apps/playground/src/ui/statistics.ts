import type { RenderStatistics } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import { element } from './elements';

const whole = new Intl.NumberFormat('en');
const ms = (value: number) => (value < 10 ? `${value.toFixed(1)} ms` : value < 10_000 ? `${Math.round(value)} ms` : `${(value / 1000).toFixed(1)} s`);

/** Milliseconds as people say them: `12 s`, `3 min 5 s`, `2 h 10 min`. */
export function spokenTime(milliseconds: number): string {
  const seconds = Math.ceil(milliseconds / 1000);
  if (!Number.isFinite(seconds)) return '…';
  if (seconds < 60) return `${seconds} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${seconds % 60} s`;
  return `${Math.floor(seconds / 3600)} h ${Math.floor((seconds % 3600) / 60)} min`;
}

/** Samples per second with as many digits as it deserves. */
export const spokenRate = (rate: number): string => `${rate >= 100 ? Math.round(rate) : rate.toPrecision(2)} samples/s`;

/** Figures of the scene and its preparation. */
export class StatisticsPanel {
  readonly element = element('div', {});
  readonly #list = element('dl', { id: 'statistics' });
  readonly #warnings = element('ul', { id: 'warnings', class: 'warnings' });

  constructor() {
    this.element.append(this.#list, this.#warnings);
  }

  show(scene: Scene, statistics: RenderStatistics, film: readonly [number, number], adapter: string): void {
    const rows: [key: string, title: string, value: string][] = [
      ['triangles', 'Triangles', whole.format(statistics.triangles)],
      ['instances', 'Parts', whole.format(statistics.instances)],
      ['materials', 'Materials', whole.format(scene.materials.length)],
      ['textures', 'Textures', whole.format(scene.textures.length)],
      ['lights', 'Light sources', whole.format(statistics.lights)],
      ['bvh', 'Hierarchy built in', ms(statistics.bvhMs)],
      ['upload', 'Uploaded in', ms(statistics.uploadMs)],
      ['compile', 'Shaders compiled in', ms(statistics.compileMs)],
      ['memory', 'GPU memory', `${(statistics.gpuBytes / 1048576).toFixed(0)} MiB`],
      ['film', 'Film', `${film[0]} × ${film[1]}`],
      ['adapter', 'GPU', adapter],
    ];
    this.#list.replaceChildren(...rows.flatMap(([key, name, value]) => [element('dt', {}, name), element('dd', { 'data-statistic': key }, value)]));
    this.#warnings.replaceChildren(...scene.warnings.map(({ message }) => element('li', {}, message)));
  }
}
