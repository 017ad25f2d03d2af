import type { Scene } from '@glanz/scene';
import type { LinkContent } from '../state/link';
import { forAnotherModel, type State, type Values } from '../state/state';
import { loadScene } from './load-scene';
import type { GroupedScene, ModelRequest } from './load-messages';
import { SAMPLES, type SampleName } from './samples';

/** A model as it was loaded. */
export interface Opened {
  readonly scene: GroupedScene;
  readonly request: ModelRequest;
  readonly title: string;
  /** Name in links: that of the sample, or of the file. */
  readonly name: string;
}

export const isSample = (name: string): name is SampleName => Object.hasOwn(SAMPLES, name);

/** Short title of a sample. */
export const sampleTitle = (name: SampleName): string => SAMPLES[name].title.split(' · ')[0] as string;

/** What a request is called in links. */
export const nameOf = (request: ModelRequest): string =>
  request.kind === 'sample' ? request.name : (request.entry.split('/').at(-1) ?? request.entry);

/**
 * The state in which a model is first seen.
 *
 * @param before The state until now.
 * @param link What a link says of this model, which goes over all else.
 * @param first Whether nothing was shown before: the address decides then, later the model.
 */
export function stateFor(
  scene: Scene,
  request: ModelRequest,
  before: State,
  { link, first }: { readonly link?: LinkContent | undefined; readonly first: boolean },
): State {
  const requested =
    request.kind === 'sample'
      ? SAMPLES[request.name].environment
      : scene.environment
        ? 'model'
        : before.environment === 'none' || before.environment === 'model'
          ? 'studio'
          : before.environment;
  // An image that the user brought lights whatever comes.
  const environment = first || before.environment === 'file' ? before.environment : requested;
  // Of a file it is not known whether it brings a ground: the floor stays as it is.
  const floor = first || request.kind !== 'sample' ? before.floor : SAMPLES[request.name].floor;
  const state: State = { ...forAnotherModel(before), environment, floor, camera: scene.cameras.length > 0 ? 0 : -1 };
  if (link?.model !== nameOf(request)) return state;
  const { materials = {}, hidden = [], variant = null, clip = null, ...others } = link.state;
  return {
    ...state,
    // Links leave out what a state begins with, and that is no floor.
    floor: false,
    ...others,
    materials: checkedMaterials(scene, materials),
    hidden: hidden.filter((index) => Number.isInteger(index) && scene.instances[index] !== undefined),
    variant: scene.variants?.includes(variant ?? '') ? variant : null,
    clip: clip !== null && scene.animations?.[clip] ? clip : null,
    camera: scene.cameras[link.state.camera ?? state.camera] ? (link.state.camera ?? state.camera) : -1,
  };
}

function checkedMaterials(scene: Scene, materials: State['materials']): State['materials'] {
  return Object.fromEntries(
    Object.entries(materials).filter(
      ([index, values]) => scene.materials[Number(index)] && typeof values === 'object' && values !== null,
    ),
  );
}

/** A link that was opened. */
export interface OpenedLink extends LinkContent {
  /** What it was made with and does not hold; empty where it holds everything. */
  readonly note: string;
}

/** The link in the page's address, with values of materials that its table allows. */
export async function linkOfPage(): Promise<OpenedLink | undefined> {
  if (location.hash.length <= 1) return undefined;
  const [{ decodeLink }, { textForReceiver }] = await Promise.all([
    import('../state/link'),
    import('../state/link-texts'),
  ]);
  const content = await decodeLink(location.hash);
  const link = content && { ...content, note: textForReceiver(content, !isSample(content.model)) };
  if (!link?.state.materials) return link;
  const { validateParameters } = await import('@glanz/openpbr/parameters');
  const materials: Record<string, Values> = {};
  for (const [index, values] of Object.entries(link.state.materials)) {
    try {
      materials[index] = validateParameters(values).parameters;
    } catch {
      // A value of another type: the material stays as it is.
    }
  }
  return { ...link, state: { ...link.state, materials } };
}

/** Loads what a request asks for. */
export async function open(
  request: ModelRequest,
  title: string,
  options: Parameters<typeof loadScene>[1],
): Promise<Opened> {
  return { scene: await loadScene(request, options), request, title, name: nameOf(request) };
}
