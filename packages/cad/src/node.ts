import { CadError } from './error';
import { writeGlb } from './glb';
import { levelsOfDetail } from './levels';
import { checkMaterialMap, type CadMaterialMap } from './materials';
import { readCad, type CadOptions } from './read';
import { cadToScene } from './scene';

export { CadError } from './error';

/** Starts OpenCASCADE, without its chatter on the console. */
export async function openOcct(): Promise<unknown> {
  const { default: create } = await import('occt-import-js');
  return create({ print: () => undefined, printErr: () => undefined });
}

/** Options for {@link convertCadFile}. */
export interface ConvertCadOptions extends Pick<CadOptions, 'tolerance' | 'angularTolerance' | 'format'> {
  /**
   * Levels of detail; default 1. The first is written to `output`, the others to the same name with `.lod1`, `.lod2`
   * before the extension.
   */
  readonly levels?: number;
  /** A map, or the path of a JSON file with one. */
  readonly materials?: CadMaterialMap | string;
  /** Leaves out names and metadata. Default false. */
  readonly strip?: boolean;
}

/** A file that has been written. */
export interface ConvertedFile {
  readonly path: string;
  readonly bytes: number;
  readonly triangles: number;
  readonly parts: number;
  readonly materials: number;
}

/**
 * Converts a STEP, IGES or BREP file to GLB, in several levels of detail if asked to.
 *
 * @param output Path of the first level; ends in `.glb`.
 * @throws {CadError} See its codes.
 * @example
 * await convertCadFile('part.step', 'part.glb', { levels: 3, materials: 'map.json', strip: true });
 */
export async function convertCadFile(
  input: string,
  output: string,
  options: ConvertCadOptions = {},
): Promise<ConvertedFile[]> {
  const { readFile, writeFile } = await import('node:fs/promises');
  const { basename } = await import('node:path');
  const read = (path: string) =>
    readFile(path).catch((cause: unknown) => {
      throw new CadError('cad/missing-resource', `${path} cannot be read: ${(cause as Error).message}.`, {
        cause,
        location: { file: path },
      });
    });
  if (!/\.glb$/i.test(output)) throw new CadError('cad/option', `The output is "${output}", but must end in .glb.`);
  let { materials } = options;
  if (typeof materials === 'string') {
    let json: unknown;
    try {
      json = JSON.parse((await read(materials)).toString('utf8'));
    } catch (cause) {
      if (cause instanceof CadError) throw cause;
      throw new CadError('cad/materials', `${materials} is not valid JSON: ${(cause as Error).message}.`, {
        cause,
        location: { file: materials },
      });
    }
    materials = checkMaterialMap(json);
  }
  const { levels = 1, strip = false, tolerance, angularTolerance, format } = options;
  const model = await readCad(new Uint8Array(await read(input)), {
    openOcct,
    name: basename(input),
    ...(tolerance ? { tolerance } : {}),
    ...(angularTolerance === undefined ? {} : { angularTolerance }),
    ...(format ? { format } : {}),
  });
  const scene = cadToScene(model, { strip, ...(materials ? { materials } : {}) });
  const files: ConvertedFile[] = [];
  for (const [level, one] of (await levelsOfDetail(scene, { levels })).entries()) {
    const path = level === 0 ? output : output.replace(/\.glb$/i, `.lod${level}.glb`);
    const bytes = writeGlb(one, { strip });
    await writeFile(path, bytes);
    files.push({
      path,
      bytes: bytes.length,
      triangles: one.meshes.reduce((sum, { indices }) => sum + indices.length / 3, 0),
      parts: one.instances.length,
      materials: one.materials.length,
    });
  }
  return files;
}
