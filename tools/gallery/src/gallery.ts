import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { nodeIo, runCli, type BatchResult } from '@glanz/cli';
import { GALLERY_MODELS } from '@glanz/models/gallery';
import { sceneToGlb } from '@glanz/models/gltf';
import type { PerspectiveCamera, Scene } from '@glanz/scene';
import { cameraFile, cameraJson, commandOf } from './command';
import { DEFAULTS, GALLERY, SIZE, type GalleryImage } from './manifest';
import type { GalleryRecord } from './record';

const HELP = `npm run gallery -- [--only ID,ID] [--part K/N] [--scale F] [--samples N] [--denoise NAME] [--out FOLDER]

Renders the images of the gallery with glanz render and writes them, with the models and gallery.json.

  --only ID,ID    These images only; --list prints all of them.
  --part K/N      Every Nth image from the Kth on, to render in several runs.
  --scale F       Multiplies the size, 1600x1000. Default 1.
  --samples N     Samples per pixel. Default: what the manifest says.
  --denoise NAME  fast, balanced or off. Default balanced.
  --out FOLDER    Default out/gallery.
  --models        Writes the models and their cameras, and renders nothing.
  --docs          Writes the images of FOLDER as WebP into the documentation, with their facts.
`;

/** Thrown for arguments that make no sense. */
class UsageError extends Error {}

const wholeFrom1 = (name: string, text: string | undefined): number | undefined => {
  if (text === undefined) return undefined;
  const value = Number(text);
  if (!(Number.isInteger(value) && value >= 1))
    throw new UsageError(`--${name} must be a whole number from 1, not "${text}".`);
  return value;
};

function chosen(only: string | undefined): readonly GalleryImage[] {
  if (only === undefined) return GALLERY;
  return only.split(',').map((id) => {
    const image = GALLERY.find((one) => one.id === id.trim());
    if (!image) throw new UsageError(`There is no image "${id}"; --list prints all of them.`);
    return image;
  });
}

function partOf(images: readonly GalleryImage[], part: string | undefined): readonly GalleryImage[] {
  if (part === undefined) return images;
  const [, k, n] = /^(\d{1,3})\/(\d{1,3})$/.exec(part)?.map(Number) ?? [];
  if (!k || !n || k > n) throw new UsageError(`--part must be like 1/2, not "${part}".`);
  return images.filter((_, i) => i % n === k - 1);
}

const perspective = (scene: Scene, name: string): PerspectiveCamera => {
  const camera = scene.cameras.find((one) => one.name === name);
  if (camera?.type !== 'perspective') throw new UsageError(`"${scene.name}" has no camera "${name}".`);
  return camera;
};

/** Writes the models of some images, and the files of cameras that have a lens. */
async function writeModels(images: readonly GalleryImage[], folder: string): Promise<void> {
  mkdirSync(folder, { recursive: true });
  const scenes = new Map<string, Scene>();
  for (const { model, camera } of images) {
    let scene = scenes.get(model);
    if (!scene) {
      scene = GALLERY_MODELS[model]!();
      scenes.set(model, scene);
      writeFileSync(join(folder, `${model}.glb`), await sceneToGlb(scene));
    }
    writeFileSync(join(folder, cameraFile({ model, camera })), cameraJson(perspective(scene, camera)));
  }
}

/** Renders, and gives the exit code. */
async function render(
  images: readonly GalleryImage[],
  out: string,
  scale: number,
  samples: number | undefined,
  denoise: string | undefined,
): Promise<number> {
  const width = Math.max(Math.round(SIZE.width * scale), 1);
  const height = Math.max(Math.round(SIZE.height * scale), 1);
  const rows = images.map((image) => {
    const { denoise: quality, ...rest } = {
      ...DEFAULTS,
      ...image.options,
      ...(samples === undefined ? {} : { samples }),
    };
    const chosenQuality = denoise ?? quality;
    return {
      ...rest,
      ...(chosenQuality === 'off' ? {} : { denoise: chosenQuality }),
      model: `models/${image.model}.glb`,
      camera: readFileSync(join(out, 'models', cameraFile(image)), 'utf8'),
      ...(image.variant === undefined ? {} : { variant: [image.variant] }),
      size: `${width}x${height}`,
      output: [`${image.id}.png`],
    };
  });
  const batch = join(out, 'batch.json');
  writeFileSync(batch, JSON.stringify(rows, null, 1));
  let text = '';
  const code = await runCli(['render', '--batch', batch, '--json'], { ...nodeIo(), stdout: (part) => (text += part) });
  rmSync(batch, { force: true });
  const result = JSON.parse(text) as BatchResult;
  const records: GalleryRecord[] = [];
  for (const one of result.images ?? []) {
    if (!one.ok) {
      process.stderr.write(`${one.files.join(', ')}: ${one.error.message}\n`);
      continue;
    }
    const image = images.find(({ id }) => one.files.some(({ path }) => path.endsWith(`${id}.png`)))!;
    records.push({
      id: image.id,
      command: commandOf(image, one.samples),
      width: one.width,
      height: one.height,
      samples: one.samples,
      triangles: one.statistics.triangles,
      seconds: (one.timings.prepareMs + one.timings.renderMs + one.timings.readMs + one.timings.denoiseMs) / 1000,
      gpu: one.adapter.name,
    });
    for (const warning of one.warnings) process.stderr.write(`${image.id}: ${warning}\n`);
  }
  writeFileSync(join(out, 'gallery.json'), `${JSON.stringify(records, null, 2)}\n`);
  process.stdout.write(`${records.length} of ${images.length} images in ${out}\n`);
  return code;
}

/** Runs the tool; gives the exit code. */
export async function galleryMain(argv: readonly string[]): Promise<number> {
  try {
    const { values } = parseArgs({
      args: [...argv],
      options: {
        only: { type: 'string' },
        part: { type: 'string' },
        scale: { type: 'string' },
        samples: { type: 'string' },
        denoise: { type: 'string' },
        out: { type: 'string' },
        models: { type: 'boolean' },
        docs: { type: 'boolean' },
        list: { type: 'boolean' },
        help: { type: 'boolean', short: 'h' },
      },
    });
    if (values.help) {
      process.stdout.write(HELP);
      return 0;
    }
    const images = partOf(chosen(values.only), values.part);
    if (values.list) {
      for (const { id, title } of images) process.stdout.write(`${id.padEnd(24)} ${title}\n`);
      return 0;
    }
    const out = values.out ?? join('out', 'gallery');
    if (values.docs) return await (await import('./docs-images')).writeDocsImages(images, out);
    const scale = Number(values.scale ?? 1);
    if (!(scale > 0 && scale <= 8))
      throw new UsageError(`--scale must be a number above 0 and at most 8, not "${values.scale}".`);
    const samples = wholeFrom1('samples', values.samples);
    await writeModels(images, join(out, 'models'));
    return values.models ? 0 : await render(images, out, scale, samples, values.denoise);
  } catch (error) {
    if (!(error instanceof UsageError) && !(error as NodeJS.ErrnoException).code?.startsWith('ERR_PARSE_ARGS'))
      throw error;
    process.stderr.write(`gallery: ${(error as Error).message}\n`);
    return 2;
  }
}
