import { describeError, PlaygroundError } from '../errors';

/**
 * What a user gave, sorted: a model with everything that lies beside it, an environment, a material, or several of
 * them.
 */
export interface GivenFiles {
  readonly model?: { readonly files: ReadonlyMap<string, File>; readonly entry: string };
  /** Paths of other models beside it, which are not shown. */
  readonly others?: readonly string[];
  readonly environment?: File;
  /** A MaterialX document. */
  readonly material?: File;
}

/** Files of USD refer to each other. */
const USD = /\.usd[acz]?$/i;
const MODEL = /\.(glb|gltf|obj|stl|usd[acz]?)$/i;
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
  const [entry, ...others] = paths
    .filter((path) => MODEL.test(path))
    .sort((a, b) => depth(a) - depth(b) || a.localeCompare(b))
    .filter((path, _, [first = path]) => path === first || (depth(path) === depth(first) && !USD.test(first)));
  const environmentPath = paths.find((path) => ENVIRONMENT.test(path));
  const look = paths.find((path) => MATERIAL.test(path));
  if (entry === undefined && environmentPath === undefined && look === undefined) {
    const names = paths.slice(0, 3).map((path) => `"${path}"`);
    throw new PlaygroundError(
      'playground/no-model',
      `There is no .glb, .gltf, .obj, .stl, .usdz, .usdc, .usda, .hdr, .exr or .mtlx among the files${names.length > 0 ? ` (${names.join(', ')}${paths.length > 3 ? ', …' : ''})` : ''}.`,
    );
  }
  const environment = environmentPath === undefined ? undefined : files.get(environmentPath);
  const material = look === undefined ? undefined : files.get(look);
  return {
    ...(entry === undefined ? {} : { model: { files, entry } }),
    ...(others.length > 0 ? { others } : {}),
    ...(environment ? { environment } : {}),
    ...(material ? { material } : {}),
  };
}

/** What the page says of an environment that cannot be read, and came together with a model. */
export const environmentNote = (error: unknown): string =>
  `${describeError(error).message} The model is lit as the page was before.`;

/** What the page says of models that came together with the one it shows. */
export const othersNote = (entry: string, [first, ...more]: readonly string[]): string =>
  `Of these models, "${entry}" is shown. Open ${more.length > 0 ? `the other ${more.length + 1}` : `"${first}"`} separately.`;
