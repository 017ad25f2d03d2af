import type { PathTracer } from '@glanz/renderer';
import type { Mesh, Scene } from '@glanz/scene';

// #region catalogue
/** A choice of an option: the parts that it shows, and their materials. */
export interface Choice {
  readonly name: string;
  readonly shows?: readonly string[];
  readonly materials?: Readonly<Record<string, string>>;
}

export interface Option {
  readonly name: string;
  readonly choices: readonly Choice[];
}

/** Number of possible assemblies of a catalogue. */
export const assemblies = (options: readonly Option[]) =>
  options.reduce((product, { choices }) => product * choices.length, 1);
// #endregion catalogue

// #region choose
/**
 * Shows one choice of an option and hides the others; returns the milliseconds
 * until the image restarted.
 */
export async function choose(
  tracer: PathTracer,
  option: Option,
  name: string,
): Promise<number> {
  const start = performance.now();
  const chosen = option.choices.find((choice) => choice.name === name);
  if (!chosen) throw new RangeError(`${option.name} has no choice ${name}`);
  const edits = option.choices.flatMap(({ shows = [] }) =>
    shows.map((part) =>
      tracer.setVisibility(part, chosen.shows?.includes(part) ?? false),
    ),
  );
  for (const [part, material] of Object.entries(chosen.materials ?? {}))
    edits.push(tracer.setInstanceMaterial(part, material));
  await Promise.all(edits);
  return performance.now() - start;
}
// #endregion choose

// #region legend
/**
 * A part whose mesh is generated on demand, such as an engraved legend: only its
 * own hierarchy is built.
 */
export const engrave = (tracer: PathTracer, mesh: Mesh) =>
  tracer.replaceMesh('legend', mesh);
// #endregion legend

// #region address
/** The assembly in the page's URL, as a link to share. */
export const toAddress = (choices: Readonly<Record<string, string>>) =>
  `#${new URLSearchParams(choices)}`;
export const fromAddress = (hash: string): Record<string, string> =>
  Object.fromEntries(new URLSearchParams(hash.replace(/^#/, '')));
// #endregion address

// #region hidden
/**
 * All parts in one scene: a hidden part uses memory on the CPU only, until it is
 * shown for the first time.
 */
export function withHidden(scene: Scene, hidden: ReadonlySet<string>): Scene {
  return {
    ...scene,
    instances: scene.instances.map((instance) => ({
      ...instance,
      visible: !hidden.has(instance.name),
    })),
  };
}
// #endregion hidden
