import type { BehindFor } from '../output/render';
import { download, fileName, imageAsExr, imageAsPng, type Behind } from '../output/save';
import { encodeLink, linkContent, LONGEST_LINK, type LinkContent } from '../state/link';
import { textForSender } from '../state/link-texts';
import type { Context } from './context';
import { byId, element } from './elements';

/** One line of a menu: what it does, and a short description. */
function item(
  id: string,
  title: string,
  note: string,
  run: () => void | Promise<void>,
  fail: (error: unknown) => void,
): HTMLButtonElement {
  const button = element('button', { type: 'button', class: 'item', id }, title, element('small', {}, note));
  button.addEventListener('click', async () => {
    button.disabled = true;
    try {
      await run();
    } catch (error) {
      fail(error);
    } finally {
      button.disabled = false;
    }
  });
  return button;
}

/** Images, models and materials to keep. */
export function exportMenu(context: Context, behind: () => Behind | undefined, behindFor: BehindFor): HTMLElement[] {
  const { session, store, opened, selection, fail } = context;
  const name = () => fileName(opened().title);
  const render = async (format?: string) => {
    const { openRenderDialog } = await import('../output/render');
    byId('export-menu').hidePopover();
    openRenderDialog(context, behindFor, format);
  };
  const png = (bits: 8 | 16) => async () => {
    const { tracer, current } = session;
    const { exposure, toneMap } = store.state;
    // While something moves, the film is that of the preview, which may be much smaller than the screen.
    if (!tracer || !current) return render(bits === 8 ? 'png' : 'png-16');
    const bytes = await imageAsPng(session.engine, tracer, { exposure, toneMap }, bits, behind());
    download(bytes, `${name()}.png`, 'image/png');
  };
  return [
    element('h2', {}, 'Image'),
    item('render-image', 'Render image …', 'At any size, to a file or the clipboard', () => render(), fail),
    item('save-png', 'Save PNG', '8 bits, as on the screen', png(8), fail),
    item('save-png-16', 'Save 16-bit PNG', 'Tone-mapped, for retouching', png(16), fail),
    item(
      'save-exr',
      'Save EXR',
      'Linear light, with all layers and lights',
      async () => {
        if (!session.tracer || !session.current) return render('exr');
        download(await imageAsExr(session.tracer), `${name()}.exr`, 'image/x-exr');
      },
      fail,
    ),
    element('h2', {}, 'Model'),
    item(
      'save-gltf',
      'Save glTF',
      'The model with its materials as edited',
      async () => {
        const { modelAsGltf } = await import('../output/gltf-materials');
        const { bytes, extension } = await modelAsGltf(opened(), store.state);
        download(bytes, `${name()}-edited.${extension}`, extension === 'glb' ? 'model/gltf-binary' : 'model/gltf+json');
      },
      fail,
    ),
    item(
      'save-mtlx',
      'Save MaterialX',
      'The chosen material as .mtlx',
      async () => {
        const { materialAsMaterialX } = await import('../output/materialx');
        const { scene } = opened();
        const { material } = selection.chosen;
        download(
          materialAsMaterialX(scene, store.state, material),
          `${fileName(scene.materials[material]?.name ?? 'material')}.mtlx`,
          'application/xml',
        );
      },
      fail,
    ),
  ];
}

/** What a link to the view as it is holds. */
const contentOf = ({ opened, store, environments }: Context): LinkContent =>
  linkContent(opened().name, store.state, environments.fileName);

/** What a link to the view as it is leaves out, in words; empty where it holds everything. */
const leftOutOf = (context: Context): string =>
  textForSender(contentOf(context), context.opened().request.kind === 'files');

/** The address of the view as it is. */
export async function linkTo(context: Context): Promise<string> {
  const link = await encodeLink(contentOf(context));
  return `${location.origin}${location.pathname}#${link}`;
}

async function copy(text: string, say: (text: string) => void, what: string, more = ''): Promise<void> {
  await navigator.clipboard.writeText(text);
  say(`${what} is on the clipboard. ${more}`.trim());
}

/** A link to the view, and a program that makes the same image. */
export function shareMenu(context: Context): HTMLElement[] {
  const { store, opened, rig, session, say, fail } = context;
  const code = element('pre', {
    class: 'snippet',
    id: 'snippet',
    role: 'group',
    tabindex: 0,
    'aria-label': 'Code that makes this image',
  });
  const note = element('p', { class: 'note', id: 'share-note' });
  byId('share-menu').addEventListener('toggle', (event) => {
    if ((event as ToggleEvent).newState !== 'open') return;
    const { scene, name } = opened();
    note.textContent = leftOutOf(context);
    void import('../output/snippet').then(({ codeSnippet }) => {
      const { tracer } = session;
      code.textContent = codeSnippet(
        scene,
        name,
        store.state,
        rig.camera(),
        tracer ? [tracer.width, tracer.height] : [1024, 768],
      );
    }, fail);
  });
  return [
    element('h2', {}, 'Link'),
    item(
      'copy-link',
      'Copy link',
      'Camera, materials, light and settings',
      async () => {
        const link = await linkTo(context);
        await copy(
          link,
          say,
          link.length > LONGEST_LINK ? 'The link, which is too long for some programs,' : 'The link',
          leftOutOf(context),
        );
      },
      fail,
    ),
    note,
    element('h2', {}, 'Code'),
    item(
      'copy-code',
      'Copy code',
      'TypeScript that makes the same image',
      () => copy(code.textContent ?? '', say, 'The code'),
      fail,
    ),
    code,
  ];
}
