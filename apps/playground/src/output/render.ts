import type { PathTracer } from '@glanz/renderer';
import type { Camera } from '@glanz/scene';
import { renderImage } from '@glanz/viewer/render-image';
import type { Context } from '../ui/context';
import { showRenderDialog, type RenderFormat, type RenderRequest } from '../ui/render-dialog';
import { fileName, imageAsExr, imageAsPng, type SavedBackdrop } from './save';
import { whilePaused } from './while-paused';

const FORMATS: readonly RenderFormat[] = [
  { id: 'png', title: 'PNG, 8 bits', extension: 'png', type: 'image/png', alpha: true },
  { id: 'png-16', title: 'PNG, 16 bits', extension: 'png', type: 'image/png', alpha: true },
  {
    id: 'exr',
    title: 'EXR, linear, with all layers and light groups',
    extension: 'exr',
    type: 'image/x-exr',
    alpha: true,
  },
];

/** The size of the stage in the screen's own pixels. */
function screenSize({ stageSize }: Context): readonly [number, number] {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = stageSize().map((side) => Math.max(1, Math.round(side * ratio)));
  return [width as number, height as number];
}

/** What is behind an image of this shape. @param camera Default: the camera as it is now. */
export type BackdropFor = (
  aspect: number,
  camera?: Camera,
) => SavedBackdrop | undefined | Promise<SavedBackdrop | undefined>;

async function write(
  tracer: PathTracer,
  { format, signal }: RenderRequest,
  { session: { engine }, store }: Context,
  backdrop: SavedBackdrop | undefined,
): Promise<Blob> {
  const { exposure, toneMap } = store.state;
  if (format === 'exr') return new Blob([await imageAsExr(tracer)], { type: 'image/x-exr' });
  const bits = format === 'png-16' ? 16 : 8;
  return new Blob([await imageAsPng(engine, tracer, { exposure, toneMap }, bits, backdrop, signal)], {
    type: 'image/png',
  });
}

/** Opens the dialog that renders the image at any size. The screen's image waits meanwhile, and keeps its samples. */
export function openRenderDialog(context: Context, backdropFor: BackdropFor, format?: string): void {
  const { session, store, opened } = context;
  const { samples, noise, background } = store.state;
  showRenderDialog({
    name: fileName(opened().title),
    screen: screenSize(context),
    samples,
    noise,
    transparent: background === 'transparent',
    formats: FORMATS,
    format,
    render: async (request) => {
      const { width, height, transparent } = request;
      const now = store.state.background;
      const composed = !transparent && (now === 'color' || now === 'blurred');
      const backdrop = composed ? await backdropFor(width / height) : undefined;
      return whilePaused(session, async () => {
        const tracer = await renderImage(session.engine, {
          ...request,
          background: transparent || composed ? 'transparent' : 'environment',
        });
        try {
          return await write(tracer, request, context, backdrop);
        } finally {
          tracer.destroy();
        }
      });
    },
  });
}
