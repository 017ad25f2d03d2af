import { scatteringRadius } from '../color/radius';
import {
  OPENPBR_PARAMETER_SPECS,
  validateParameters,
  type OpenPbrColor,
  type OpenPbrParameterName,
  type OpenPbrParameters,
} from '../parameters/index';
import { failure, MaterialXError, quote } from './error';
import { convert, Unsupported, type Affine, type Expression, type TextureLookup } from './expression';
import { Graph, type Tell } from './graph';
import type { MaterialXMaterial, MaterialXTexture, MaterialXWarning } from './material';
import { DRAFT_INPUTS, fromDraft, type SurfaceName, type SurfaceTextures, type SurfaceValues } from './version';
import { parseXml, type MaterialXLimits, type XmlElement } from './xml';

/** Options for {@link readMaterialX}. */
export interface ReadMaterialXOptions {
  readonly limits?: MaterialXLimits;
  /**
   * The version of OpenPBR that the document's surfaces are written in. Default `1.1.1`. With `1.2`, the draft, they are
   * converted as `fromOpenPbr12` of `@glanz/openpbr/versions` does; warnings name what is not drawn. The inputs of haze
   * and retroreflectivity are read in either version.
   */
  readonly openPbr?: '1.1.1' | '1.2';
  /** Colour space of colours whose document names none. Default `acescg`, as the OpenPBR specification has it. */
  readonly colorSpace?: string;
}

/** What {@link readMaterialX} answers. */
export interface MaterialXDocument {
  /** At least one, in the order of the document. */
  readonly materials: readonly MaterialXMaterial[];
  readonly warnings: readonly MaterialXWarning[];
}

/** Metres. */
const UNITS: ReadonlyMap<string, number> = new Map([
  ['nanometer', 1e-9],
  ['micrometer', 1e-6],
  ['millimeter', 1e-3],
  ['centimeter', 1e-2],
  ['meter', 1],
  ['kilometer', 1e3],
  ['inch', 0.0254],
  ['foot', 0.3048],
  ['yard', 0.9144],
  ['mile', 1609.344],
]);

/** A map between coordinates whose v runs up as one between coordinates whose v runs down. */
export const flipped = ([a, b, c, d, x, y]: Affine): Affine => [a, -b || 0, -c || 0, d, x + c, 1 - d - y];

function textureOf(lookup: TextureLookup, channels: MaterialXTexture['channels']): MaterialXTexture {
  const transform = flipped(lookup.transform).map((number) =>
    Math.abs(number) < 1e-12 ? 0 : number,
  ) as unknown as Affine;
  return {
    file: lookup.file,
    channels,
    colorSpace: lookup.colorSpace,
    ...(lookup.uv === 0 ? {} : { uv: lookup.uv }),
    ...([1, 0, 0, 1, 0, 0].every((number, i) => Math.abs(number - (transform[i] as number)) < 1e-12)
      ? {}
      : { transform }),
    ...(lookup.wrapU === 'repeat' ? {} : { wrapU: lookup.wrapU }),
    ...(lookup.wrapV === 'repeat' ? {} : { wrapV: lookup.wrapV }),
    ...(lookup.filter === 'linear' ? {} : { filter: lookup.filter }),
  };
}

/** offset + scale·texel, the same for all components but for a factor, as value × (from + (to - from)·texel). */
function product(
  scale: readonly number[],
  offset: readonly number[],
): { readonly value: readonly number[]; readonly range: readonly [number, number] } {
  const value = scale.map((s, i) => {
    const low = offset[i] as number,
      high = low + s;
    return Math.abs(high) >= Math.abs(low) ? high : low;
  });
  const ends = value.map((v, i) =>
    v === 0 ? undefined : ([(offset[i] as number) / v, ((offset[i] as number) + (scale[i] as number)) / v] as const),
  );
  const first = ends.find((end) => end !== undefined) ?? [0, 1];
  if (
    !ends.every(
      (end) => end === undefined || (Math.abs(end[0] - first[0]) < 1e-9 && Math.abs(end[1] - first[1]) < 1e-9),
    )
  )
    throw new Unsupported('shifts the channels of an image apart');
  return { value, range: first };
}

/** Takes one input of the surface. */
function take(name: SurfaceName, given: Expression, parameters: SurfaceValues, textures: SurfaceTextures): void {
  const type = Object.hasOwn(DRAFT_INPUTS, name) ? 'float' : OPENPBR_PARAMETER_SPECS[name as OpenPbrParameterName].type;
  if (type === 'vector3') {
    if (given.kind === 'normal map' && name.endsWith('normal'))
      textures[name] = { ...textureOf(given.texture, 'rgb'), ...(given.scale === 1 ? {} : { scale: given.scale }) };
    else if (given.kind === 'direction') {
      const plain = name.endsWith('normal') ? [0, 0, 1] : [1, 0, 0];
      if (given.vector.some((c, i) => Math.abs(c - (plain[i] as number)) > 1e-9)) parameters[name] = given.vector;
    } else throw new Unsupported('is neither a normal map nor a direction of the surface');
    return;
  }
  const width = type === 'color3' ? 3 : 1;
  const value = convert(given, width);
  if (value.kind === 'constant') {
    if (
      value.values.length !== width ||
      (given.kind === 'constant' && given.values.length > 1 && given.values.length < width)
    )
      throw new Unsupported('has the wrong number of components');
    parameters[name] = type === 'boolean' ? value.values[0] !== 0 : width === 1 ? value.values[0] : value.values;
  } else if (value.kind === 'texture' && type !== 'boolean') {
    if (OPENPBR_PARAMETER_SPECS[name as OpenPbrParameterName]?.texturable === false)
      throw new Unsupported('is an image');
    const spread = (values: readonly number[]) =>
      values.length === width ? values : Array.from({ length: width }, () => values[0] as number);
    const { value: factor, range } = product(spread(value.scale), spread(value.offset));
    const texture = textureOf(value.texture, value.channels === 'rgba' ? 'rgb' : value.channels);
    parameters[name] = width === 1 ? factor[0] : factor;
    textures[name] = range[0] === 0 && range[1] === 1 ? texture : { ...texture, range };
  } else throw new Unsupported('is neither a number nor a colour');
}

/** Lengths in the units of the document's inputs as those of the parameters. */
function inUnit(name: SurfaceName, input: XmlElement, parameters: SurfaceValues, tell: Tell): void {
  const unit = input.attributes.get('unit');
  if (Object.hasOwn(DRAFT_INPUTS, name)) return;
  const { unit: own } = OPENPBR_PARAMETER_SPECS[name as OpenPbrParameterName];
  if (unit === undefined || (own !== 'length' && own !== 'µm')) return;
  const metres = UNITS.get(unit);
  if (metres === undefined)
    tell('unsupported', `the unit ${quote(unit)} of ${name} is not known; the number is taken as it is.`, input.line);
  else if (typeof parameters[name] === 'number') parameters[name] *= own === 'µm' ? metres * 1e6 : metres;
}

function readSurface(
  surface: XmlElement,
  scope: XmlElement,
  name: string,
  graph: Graph,
  warnings: MaterialXWarning[],
  tell: Tell,
  draft: boolean,
): MaterialXMaterial {
  const raw: SurfaceValues = {};
  const textures: SurfaceTextures = {};
  if (!draft && surface.attributes.get('version')?.startsWith('1.2'))
    tell(
      'unsupported',
      `${quote(name)} is of the draft of OpenPBR 1.2, but is read as 1.1.1: pass openPbr: '1.2'.`,
      surface.line,
    );
  for (const input of surface.children) {
    if (input.name !== 'input') continue;
    const key = input.attributes.get('name') ?? '';
    if (!Object.hasOwn(OPENPBR_PARAMETER_SPECS, key) && !(draft && Object.hasOwn(DRAFT_INPUTS, key))) {
      tell('unsupported', `OpenPBR has no input ${quote(key)}; it is left out.`, input.line);
      continue;
    }
    const parameter = key as SurfaceName;
    try {
      const value = graph.input(input, scope);
      if (value) take(parameter, value, raw, textures);
      inUnit(parameter, input, raw, tell);
    } catch (error) {
      if (!(error instanceof Unsupported)) throw error;
      delete raw[parameter];
      tell(
        'unsupported',
        `what drives ${parameter} ${error.message}, which is not read; the parameter keeps its default.`,
        input.line,
      );
    }
  }
  if (draft) fromDraft(raw, textures, (message) => tell('unsupported', message, surface.line));
  if (raw.subsurface_radius_scale && !textures.subsurface_radius_scale) {
    const { radius, scale } = scatteringRadius(
      (raw.subsurface_radius as number | undefined) ?? 1,
      raw.subsurface_radius_scale as OpenPbrColor,
    );
    raw.subsurface_radius_scale = scale;
    if (radius !== 1) raw.subsurface_radius = radius;
  }
  const { parameters, warnings: repaired } = validateParameters(raw as Partial<OpenPbrParameters>);
  for (const { code, message } of repaired)
    warnings.push({ code, message: `Material ${quote(name)}: ${message}`, line: surface.line });
  return { name, parameters, ...(Object.keys(textures).length > 0 ? { textures } : {}) };
}

/**
 * Reads the OpenPBR materials of a MaterialX document (.mtlx): values, and textures as people export them, that is
 * images (`image`, `tiledimage`) with placement, colour space, and arithmetic with constants between them and the
 * surface; normal maps; tangents turned by an angle. What is beyond that leaves its parameter at the default, with a
 * warning. Nothing is
 * fetched: files are named in the answer.
 *
 * @param source The text of the document, or its bytes in UTF-8.
 * @throws {MaterialXError} if the text is not well formed or too large, if names in it lead nowhere or in a circle, if
 * a value is none, or if there is no `open_pbr_surface`.
 * @example
 * const { materials } = readMaterialX(await (await fetch('gold.mtlx')).text());
 * tracer.setMaterial('housing', materials[0].parameters);
 */
export function readMaterialX(
  source: string | Uint8Array,
  { limits = {}, openPbr = '1.1.1', colorSpace = 'acescg' }: ReadMaterialXOptions = {},
): MaterialXDocument {
  let text: string;
  if (typeof source === 'string') text = source;
  else {
    try {
      text = new TextDecoder('utf-8', { fatal: true }).decode(source);
    } catch (cause) {
      throw new MaterialXError('openpbr/materialx-syntax', 'The MaterialX document is not in UTF-8.', { cause });
    }
  }
  const root = parseXml(text, limits);
  if (root.name !== 'materialx')
    throw failure('syntax', `its element is ${quote(`<${root.name}>`)}, not <materialx>.`, root.line);
  const warnings: MaterialXWarning[] = [];
  const reported = new Set<string>();
  const tell: Tell = (what, message, line) => {
    // A node may be asked more than once.
    const key = `${line} ${message}`;
    if (!reported.has(key))
      warnings.push({
        code: `openpbr/materialx-${what}`,
        message: `MaterialX document, line ${line}: ${message}`,
        line,
      });
    reported.add(key);
  };
  const graph = new Graph(colorSpace, tell);
  for (const child of root.children)
    if (/^(xi:)?include$/.test(child.name)) tell('unsupported', 'other documents are not included.', child.line);

  const materials: MaterialXMaterial[] = [];
  const shown = new Set<XmlElement>();
  const nameOf = (element: XmlElement) => element.attributes.get('name') ?? `material ${materials.length}`;
  for (const material of root.children) {
    if (material.name !== 'surfacematerial') continue;
    for (const other of ['backsurfaceshader', 'displacementshader'])
      if (graph.inputOf(material, other))
        tell('unsupported', `the ${other} of ${quote(nameOf(material))} is left out.`, material.line);
    const shader = graph.inputOf(material, 'surfaceshader')?.attributes.get('nodename');
    const surface = shader === undefined ? undefined : graph.find(root, shader);
    if (shader !== undefined && !surface) throw failure('reference', `${quote(shader)} is not there.`, material.line);
    if (surface?.name !== 'open_pbr_surface') {
      tell(
        'unsupported',
        `the material ${quote(nameOf(material))} has ${surface ? `a <${surface.name}>` : 'no surface'}; only open_pbr_surface is read.`,
        material.line,
      );
      continue;
    }
    shown.add(surface);
    materials.push(readSurface(surface, root, nameOf(material), graph, warnings, tell, openPbr === '1.2'));
  }
  for (const surface of root.children) {
    if (surface.name === 'open_pbr_surface' && !shown.has(surface))
      materials.push(readSurface(surface, root, nameOf(surface), graph, warnings, tell, openPbr === '1.2'));
  }
  if (materials.length === 0) throw failure('no-surface', 'there is no <open_pbr_surface> in it.', root.line);
  return { materials, warnings };
}
