import { CadError } from './error';

/** A colour as linear Rec.709, 0..1. */
export type CadColor = readonly [number, number, number];

/** A body of a CAD file, tessellated: metres, the file's own axes, in its place in the assembly. */
export interface CadPart {
  readonly name: string;
  /** Names of the assemblies around it, outermost first. */
  readonly path: readonly string[];
  /** xyz, stride 3. Faces of the body share no vertices. */
  readonly positions: Float32Array<ArrayBuffer>;
  /** xyz, stride 3, unit length. */
  readonly normals?: Float32Array<ArrayBuffer>;
  readonly indices: Uint32Array<ArrayBuffer>;
  /** Triangles by colour, in their order: which triangles (from, to before) have which; absent: none is given. */
  readonly ranges: readonly { readonly from: number; readonly to: number; readonly color?: CadColor }[];
}

/** A CAD file. */
export interface CadModel {
  readonly name: string;
  readonly parts: readonly CadPart[];
}

/** What is used of OpenCASCADE. */
export interface Occt {
  ReadStepFile(bytes: Uint8Array, options: object): unknown;
  ReadIgesFile(bytes: Uint8Array, options: object): unknown;
  ReadBrepFile(bytes: Uint8Array, options: object): unknown;
}

/** Options for {@link readCad}. */
export interface CadOptions {
  /** Default: detected from the first bytes. */
  readonly format?: 'step' | 'iges' | 'brep';
  /** How far triangles may lie from the surface. Default: a thousandth of the model's size. */
  readonly tolerance?: { readonly relative: number } | { readonly metres: number };
  /** How far the directions of neighbouring triangles may differ, radians; default 0.35 (20°). */
  readonly angularTolerance?: number;
  /** What messages call the file. */
  readonly name?: string;
  /**
   * Starts OpenCASCADE, the package `occt-import-js`. In Node: `openOcct` of `@glanz/cad/node`. In a page: its function
   * with the address of its WebAssembly, `() => occtimportjs({ locateFile })`.
   */
  readonly openOcct: () => Promise<unknown>;
}

interface OcctNode {
  readonly name: string;
  readonly meshes: readonly number[];
  readonly children: readonly OcctNode[];
}

interface OcctMesh {
  readonly name: string;
  readonly color?: readonly number[];
  readonly brep_faces: readonly {
    readonly first: number;
    readonly last: number;
    readonly color: readonly number[] | null;
  }[];
  readonly attributes: {
    readonly position: { readonly array: readonly number[] };
    readonly normal?: { readonly array: readonly number[] };
  };
  readonly index: { readonly array: readonly number[] };
}

/** The format of a CAD file by its beginning; undefined if it is none. */
export function cadFormat(bytes: Uint8Array): CadOptions['format'] {
  const head = new TextDecoder('latin1').decode(bytes.subarray(0, 4096));
  if (/^\s*ISO-10303-21/.test(head)) return 'step';
  if (/^(\s|DBRep_DrawableShape)*CASCADE Topology/.test(head)) return 'brep';
  // IGES: lines of 80 characters, the first ones marked S for start in column 73.
  return /^.{72}S\s*\d+\s*$/m.test(head.slice(0, 400)) ? 'iges' : undefined;
}

/**
 * Reads and tessellates a STEP, IGES or BREP file by OpenCASCADE.
 *
 * @throws {CadError} `cad/format`, `cad/unreadable`, `cad/no-shapes`, `cad/option`.
 * @example
 * const model = await readCad(bytes, { openOcct, tolerance: { metres: 0.0001 } });
 */
export async function readCad(bytes: Uint8Array, options: CadOptions): Promise<CadModel> {
  const { tolerance = { relative: 0.001 }, angularTolerance = 0.35, name = 'The CAD file', openOcct } = options;
  const format = options.format ?? cadFormat(bytes);
  if (!format)
    throw new CadError('cad/format', `${name} is not a STEP, IGES or BREP file.`, { location: { file: name } });
  const deflection = 'metres' in tolerance ? tolerance.metres : tolerance.relative;
  if (!(deflection > 0 && deflection < Infinity && angularTolerance > 0 && angularTolerance < Math.PI))
    throw new CadError(
      'cad/option',
      `A tolerance of ${deflection} and an angle of ${angularTolerance} rad are not possible; both must be positive.`,
    );
  const occt = (await openOcct()) as Occt;
  const settings = {
    linearUnit: 'meter',
    linearDeflectionType: 'metres' in tolerance ? 'absolute_value' : 'bounding_box_ratio',
    linearDeflection: deflection,
    angularDeflection: angularTolerance,
  };
  let result: { readonly success?: boolean; readonly root?: OcctNode; readonly meshes?: readonly OcctMesh[] };
  try {
    result = (
      format === 'step'
        ? occt.ReadStepFile(bytes, settings)
        : format === 'iges'
          ? occt.ReadIgesFile(bytes, settings)
          : occt.ReadBrepFile(bytes, settings)
    ) as typeof result;
  } catch (cause) {
    throw new CadError(
      'cad/unreadable',
      `${name} cannot be read: OpenCASCADE ends with ${cause instanceof Error ? cause.message : String(cause)}.`,
      { cause, location: { file: name } },
    );
  }
  if (!result.success || !result.root || !result.meshes)
    throw new CadError('cad/unreadable', `${name} cannot be read: OpenCASCADE finds it damaged.`, {
      location: { file: name },
    });
  const parts: CadPart[] = [];
  const visit = (node: OcctNode, path: readonly string[]): void => {
    for (const index of node.meshes) {
      const mesh = result.meshes?.[index];
      if (mesh && mesh.index.array.length >= 3) parts.push(partOf(mesh, path, parts.length));
    }
    for (const child of node.children) visit(child, child.name ? [...path, child.name] : path);
  };
  visit(result.root, result.root.name ? [result.root.name] : []);
  if (parts.length === 0)
    throw new CadError('cad/no-shapes', `${name} has no surfaces: there is nothing to show.`, {
      location: { file: name },
    });
  return { name, parts };
}

function partOf(
  { name, color, brep_faces: faces, attributes, index }: OcctMesh,
  path: readonly string[],
  number: number,
): CadPart {
  const own = colorOf(color);
  const ranges: { from: number; to: number; color?: CadColor }[] = [];
  const triangles = Math.floor(index.array.length / 3);
  const add = (from: number, to: number, shown: CadColor | undefined) => {
    const last = ranges.at(-1);
    if (from >= to) return;
    if (last && String(last.color) === String(shown)) last.to = to;
    else ranges.push({ from, to, ...(shown ? { color: shown } : {}) });
  };
  let at = 0;
  for (const { first, last, color: face } of faces.toSorted((a, b) => a.first - b.first)) {
    add(at, Math.min(first, triangles), own);
    add(Math.max(first, at), Math.min(last + 1, triangles), colorOf(face) ?? own);
    at = Math.max(at, Math.min(last + 1, triangles));
  }
  add(at, triangles, own);
  const normal = attributes.normal?.array;
  return {
    name: name || path.at(-1) || `part ${number + 1}`,
    path,
    positions: Float32Array.from(attributes.position.array),
    ...(normal ? { normals: Float32Array.from(normal) } : {}),
    indices: Uint32Array.from(index.array.slice(0, 3 * triangles)),
    ranges,
  };
}

const colorOf = (values: readonly number[] | null | undefined): CadColor | undefined =>
  values?.length === 3 && values.every((x) => Number.isFinite(x))
    ? (values.map((x) => Math.min(Math.max(x, 0), 1)) as unknown as CadColor)
    : undefined;
