import type { PathTracer } from '@glanz/renderer';
import { PUSH_BUTTON_KIT } from '@glanz/models';
import type { Values } from '../state/state';
import type { Configuration } from './catalogue';

type Rgb = readonly [number, number, number];

/** What a button is made of: parts that are there, heights of legends, values of materials. */
export interface Assembly {
  readonly visible: ReadonlySet<string>;
  /** Metres along the axis. */
  readonly heights: ReadonlyMap<string, number>;
  readonly materials: Readonly<Record<string, Values>>;
}

const LENS_NAMES: Readonly<Record<string, string>> = { F: 'flush', R: 'raised', D: 'domed', M: 'mushroom' };
const LEGEND_NAMES: Readonly<Record<string, string>> = {
  P: 'power',
  I: 'start',
  O: 'stop',
  S: 'run',
  H: 'halt',
  A: 'arrow',
  U: 'plus',
};
const BEZEL_NAMES: Readonly<Record<string, string>> = { R: 'round', S: 'slim', Q: 'square' };
const MOUNTING_NAMES: Readonly<Record<string, string>> = { P: 'plate', D: 'round', E: 'lid' };

/** Linear Rec.709. */
const LENS_COLOURS: Readonly<Record<string, Rgb>> = {
  G: [0.012, 0.33, 0.08],
  R: [0.46, 0.012, 0.012],
  Y: [0.78, 0.4, 0.006],
  B: [0.012, 0.09, 0.5],
  O: [0.72, 0.11, 0.006],
  W: [0.78, 0.77, 0.74],
  S: [0.25, 0.26, 0.28],
  K: [0.014, 0.014, 0.016],
};
const LIGHT_COLOURS: Readonly<Record<string, Rgb>> = {
  G: [0.12, 1, 0.32],
  R: [1, 0.06, 0.04],
  Y: [1, 0.46, 0.05],
  B: [0.08, 0.27, 1],
  W: [1, 0.96, 0.88],
};

/** Both have the same parameters, so that any choice takes back what another one said. */
const surface = (base_color: Rgb, base_metalness: number, specular_roughness: number): Values => ({
  base_color,
  base_metalness,
  specular_roughness,
});
const FINISHES: Readonly<Record<string, Values>> = {
  C: surface([0.77, 0.78, 0.8], 1, 0.12),
  S: surface([0.6, 0.6, 0.59], 1, 0.34),
  K: surface([0.07, 0.072, 0.08], 1, 0.18),
  M: surface([0.887, 0.69, 0.33], 1, 0.2),
  W: surface([0.78, 0.77, 0.74], 0, 0.3),
};
const PANELS: Readonly<Record<string, Values>> = {
  A: surface([0.56, 0.57, 0.59], 1, 0.36),
  K: surface([0.022, 0.022, 0.024], 0, 0.45),
  S: surface([0.62, 0.61, 0.58], 1, 0.22),
  G: surface([0.58, 0.61, 0.585], 0, 0.42),
  Y: surface([0.86, 0.51, 0.004], 0, 0.38),
};

const UNLIT = 0;

/** What a configuration is made of. */
export function assemblyOf(configuration: Configuration): Assembly {
  const { shape, legend, bezel, mounting, light, contacts } = configuration;
  const { lenses, mountings, blocks, materials } = PUSH_BUTTON_KIT;
  const lens = LENS_NAMES[shape] ?? 'flush';
  const sign = LEGEND_NAMES[legend];
  const lit = LIGHT_COLOURS[light];
  const visible = new Set([
    `Lens ${lens}`,
    ...(sign ? [`Legend ${sign}`] : []),
    `Bezel ${BEZEL_NAMES[bezel] ?? 'round'}`,
    ...(mountings[MOUNTING_NAMES[mounting] ?? ''] ?? []),
    ...(contacts === 'X' ? [] : blocks['Contact block NO']),
    ...(contacts === 'O' ? [] : blocks['Contact block NC']),
    ...(lit ? blocks['Lamp block'] : []),
  ]);
  const colour = LENS_COLOURS[configuration.colour] ?? [0.5, 0.5, 0.5];
  const pale = configuration.colour === 'W' || configuration.colour === 'Y';
  const glow: Rgb = [0, 1, 2].map((k) => Math.sqrt((colour[k] ?? 0) * (lit?.[k] ?? 0))) as unknown as Rgb;
  return {
    visible,
    // A tenth of a millimetre deep in the lens.
    heights: new Map(sign ? [[`Legend ${sign}`, (lenses[lens] ?? 0.0084) - 0.0001]] : []),
    materials: {
      [materials.lens]: { base_color: colour, emission_color: glow, emission_luminance: lit ? 0.22 : UNLIT },
      [materials.halo]: {
        base_color: lit ? [0.55, 0.56, 0.55] : [0.62, 0.62, 0.6],
        emission_color: lit ?? [1, 1, 1],
        emission_luminance: lit ? 3.2 : UNLIT,
      },
      [materials.legend]: {
        base_color: pale ? [0.016, 0.016, 0.017] : [0.8, 0.8, 0.8],
        emission_color: [1, 1, 1],
        emission_luminance: lit && !pale ? 1.4 : UNLIT,
      },
      [materials.bezel]: FINISHES[configuration.finish] ?? {},
      [materials.panel]: PANELS[configuration.panel] ?? {},
    },
  };
}

/** Names of all parts that some choice shows or hides. */
export function optionalParts(): ReadonlySet<string> {
  const { lenses, legends, bezels, mountings, blocks } = PUSH_BUTTON_KIT;
  return new Set([
    ...Object.keys(lenses).map((name) => `Lens ${name}`),
    ...legends.map((name) => `Legend ${name}`),
    ...bezels.map((name) => `Bezel ${name}`),
    ...Object.values(mountings).flat(),
    ...Object.values(blocks).flat(),
  ]);
}

const same = (a: unknown, b: unknown) => JSON.stringify(a) === JSON.stringify(b);

/**
 * Brings a tracer from one assembly to another by the edits that differ, no more.
 *
 * @param before Undefined: all parts of the kit are there.
 * @returns How many edits it took.
 */
export async function assemble(tracer: PathTracer, next: Assembly, before: Assembly | undefined): Promise<number> {
  let edits = 0;
  const run = async (edit: Promise<void>) => {
    edits++;
    await edit;
  };
  for (const [name, height] of next.heights) {
    if (before?.heights.get(name) !== height)
      await run(tracer.setInstanceTransform(name, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, height, 1]));
  }
  // First what appears, so that there is something to see at any time.
  const all = optionalParts();
  const was = before?.visible ?? all;
  const appear = [...all].filter((name) => next.visible.has(name) && !was.has(name));
  const vanish = [...all].filter((name) => !next.visible.has(name) && was.has(name));
  if (appear.length > 0) await run(tracer.setVisibility(appear, true));
  if (vanish.length > 0) await run(tracer.setVisibility(vanish, false));
  for (const [name, values] of Object.entries(next.materials))
    if (!same(values, before?.materials[name])) await run(tracer.setMaterial(name, values));
  return edits;
}
