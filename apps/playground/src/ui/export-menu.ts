import type { BackdropFor } from '../output/render';
import { download, fileName, imageAsExr, imageAsPng, type SavedBackdrop } from '../output/save';
import type { Context } from './context';
import { byId, element } from './elements';
import { item } from './menu-item';

/** Saves images, videos, models and materials. */
export function exportMenu(
  context: Context,
  backdrop: () => SavedBackdrop | undefined,
  backdropFor: BackdropFor,
): HTMLElement[] {
  const { session, store, opened, selection, fail } = context;
  const name = () => fileName(opened().title);
  const render = async (format?: string) => {
    const { openRenderDialog } = await import('../output/render');
    byId('export-menu').hidePopover();
    openRenderDialog(context, backdropFor, format);
  };
  const png = (bits: 8 | 16) => async () => {
    const { tracer, current } = session;
    const { exposure, toneMap } = store.state;
    // While something moves, the film is that of the preview, which may be much smaller than the screen.
    if (!tracer || !current) return render(bits === 8 ? 'png' : 'png-16');
    const bytes = await imageAsPng(session.engine, tracer, { exposure, toneMap }, bits, backdrop());
    download(bytes, `${name()}.png`, 'image/png');
  };
  return [
    element('h2', {}, 'Image'),
    item('render-image', 'Render image …', 'At any size, to a file or the clipboard', () => render(), fail),
    item('save-png', 'Save PNG', '8 bits per channel, as displayed', png(8), fail),
    item('save-png-16', 'Save 16-bit PNG', 'Tone-mapped, for retouching', png(16), fail),
    item(
      'save-exr',
      'Save EXR',
      'Linear, with all layers and light groups',
      async () => {
        if (!session.tracer || !session.current) return render('exr');
        download(await imageAsExr(session.tracer), `${name()}.exr`, 'image/x-exr');
      },
      fail,
    ),
    element('h2', {}, 'Video'),
    item(
      'record-video',
      'Record video …',
      'A turntable, an animation or a camera walk, as MP4 or WebM',
      async () => {
        const { openVideoDialog } = await import('../output/video');
        byId('export-menu').hidePopover();
        openVideoDialog(context, backdropFor);
      },
      fail,
    ),
    element('h2', {}, 'Model'),
    item(
      'save-gltf',
      'Save glTF',
      'The model with edited materials and moved parts',
      async () => {
        const { modelAsGltf } = await import('../output/model-as-gltf');
        const { bytes, extension, note } = await modelAsGltf(opened(), store.state);
        if (note) context.say(note);
        download(bytes, `${name()}-edited.${extension}`, extension === 'glb' ? 'model/gltf-binary' : 'model/gltf+json');
      },
      fail,
    ),
    item(
      'save-mtlx',
      'Save MaterialX',
      'The selected material as .mtlx',
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
