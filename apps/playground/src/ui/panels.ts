import type { BehindFor } from '../output/render';
import type { Behind } from '../output/save';
import { cameraPanel } from './camera-panel';
import type { Context } from './context';
import { byId, element } from './elements';
import { lightPanel } from './light-panel';
import { MaterialInspector } from './material/inspector';
import { exportMenu, shareMenu } from './menus';
import { renderPanel } from './render-panel';
import { SceneTree } from './scene-tree';

/** Presets are a list of their own, fetched when they are first looked at. */
function presets(context: Context): HTMLElement {
  const place = element('div', { class: 'fields' });
  const details = element('details', { class: 'group', id: 'presets-group' }, element('summary', {}, 'Presets'), place);
  details.addEventListener('toggle', () => {
    if (details.open && place.childElementCount === 0)
      void import('./material/presets').then(
        ({ presetGrid }) => place.replaceChildren(presetGrid(context)),
        context.fail,
      );
  });
  return details;
}

/** Makes all panels: not needed for the first image, so not in the first script. */
export function makePanels(context: Context, behind: () => Behind | undefined, behindFor: BehindFor): void {
  byId('scene-panel').append(...new SceneTree(context).elements);
  byId('panel-material').append(new MaterialInspector(context, presets(context)).element);
  byId('panel-light').append(...lightPanel(context));
  byId('panel-camera').append(...cameraPanel(context));
  byId('panel-render').append(...renderPanel(context));
  byId('export-menu').append(...exportMenu(context, behind, behindFor));
  byId('share-menu').append(...shareMenu(context));
}
