import type { BackdropFor } from '../output/render';
import type { SavedBackdrop } from '../output/save';
import { cameraPanel } from './camera-panel';
import type { Context } from './context';
import { byId, element } from './elements';
import { exportMenu } from './export-menu';
import { lightPanel } from './light-panel';
import { MaterialInspector } from './material/inspector';
import { renderPanel } from './render-panel';
import { SceneTree } from './scene-tree';

/** Presets are open from the start in windows that are so wide. */
const WIDE = '(min-width: 1100px)';

/** Presets are a list of their own, fetched when they are first looked at: on wide screens at once. */
function presets(context: Context): HTMLElement {
  const place = element('div', { class: 'fields' });
  const details = element(
    'details',
    { class: 'group', id: 'presets-group', open: matchMedia(WIDE).matches },
    element('summary', {}, 'Presets'),
    place,
  );
  details.addEventListener('toggle', () => {
    if (details.open && place.childElementCount === 0)
      void import('./material/presets').then(
        ({ presetGrid }) => place.replaceChildren(presetGrid(context)),
        context.fail,
      );
  });
  return details;
}

/** A menu whose contents are fetched when it is first opened. */
function lateMenu(id: string, load: () => Promise<HTMLElement[]>, fail: (error: unknown) => void): void {
  const menu = byId(id);
  let loading: Promise<void> | undefined;
  menu.addEventListener('beforetoggle', () => {
    loading ??= load().then(
      (contents) => menu.replaceChildren(...contents),
      (error: unknown) => {
        loading = undefined;
        fail(error);
      },
    );
  });
}

/** Makes all panels: not needed for the first image, so not in the first script. */
export function makePanels(
  context: Context,
  backdrop: () => SavedBackdrop | undefined,
  backdropFor: BackdropFor,
): void {
  byId('scene-panel').append(...new SceneTree(context).elements);
  // Tools come with the first part that is chosen.
  let tools: Promise<void> | undefined;
  context.selection.subscribe(({ instance }) => {
    if (instance !== undefined)
      tools ??= import('./transform-panel').then(
        ({ transformPanel }) => byId('scene-panel').append(transformPanel(context)),
        context.fail,
      );
  });
  byId('panel-material').append(new MaterialInspector(context, presets(context)).element);
  byId('panel-light').append(...lightPanel(context));
  byId('panel-camera').append(...cameraPanel(context));
  byId('panel-render').append(...renderPanel(context));
  byId('export-menu').append(...exportMenu(context, backdrop, backdropFor));
  lateMenu('share-menu', async () => (await import('./share-menu')).shareMenu(context), context.fail);
  lateMenu('gallery-menu', async () => (await import('./sample-gallery')).sampleGallery(context), context.fail);
  lateMenu('looks-menu', async () => (await import('./looks/looks-menu')).looksMenu(context), context.fail);
}
