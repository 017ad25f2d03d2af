import { existsSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { BenchError } from '../error';

/** Models beside the repository: large images, Draco, meshopt, many meshes, many triangles. */
const MODELS = ['DamagedHelmet', 'chess-board', 'pirate-meshopt', 'lamborghini', 'bunny-casual-effects'];

/** Where the models lie; `GLANZ_ASSETS` names another place. */
export const ASSETS = resolve(process.env['GLANZ_ASSETS'] ?? '../shared/assets');

/** A model to load. */
export interface LoadModel {
  readonly name: string;
  /** Below {@link ASSETS}. */
  readonly file: string;
}

/** @throws {BenchError} `bench/assets` */
export function loadModels(): LoadModel[] {
  if (!existsSync(join(ASSETS, 'index.json')))
    throw new BenchError('bench/missing-data', 'There are no test models in ../shared/assets beside the repository.');
  const index = JSON.parse(readFileSync(join(ASSETS, 'index.json'), 'utf8')) as readonly {
    name: string;
    main: string;
  }[];
  return MODELS.flatMap((name) => {
    const main = index.find((entry) => entry.name === name)?.main;
    return main === undefined ? [] : [{ name, file: main }];
  });
}

/** Who loads, by the names that figures have. */
export const CONTESTANTS = { glanz: 'loadGltf', worker: 'GltfWorker', three: 'three.js' } as const;

export type Contestant = keyof typeof CONTESTANTS;

/** What they are given: an address on this machine, or the file's bytes. */
export type From = 'address' | 'bytes';

/** One load. */
export interface Load {
  /** From an address or bytes to a scene, milliseconds. */
  readonly ms: number;
  /** In all places, to see that all have loaded the same. */
  readonly triangles: number;
}
