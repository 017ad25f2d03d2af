import type { ImageProgress } from '@glanz/viewer';
import { MAX_ADAPTIVE_SAMPLES } from '@glanz/renderer/options';
import { toClipboard } from '../output/clipboard';
import { download } from '../output/save';
import { LIMITS } from '../state/limits';
import { element } from './elements';
import { below, numberBox, row, select, waitText, workDialog } from './work-dialog';

/** A kind of file that a page can write. */
export interface RenderFormat {
  readonly id: string;
  readonly title: string;
  readonly extension: string;
  readonly type: string;
  /** Whether it has an alpha channel. */
  readonly alpha: boolean;
}

/** What the dialog asks for. */
export interface RenderRequest {
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  /** Samples per pixel; the maximum where `noise` is given. */
  readonly samples: number;
  /** Relative noise to reach. */
  readonly noise: number | undefined;
  readonly transparent: boolean;
  readonly format: string;
  readonly signal: AbortSignal;
  readonly onProgress: (progress: ImageProgress) => void;
}

/** The page around the dialog. */
export interface RenderHost {
  /** File name without its extension. */
  readonly name: string;
  /** Pixels of the image on the screen, and what the dialog begins with. */
  readonly screen: readonly [number, number];
  readonly samples: number;
  /** 0: none. */
  readonly noise: number;
  readonly transparent: boolean;
  readonly formats: readonly RenderFormat[];
  /** That of the dialog's first choice; default: the first. */
  readonly format?: string | undefined;
  readonly render: (request: RenderRequest) => Promise<Blob>;
}

const [MAX_SIDE, MIN_NOISE] = [16_384, 0.001];
/** What a noise target begins with. */
const USUAL_NOISE = 0.02;

const SIZES: readonly (readonly [title: string, width: number, height: number])[] = [
  ['Full HD', 1920, 1080],
  ['4K', 3840, 2160],
  ['Square', 2048, 2048],
  ['A4 at 300 dpi', 2480, 3508],
];

const sizeText = (width: number, height: number) => `${width} × ${height}`;

/**
 * Shows a dialog that renders the image at any size, to a file or the clipboard. It is removed from the page when it
 * closes.
 */
export function showRenderDialog(host: RenderHost): void {
  const [screenWidth, screenHeight] = host.screen;
  const size = select(
    'render-size',
    [
      ['screen', `Screen, ${sizeText(screenWidth, screenHeight)}`],
      ...SIZES.map(([title, width, height], k) => [String(k), `${title}, ${sizeText(width, height)}`] as const),
      ['own', 'Custom'],
    ],
    'screen',
  );
  const width = numberBox('render-width', 'Width, pixels', screenWidth, [1, MAX_SIDE], 1);
  const height = numberBox('render-height', 'Height, pixels', screenHeight, [1, MAX_SIDE], 1);
  const goal = select(
    'render-goal',
    [
      ['samples', 'Samples per pixel'],
      ['noise', 'Noise target'],
    ],
    host.noise > 0 ? 'noise' : 'samples',
  );
  const samples = numberBox('render-samples', 'Samples per pixel', host.samples, LIMITS.samples, 1);
  const noise = numberBox(
    'render-noise',
    'Noise, relative',
    host.noise || USUAL_NOISE,
    [MIN_NOISE, LIMITS.noise[1]],
    'any',
  );
  const format = select(
    'render-format',
    host.formats.map(({ id, title }) => [id, title]),
    host.format ?? host.formats[0]?.id ?? '',
  );
  const transparent = element('input', { type: 'checkbox', id: 'render-transparent' });
  transparent.checked = host.transparent;
  const inputs = element(
    'fieldset',
    {},
    row('Size', 'render-size', size),
    below(width, '×', height, 'pixels'),
    row('Stop at', 'render-goal', goal),
    below(samples, noise),
    row('Format', 'render-format', format),
    row('Transparent background', 'render-transparent', transparent),
  );
  const copy = element('button', { type: 'button', id: 'render-copy' }, 'Copy to clipboard');
  const save = element('button', { type: 'submit', id: 'render-save', class: 'primary' }, 'Save file');
  let working = false;

  const chosen = () => host.formats.find(({ id }) => id === format.value) as RenderFormat;
  const follow = () => {
    const preset = SIZES[Number(size.value)];
    const [w, h] =
      size.value === 'screen' ? host.screen : preset ? [preset[1], preset[2]] : [width.value, height.value];
    [width.value, height.value] = [String(w), String(h)];
    [samples.hidden, noise.hidden] = [goal.value === 'noise', goal.value !== 'noise'];
    transparent.disabled = !chosen().alpha;
    copy.disabled = working || chosen().type !== 'image/png' || typeof ClipboardItem === 'undefined';
    copy.title = chosen().type === 'image/png' ? '' : 'Only PNG can be copied to the clipboard';
  };
  const { open, progress, run } = workDialog({
    name: 'render',
    title: 'Render image',
    progress: 'Rendered',
    inputs,
    actions: [copy, save],
    onBusy: (busy) => {
      working = busy;
      follow();
    },
    submit: () => {
      const name = `${host.name}.${chosen().extension}`;
      void run(async (signal) => {
        download(await render(signal), name, chosen().type);
        return `${name}, ${made()}, is in your downloads.`;
      });
    },
  });

  /** Renders as the dialog says. */
  const render = async (signal: AbortSignal): Promise<Blob> => {
    return host.render({
      width: width.valueAsNumber,
      height: height.valueAsNumber,
      samples: goal.value === 'noise' ? MAX_ADAPTIVE_SAMPLES : samples.valueAsNumber,
      noise: goal.value === 'noise' ? noise.valueAsNumber : undefined,
      transparent: transparent.checked && chosen().alpha,
      format: format.value,
      signal,
      onProgress: ({ samples: done, target, remainingMs, share }) => {
        const left = Number.isFinite(remainingMs) && remainingMs > 0 ? ` · ${waitText(remainingMs)} left` : '';
        progress(share, goal.value === 'noise' ? `${done} samples${left}` : `${done} of ${target} samples${left}`);
      },
    });
  };
  const made = () => sizeText(width.valueAsNumber, height.valueAsNumber);

  copy.addEventListener(
    'click',
    () =>
      void run(async (signal) => {
        const blob = render(signal);
        // Written at once, while the browser still counts the click: the item waits for the image.
        const written = toClipboard(
          () => navigator.clipboard.write([new ClipboardItem({ 'image/png': blob })]),
          'Save the image to a file.',
        );
        written.catch(() => undefined);
        await blob;
        await written;
        return `The image, ${made()}, is on the clipboard.`;
      }),
  );
  for (const one of [size, goal, format]) one.addEventListener('change', follow);
  for (const one of [width, height]) one.addEventListener('input', () => void (size.value = 'own'));
  open();
}
