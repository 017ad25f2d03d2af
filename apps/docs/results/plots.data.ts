// The bar chart at the start of each results page, from the benchmarks' files in this folder.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { defineLoader } from 'vitepress';

/** One bar. */
interface Bar {
  readonly label: string;
  readonly value: number;
  /** The value with its unit. */
  readonly text: string;
  readonly kind: 'ours' | 'other' | 'limit';
}

/** Bars that are compared with each other, on a common scale. */
interface Group {
  readonly label: string;
  readonly bars: readonly Bar[];
}

/** A plot: the question that it answers. */
interface Plot {
  readonly question: string;
  readonly better: 'lower' | 'higher';
  readonly groups: readonly Group[];
}

declare const data: Readonly<Record<string, Plot>>;
export { data };

interface Figure {
  readonly name: string;
  readonly min?: number;
  readonly median?: number;
  readonly mean?: number;
  readonly target?: { readonly value: number };
}

const read = (name: string): unknown =>
  JSON.parse(readFileSync(fileURLToPath(new URL(`./${name}.json`, import.meta.url)), 'utf8'));

/** The figures of a benchmark by name. */
function figuresOf(name: string) {
  const all = (read(name) as { figures: readonly Figure[] }).figures;
  const figure = (expected: string): Figure => {
    const found = all.find((one) => one.name === expected);
    if (!found) throw new Error(`${name}.json has no figure "${expected}"`);
    return found;
  };
  return { all, figure, value: (expected: string) => (figure(expected).mean ?? figure(expected).median)! };
}

const rounded = (value: number) => Number(value.toPrecision(3)).toString();
const bar = (label: string, value: number, unit: string, kind: Bar['kind']): Bar => ({
  label,
  value,
  text: `${rounded(value)}${unit === '' ? '' : ` ${unit}`}`,
  kind,
});

function speed(): Plot {
  const { figure, value } = figuresOf('paper-gpu');
  return {
    question: 'How long does a sample of the push-button take, 512 × 512 pixels, on an H200?',
    better: 'lower',
    groups: ['low', 'medium', 'high'].map((level) => {
      const time = `${level}: GPU time per sample`;
      return {
        label: `${value(`${level}: triangles`).toLocaleString('en')} triangles`,
        bars: [
          bar('Glanz', value(time), 'ms', 'ours'),
          // The target is a quarter of what strahl took on the same GPU.
          bar('strahl', 4 * figure(time).target!.value, 'ms', 'other'),
        ],
      };
    }),
  };
}

function hierarchies(): Plot {
  const { value } = figuresOf('bvh');
  return {
    question: 'How long does it take to build the hierarchy of a mesh on one thread?',
    better: 'lower',
    groups: ['push-button 107k', 'push-button 1.07M', 'noisy sphere 1.07M'].map((mesh) => ({
      label: mesh,
      bars: [
        bar('balanced', value(`${mesh}: balanced`), 'ms', 'ours'),
        bar('fast', value(`${mesh}: fast`), 'ms', 'ours'),
        bar('three-mesh-bvh CENTER', value(`${mesh}: three-mesh-bvh CENTER`), 'ms', 'other'),
        bar('three-mesh-bvh SAH', value(`${mesh}: three-mesh-bvh SAH`), 'ms', 'other'),
      ],
    })),
  };
}

function loading(): Plot {
  const { details } = read('loading') as {
    details: {
      rows: readonly {
        model: string;
        place: string;
        times: Readonly<Record<'glanz' | 'worker' | 'three', { median: number }>>;
      }[];
    };
  };
  return {
    question: 'How long does it take to load a file as a scene, in Chromium?',
    better: 'lower',
    groups: details.rows
      .filter(({ place }) => place === 'address')
      .map(({ model, times }) => ({
        label: model,
        bars: [
          bar('loadGltf', times.glanz.median, 'ms', 'ours'),
          bar('GltfWorker', times.worker.median, 'ms', 'ours'),
          bar('three.js', times.three.median, 'ms', 'other'),
        ],
      })),
  };
}

function furnace(): Plot {
  const { all, figure } = figuresOf('furnace');
  const whole = all.filter(({ name }) => name.endsWith(': light returned'));
  const worst = (kind: string) =>
    100 * Math.max(...whole.filter(({ name }) => name.startsWith(kind)).map(({ mean }) => Math.abs(1 - mean!)));
  const limit = 100 * figure('largest distance from 1').target!.value;
  return {
    question: 'How far from 1 is the light that white spheres reflect in a white furnace, at worst?',
    better: 'lower',
    groups: [
      {
        label: 'largest error of the renderer, by material',
        bars: [
          ...['diffuse', 'metal', 'dielectric'].map((kind) => bar(kind, worst(kind), '%', 'ours')),
          bar('limit', limit, '%', 'limit'),
        ],
      },
    ],
  };
}

function materials(): Plot {
  const { furnace: rows } = read('openpbr') as { furnace: Readonly<Record<string, { min: number; max: number }>> };
  const error = (name: string) => 100 * Math.max(Math.abs(1 - rows[name]!.min), Math.abs(rows[name]!.max - 1));
  // Measured with its own code; the same values as in the table of the page.
  const others: readonly (readonly [string, number])[] = [
    ['metal', 3.5],
    ['glass', 1.6],
    ['fuzz over diffuse', 3.2],
    ['anisotropic metal, anisotropy 0.9', 23],
  ];
  return {
    question: 'How far from 1 is the directional albedo of a white surface, at worst?',
    better: 'lower',
    groups: others.map(([name, other]) => ({
      label: name,
      bars: [bar('@glanz/openpbr', error(name), '%', 'ours'), bar('three-gpu-pathtracer 0.0.26', other, '%', 'other')],
    })),
  };
}

function reliability(): Plot {
  const count = (subject: string) => {
    const survived = figuresOf(`faults-${subject}`).all.filter(({ name }) => name.endsWith(': survived'));
    return {
      survived: survived.reduce((sum, { median }) => sum + median!, 0),
      tried: survived.reduce((sum, { target }) => sum + target!.value, 0),
    };
  };
  return {
    question: 'How many of the injected faults does Glanz survive?',
    better: 'higher',
    groups: [
      ['tracer', 'the tracer, in Node'],
      ['viewer', 'the viewer, in Chromium'],
      ['cli', 'the command line'],
    ].map(([subject, label]) => {
      const { survived, tried } = count(subject!);
      return {
        label: label!,
        bars: [
          { label: 'survived', value: survived, text: survived.toLocaleString('en'), kind: 'ours' as const },
          { label: 'injected', value: tried, text: tried.toLocaleString('en'), kind: 'limit' as const },
        ],
      };
    }),
  };
}

function products(): Plot {
  const ratios = figuresOf('products').all.flatMap(({ name, median }) => {
    const [, product] = /^(.+), 512 × 512: noise × wall time/.exec(name) ?? [];
    return product && median ? [{ product, median }] : [];
  });
  return {
    question: 'How many times as long as Glanz does three-gpu-pathtracer take to the same noise, 512 × 512 pixels?',
    better: 'higher',
    groups: [
      {
        label: 'products',
        bars: ratios.map(({ product, median }) => bar(product, median, '×', 'ours')),
      },
    ],
  };
}

export default defineLoader({
  watch: ['./*.json'],
  load: (): Readonly<Record<string, Plot>> => ({
    speed: speed(),
    bvh: hierarchies(),
    loading: loading(),
    truth: furnace(),
    openpbr: materials(),
    reliability: reliability(),
    products: products(),
  }),
});
