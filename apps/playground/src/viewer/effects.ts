import { OPENPBR_PARAMETER_SPECS, type OpenPbrParameterName } from '@glanz/openpbr/parameters';
import type { Environment, Scene } from '@glanz/scene';
import type { State, Values } from '../state/state';
import type { CameraRig } from './camera-rig';
import { composeScene, needsTracer } from './compose';
import { placedTransform } from './placement';
import type { Session, Shown } from './session';

/** What effects need to know of the page. */
export interface EffectsHost {
  readonly session: Session;
  readonly rig: CameraRig;
  /** As loaded. */
  readonly scene: () => Scene | undefined;
  readonly state: () => State;
  readonly environment: (state: State, scene: Scene) => Environment | undefined;
  readonly onError: (error: unknown) => void;
}

/** Whether the film keeps its background empty: the page then puts something behind it. */
export const filmBackground = ({ background }: Pick<State, 'background'>): 'environment' | 'transparent' =>
  background === 'environment' ? 'environment' : 'transparent';

/** What a tracer is made from for a state. */
export function shownFor(scene: Scene, state: State, host: Pick<EffectsHost, 'rig' | 'environment'>): Shown {
  return {
    scene: composeScene(scene, state, host.environment(state, scene), host.rig.boundsOf(scene)),
    camera: host.rig.camera(state, scene),
    maxDepth: state.maxDepth,
    background: filmBackground(state),
    lightGroups: state.relight ? 'each' : 'named',
    // The guides of the denoiser, which comes later.
    aovs: state.denoise ? ['albedo', 'normal'] : [],
    ready: async (tracer) => {
      if (state.variant !== null && scene.variants?.includes(state.variant)) await tracer.setVariant(state.variant);
      const known = new Set(tracer.lightGroups.map(({ name }) => name));
      for (const [name, settings] of Object.entries(state.groups))
        if (known.has(name)) await tracer.setLightGroup(name, settings);
    },
  };
}

/** The values that bring a material from one edit to another: what the second does not say is as loaded. */
export function materialChange(loaded: Values, next: Values = {}, before: Values = {}): Values {
  const names = new Set([...Object.keys(next), ...Object.keys(before)] as OpenPbrParameterName[]);
  const change: Partial<Record<OpenPbrParameterName, unknown>> = {};
  for (const name of names) {
    const value = next[name] ?? loaded[name] ?? OPENPBR_PARAMETER_SPECS[name].default;
    if (JSON.stringify(value) !== JSON.stringify(before[name] ?? loaded[name] ?? OPENPBR_PARAMETER_SPECS[name].default))
      change[name] = value;
  }
  return change as Values;
}

/** Shows a scene in the state that it has when its tracer is made, and what was changed until it was there. */
export async function present(
  scene: Scene,
  state: () => State,
  host: EffectsHost,
  onProgress?: Parameters<Session['show']>[1],
): Promise<void> {
  let used = state();
  await host.session.show(() => shownFor(scene, (used = state()), host), onProgress);
  if (host.state() !== used && host.scene() === scene) applyChange(host.state(), used, host);
}

const ENVIRONMENT_FIELDS = [
  'environment',
  'studio',
  'boxes',
  'constant',
  'intensity',
  'rotation',
] as const satisfies readonly (keyof State)[];

/** Brings what a change of state calls for to the session, and no more. */
export function applyChange(next: State, before: State, host: EffectsHost): void {
  const { session, rig, onError } = host;
  const scene = host.scene();
  const changed = (...fields: (keyof State)[]) => fields.some((field) => next[field] !== before[field]);
  if (changed('exposure', 'toneMap', 'samples', 'noise', 'layer')) {
    const { exposure, toneMap, samples, noise, layer } = next;
    session.setView({ exposure, toneMap, samples, noise, layer }).catch(onError);
  }
  if (!scene) return;
  const hidden = new Set(next.hidden);
  const wasHidden = new Set(before.hidden);
  const flipped = [...new Set([...hidden, ...wasHidden])].filter((index) => hidden.has(index) !== wasHidden.has(index));
  const moved = [...new Set([...Object.keys(next.moves), ...Object.keys(before.moves)])]
    .filter((index) => next.moves[index] !== before.moves[index])
    .map(Number);
  if (needsTracer(next, before)) {
    present(scene, host.state, host).catch(onError);
    return;
  }
  // One edit each, of however many parts: those of edits that wait for the same frame add up.
  if (flipped.length > 0)
    session.edit(
      'visible',
      async (tracer, merged) => {
        const parts = Object.entries(merged as Record<string, boolean>);
        for (const shown of [true, false]) {
          const those = parts.filter(([, visible]) => visible === shown).map(([index]) => Number(index));
          if (those.length > 0) await tracer.setVisibility(those, shown);
        }
      },
      Object.fromEntries(flipped.map((index) => [index, !hidden.has(index)])),
    );
  if (moved.length > 0)
    session.edit(
      'moves',
      (tracer, merged) => {
        const parts = Object.keys(merged).map(Number);
        const place = (index: number) => placedTransform(host.scene() ?? scene, index, next.moves);
        return tracer.setInstanceTransforms(parts.map((index) => [index, place(index)]));
      },
      Object.fromEntries(moved.map((index) => [index, true])),
    );
  if (changed('materials')) {
    for (const index of new Set([...Object.keys(next.materials), ...Object.keys(before.materials)])) {
      if (next.materials[index] === before.materials[index]) continue;
      const change = materialChange(
        scene.materials[Number(index)]?.parameters ?? {},
        next.materials[index],
        before.materials[index],
      );
      if (Object.keys(change).length > 0)
        session.edit(
          `material ${index}`,
          (tracer, merged) => tracer.setMaterial(Number(index), merged as Values),
          change,
        );
    }
  }
  if (changed('variant')) session.edit('variant', (tracer) => tracer.setVariant(next.variant ?? undefined));
  if (changed('maxDepth')) session.setDepth(next.maxDepth);
  if (filmBackground(next) !== filmBackground(before)) session.setBackground(filmBackground(next));
  if (changed(...ENVIRONMENT_FIELDS)) {
    const environment = host.environment(next, scene);
    session.edit('environment', (tracer) => tracer.setEnvironment(environment));
  }
  if (changed('groups') && next.relight) {
    for (const name of new Set([...Object.keys(before.groups), ...Object.keys(next.groups)])) {
      const requested = next.groups[name] ?? { intensity: 1, color: [1, 1, 1] as const };
      if (requested !== before.groups[name])
        session.relight((tracer) =>
          tracer.lightGroups.some((group) => group.name === name)
            ? tracer.setLightGroup(name, requested)
            : Promise.resolve(),
        );
    }
  }
  if (changed('camera', 'orbit', 'lens')) {
    rig.follow();
    session.look();
  }
}
