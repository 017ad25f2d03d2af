import type { SceneAnimation } from '@glanz/scene';
import type { VideoImage, VideoProgress } from '@glanz/viewer/record';
import { download } from '../output/save';
import { LIMITS } from '../state/limits';
import { element } from './elements';
import { below, numberBox, row, select, waitText, workDialog } from './work-dialog';

export type Motion = 'turntable' | 'animation' | 'walk';

/** What the dialog asks for. */
export interface VideoRequest {
  readonly motion: Motion;
  readonly seconds: number;
  /** Of a turntable; below 0 to the left. */
  readonly degrees: number;
  /** Index of the animation. */
  readonly clip: number;
  /** Pixels, even. */
  readonly width: number;
  readonly height: number;
  readonly fps: number;
  readonly samples: number;
  /** Share of a frame's time in which the shutter is open. */
  readonly shutter: number;
  readonly type: 'video/mp4' | 'video/webm' | undefined;
  readonly signal: AbortSignal;
  readonly onProgress: (progress: VideoProgress) => void;
  readonly onFrame: (frame: VideoImage) => void;
}

/** The page around the dialog. */
export interface VideoHost {
  /** File name without its extension. */
  readonly name: string;
  /** What the dialog begins with. */
  readonly samples: number;
  /** Views of the camera walk. */
  readonly views: number;
  /** Of the model; none: it has none, or they cannot be posed. */
  readonly animations: readonly SceneAnimation[];
  /** The animation that is chosen first. */
  readonly clip: number;
  readonly record: (request: VideoRequest) => Promise<Blob>;
}

const SIZES = [
  ['HD', 1280, 720],
  ['Full HD', 1920, 1080],
  ['4K', 3840, 2160],
  ['Square', 1080, 1080],
  ['Portrait', 1080, 1920],
] as const;
const [MAX_SIDE, MAX_SECONDS, MAX_FPS] = [4096, 600, 120];

/** Shows a dialog that records a video to a file. It is removed from the page when it closes. */
export function showVideoDialog(host: VideoHost): void {
  const { animations, views } = host;
  const motion = select(
    'video-motion',
    [
      ['turntable', 'Turntable'],
      ...(animations.length > 0 ? [['animation', 'Animation'] as const] : []),
      ...(views > 1 ? [['walk', `Camera walk, ${views} views`] as const] : []),
    ],
    animations.length > 0 ? 'animation' : views > 1 ? 'walk' : 'turntable',
  );
  const clip = select(
    'video-clip',
    animations.map(({ name }, i) => [String(i), name || `Animation ${i + 1}`] as const),
    String(host.clip),
  );
  const degrees = numberBox('video-degrees', 'Degrees', 360, [-3600, 3600], 'any');
  const seconds = numberBox('video-seconds', 'Seconds', 4, [0.1, MAX_SECONDS], 'any');
  const fps = numberBox('video-fps', 'Frames a second', 24, [1, MAX_FPS], 1);
  const size = select(
    'video-size',
    [
      ...SIZES.map(([title, width, height], k) => [String(k), `${title}, ${width} × ${height}`] as const),
      ['own', 'Custom'],
    ],
    '0',
  );
  const width = numberBox('video-width', 'Width, pixels', SIZES[0][1], [2, MAX_SIDE], 1);
  const height = numberBox('video-height', 'Height, pixels', SIZES[0][2], [2, MAX_SIDE], 1);
  const samples = numberBox('video-samples', 'Samples per pixel', host.samples, LIMITS.samples, 1);
  const shutter = numberBox('video-shutter', 'Motion blur, fraction of a frame', 0, [0, 1], 'any');
  const format = select(
    'video-format',
    [
      ['', 'MP4, or WebM without H.264'],
      ['video/mp4', 'MP4'],
      ['video/webm', 'WebM'],
    ],
    '',
  );
  const clipRow = row('Animation', 'video-clip', clip);
  const degreesRow = row('Degrees', 'video-degrees', degrees);
  const inputs = element(
    'fieldset',
    {},
    row('Motion', 'video-motion', motion),
    clipRow,
    degreesRow,
    row('Length', 'video-seconds', element('div', { class: 'render-pair' }, seconds, 's at', fps, 'fps')),
    row('Size', 'video-size', size),
    below(width, '×', height, 'pixels'),
    row('Samples per pixel', 'video-samples', samples),
    row('Motion blur', 'video-shutter', shutter),
    row('Format', 'video-format', format),
  );
  const preview = element('canvas', { class: 'video-preview', 'aria-hidden': 'true', hidden: true });
  const save = element('button', { type: 'submit', id: 'video-save', class: 'primary' }, 'Record');

  const ofClip = () => {
    const { duration = 0 } = animations[Number(clip.value)] ?? {};
    if (motion.value === 'animation' && duration > 0) seconds.value = String(Number(duration.toFixed(3)));
  };
  const follow = () => {
    const preset = SIZES[Number(size.value)];
    if (preset) [width.value, height.value] = [String(preset[1]), String(preset[2])];
    clipRow.hidden = motion.value !== 'animation';
    degreesRow.hidden = motion.value !== 'turntable';
  };
  const show = ({ data, width: w, height: h }: VideoImage) => {
    [preview.width, preview.height, preview.hidden] = [w, h, false];
    preview.getContext('2d')?.putImageData(new ImageData(data, w, h), 0, 0);
  };
  const record = async (signal: AbortSignal): Promise<string> => {
    preview.hidden = true;
    for (const side of [width, height]) side.value = String(2 * Math.max(1, Math.round(side.valueAsNumber / 2)));
    const blob = await host.record({
      motion: motion.value as Motion,
      seconds: seconds.valueAsNumber,
      degrees: degrees.valueAsNumber,
      clip: Number(clip.value),
      width: width.valueAsNumber,
      height: height.valueAsNumber,
      fps: fps.valueAsNumber,
      samples: samples.valueAsNumber,
      shutter: shutter.valueAsNumber,
      type: format.value === '' ? undefined : (format.value as 'video/mp4' | 'video/webm'),
      signal,
      onFrame: show,
      onProgress: ({ frames, total, share, remainingMs }) =>
        progress(
          share,
          `${frames} of ${total} frames${remainingMs > 0 && remainingMs < Infinity ? ` · ${waitText(remainingMs)} left` : ''}`,
        ),
    });
    const name = `${host.name}.${blob.type === 'video/mp4' ? 'mp4' : 'webm'}`;
    download(blob, name, blob.type);
    return `${name}, ${width.value} × ${height.value}, is in your downloads.`;
  };
  const { open, progress, run } = workDialog({
    name: 'video',
    title: 'Record video',
    progress: 'Recorded',
    inputs,
    preview,
    actions: [save],
    onBusy: follow,
    submit: () => void run(record),
  });
  for (const one of [motion, size]) one.addEventListener('change', follow);
  for (const one of [motion, clip]) one.addEventListener('change', ofClip);
  for (const one of [width, height]) one.addEventListener('input', () => void (size.value = 'own'));
  ofClip();
  open();
}
