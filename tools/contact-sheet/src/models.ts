import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';

/** A model to render. */
export interface Model {
  readonly name: string;
  /** Name of its files in the output. */
  readonly id: string;
  readonly file: string;
  /** What it is for. */
  readonly note: string;
}

const MODEL = /\.(glb|gltf|obj|stl)$/i;

/** The models of a folder: those of its index.json, or else all files of a known kind below it. */
export function findModels(folder: string): Model[] {
  const index = join(folder, 'index.json');
  if (existsSync(index)) {
    const entries = JSON.parse(readFileSync(index, 'utf8')) as readonly {
      name: string;
      main: string;
      exercises?: string;
    }[];
    return entries
      .filter(({ main }) => MODEL.test(main) && existsSync(join(folder, main)))
      .map(({ name, main, exercises = '' }) => ({ name, id: idOf(name), file: join(folder, main), note: exercises }));
  }
  if (!existsSync(folder)) return [];
  return readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((path) => MODEL.test(path))
    .sort()
    .map((path) => ({ name: path, id: idOf(path), file: join(folder, path), note: relative(folder, path) }));
}

const idOf = (name: string) => name.replace(/[^A-Za-z0-9._-]+/g, '_');
