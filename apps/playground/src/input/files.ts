import { describeError, PlaygroundError } from '../errors';

/** What a user gave, sorted: a model with everything that lies beside it, an environment, a material, or several of them. */
export interface GivenFiles {
  readonly model?: { readonly files: ReadonlyMap<string, File>; readonly entry: string };
  readonly environment?: File;
  /** A MaterialX document. */
  readonly material?: File;
}

const MODEL = /\.(glb|gltf|obj|stl)$/i;
const ENVIRONMENT = /\.(hdr|exr|pic)$/i;
const MATERIAL = /\.mtlx$/i;

/**
 * Finds the model, the environment and the material among files.
 *
 * @param files By path, folders separated by `/`.
 * @throws {PlaygroundError} `playground/no-model` if there is none of them.
 */
export function sortFiles(files: ReadonlyMap<string, File>): GivenFiles {
  const paths = [...files.keys()];
  // Of several documents the one nearest to the top, as asset folders keep variants below.
  const depth = (path: string) => path.split('/').length;
  const entry = paths.filter((path) => MODEL.test(path)).sort((a, b) => depth(a) - depth(b) || a.localeCompare(b))[0];
  const surroundings = paths.find((path) => ENVIRONMENT.test(path));
  const look = paths.find((path) => MATERIAL.test(path));
  if (entry === undefined && surroundings === undefined && look === undefined) {
    const names = paths.slice(0, 3).map((path) => `"${path}"`);
    throw new PlaygroundError('playground/no-model', `There is no .glb, .gltf, .obj, .stl, .hdr, .exr or .mtlx among the files${names.length > 0 ? ` (${names.join(', ')}${paths.length > 3 ? ', …' : ''})` : ''}.`);
  }
  const environment = surroundings === undefined ? undefined : files.get(surroundings);
  const material = look === undefined ? undefined : files.get(look);
  return { ...(entry === undefined ? {} : { model: { files, entry } }), ...(environment ? { environment } : {}), ...(material ? { material } : {}) };
}

/** What the page says of an environment that cannot be read, and came together with a model. */
export const environmentNote = (error: unknown): string => `${describeError(error).message} The model is lit as the page was before.`;

/** Files of a file input; of a folder input with their paths. */
export function filesOfInput(input: HTMLInputElement): Map<string, File> {
  return new Map([...(input.files ?? [])].map((file) => [file.webkitRelativePath || file.name, file]));
}

const fileOf = (entry: FileSystemFileEntry) => new Promise<File>((resolve, reject) => entry.file(resolve, reject));
const batchOf = (reader: FileSystemDirectoryReader) => new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));

async function walk(entry: FileSystemEntry, files: Map<string, File>): Promise<void> {
  if (entry.isFile) files.set(entry.fullPath.replace(/^\//, ''), await fileOf(entry as FileSystemFileEntry));
  else if (entry.isDirectory) {
    const reader = (entry as FileSystemDirectoryEntry).createReader();
    // A reader gives entries in batches until one is empty.
    for (let batch = await batchOf(reader); batch.length > 0; batch = await batchOf(reader)) {
      for (const child of batch) await walk(child, files);
    }
  }
}

/** Files and folders of a drop. Call it in the event itself: later the transfer is empty. */
export function filesOfDrop(transfer: DataTransfer): Promise<Map<string, File>> {
  const entries = [...transfer.items].flatMap((item) => (item.kind === 'file' ? [item.webkitGetAsEntry?.() ?? null] : []));
  const plain = [...transfer.files];
  return (async () => {
    const files = new Map<string, File>();
    if (entries.length > 0 && entries.every((entry) => entry !== null)) for (const entry of entries) await walk(entry, files);
    // Scripted transfers and old browsers have files without entries.
    if (files.size === 0) for (const file of plain) files.set(file.name, file);
    return files;
  })();
}
