import type { PerspectiveCamera } from '@glanz/scene';
import { DEFAULTS, SIZE, type GalleryImage } from './manifest';

const rounded = (value: number, digits = 5): number => Number(value.toFixed(digits));

/** A camera as `glanz render --camera` reads it. Positions in metres, angles in degrees. */
export function cameraJson({ name, transform: m, yfov, lens_radius, focus_distance }: PerspectiveCamera): string {
  const position = [12, 13, 14].map((k) => m[k]!);
  const distance = focus_distance ?? 1;
  return `${JSON.stringify({
    name,
    position: position.map((x) => rounded(x)),
    target: position.map((x, k) => rounded(x - distance * m[8 + k]!)),
    fov: rounded((yfov * 180) / Math.PI, 4),
    ...(lens_radius === undefined ? {} : { lens_radius: rounded(lens_radius, 6), focus_distance: rounded(distance) }),
  })}\n`;
}

/** Name of the file that {@link cameraJson} is written to. */
export const cameraFile = ({ model, camera }: Pick<GalleryImage, 'model' | 'camera'>): string =>
  `${model}-${camera.toLowerCase().replaceAll(' ', '-')}.json`;

const quoted = (text: string): string => (/^[\w./,=:-]+$/.test(text) ? text : `'${text}'`);

/**
 * The command that renders an image, in lines of at most 80 columns where its words allow that.
 *
 * @param samples Those that the image has. Default: what the manifest says.
 */
export function commandOf(image: GalleryImage, samples?: number): string {
  const words = [`${image.model}.glb`, `--camera ${cameraFile(image)}`];
  if (image.variant !== undefined) words.push(`--variant ${quoted(image.variant)}`);
  const options = { ...DEFAULTS, ...image.options, ...(samples === undefined ? {} : { samples }) };
  for (const [name, value] of Object.entries(options))
    for (const one of Array.isArray(value) ? value : [value])
      words.push(one === true ? `--${name}` : `--${name} ${quoted(String(one))}`);
  words.push(`--size ${SIZE.width}x${SIZE.height}`, `-o ${image.id}.png`);
  const lines = ['glanz render'];
  for (const word of words) {
    const last = lines[lines.length - 1]!;
    if (last.length + 1 + word.length <= 78) lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(`  ${word}`);
  }
  return lines.join(' \\\n');
}
