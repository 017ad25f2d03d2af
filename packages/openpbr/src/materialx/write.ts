import {
  OPENPBR_PARAMETER_NAMES,
  OPENPBR_PARAMETER_SPECS,
  validateParameters,
  type OpenPbrParameterName,
} from '../parameters/index';
import { flipped } from './read';
import type { MaterialXMaterial, MaterialXTexture, MaterialXWarning } from './material';

/** What {@link writeMaterialX} answers. */
export interface WrittenMaterialX {
  /** The text of the document. */
  readonly document: string;
  readonly warnings: readonly MaterialXWarning[];
}

const ESCAPES: Readonly<Record<string, string>> = {
  '&': '&amp;',
  '<': '&lt;',
  '>': '&gt;',
  '"': '&quot;',
  '\n': '&#10;',
  '\r': '&#13;',
  '\t': '&#9;',
};
// Characters that no XML document may hold, not even by number, are left out.
const escaped = (text: string) =>
  text
    .replaceAll(/[&<>"\n\r\t]/g, (character) => ESCAPES[character] as string)
    .replaceAll(/[\p{Cc}\p{Cs}\ufffe\uffff]/gu, '');
const list = (values: number | readonly number[]) =>
  [values]
    .flat()
    .map((value) => String(+value))
    .join(', ');
const WRAP = { repeat: 'periodic', mirror: 'mirror', clamp: 'clamp' } as const;
const CHANNEL = { r: 0, g: 1, b: 2, a: 3 } as const;

/** Names as MaterialX allows them, each once in the document. */
class Names {
  readonly #taken = new Set<string>();

  unique(requested: string): string {
    const base = requested.replaceAll(/[^A-Za-z0-9_]/g, '_').replace(/^(?=\d|$)/, '_');
    let name = base;
    for (let i = 1; this.#taken.has(name); i++) name = `${base}_${i}`;
    this.#taken.add(name);
    return name;
  }
}

const input = (name: string, type: string, rest: Readonly<Record<string, string>>) =>
  `<input name="${name}" type="${type}"${Object.entries(rest)
    .map(([key, value]) => ` ${key}="${escaped(value)}"`)
    .join('')} />`;
const node = (kind: string, name: string, type: string, inputs: readonly string[]) =>
  `    <${kind} name="${name}" type="${type}">\n${inputs.map((line) => `      ${line}\n`).join('')}    </${kind}>\n`;

/** The nodes of a texture; the last one gives the parameter's value. */
function textureNodes(
  parameter: OpenPbrParameterName,
  texture: MaterialXTexture,
  value: number | readonly number[],
  names: Names,
): { readonly text: string; readonly last: string; readonly type: string } {
  const {
    file,
    channels,
    colorSpace,
    uv = 0,
    transform,
    range = [0, 1],
    scale = 1,
    wrapU = 'repeat',
    wrapV = 'repeat',
    filter = 'linear',
  } = texture;
  const target = OPENPBR_PARAMETER_SPECS[parameter].type;
  let text = '';
  const make = (kind: string, suffix: string, type: string, inputs: readonly string[]) => {
    const name = names.unique(`${parameter}_${suffix}`);
    text += node(kind, name, type, inputs);
    return name;
  };
  const lookup = [
    input('file', 'filename', { value: file, colorspace: colorSpace === 'srgb' ? 'srgb_texture' : 'lin_rec709' }),
  ];
  if (uv !== 0 || transform) {
    let coordinates = make('texcoord', 'uv', 'vector2', [input('index', 'integer', { value: String(uv) })]);
    if (transform) {
      const [a, b, c, d, x, y] = flipped(transform);
      coordinates = make('transformmatrix', 'place', 'vector2', [
        input('in', 'vector2', { nodename: coordinates }),
        input('mat', 'matrix33', { value: list([a, b, 0, c, d, 0, x, y, 1]) }),
      ]);
    }
    lookup.push(input('texcoord', 'vector2', { nodename: coordinates }));
  }
  if (wrapU !== 'repeat') lookup.push(input('uaddressmode', 'string', { value: WRAP[wrapU] }));
  if (wrapV !== 'repeat') lookup.push(input('vaddressmode', 'string', { value: WRAP[wrapV] }));
  if (filter !== 'linear') lookup.push(input('filtertype', 'string', { value: 'closest' }));
  if (target === 'vector3') {
    const image = make('image', 'image', 'vector3', lookup);
    const mapped = make('normalmap', 'map', 'vector3', [
      input('in', 'vector3', { nodename: image }),
      input('scale', 'float', { value: list(scale) }),
    ]);
    return { text, last: mapped, type: 'vector3' };
  }
  const letter = channels === 'rgb' ? undefined : channels;
  // A single number from the first channel is what an image of type float gives, unless it is encoded as a colour.
  const plain = letter === 'r' && colorSpace === 'linear';
  let last = make('image', 'image', plain ? 'float' : letter ? 'color4' : 'color3', lookup);
  let type = plain ? 'float' : 'color3';
  if (letter && !plain) {
    last = make('extract', 'channel', 'float', [
      input('in', 'color4', { nodename: last }),
      input('index', 'integer', { value: String(CHANNEL[letter]) }),
    ]);
    type = 'float';
  }
  const expected = target === 'color3' ? 'color3' : 'float';
  if (type !== expected) {
    last =
      expected === 'float'
        ? make('extract', 'channel', 'float', [
            input('in', 'color3', { nodename: last }),
            input('index', 'integer', { value: '0' }),
          ])
        : make('convert', 'colour', 'color3', [input('in', 'float', { nodename: last })]);
    type = expected;
  }
  const number = (numbers: number | readonly number[]) =>
    type === 'color3'
      ? { value: list(typeof numbers === 'number' ? [numbers, numbers, numbers] : numbers), colorspace: 'lin_rec709' }
      : { value: list(numbers) };
  const slope = [value].flat().map((v) => v * (range[1] - range[0])),
    start = [value].flat().map((v) => v * range[0]);
  if (slope.some((s) => s !== 1))
    last = make('multiply', 'scale', type, [input('in1', type, { nodename: last }), input('in2', type, number(slope))]);
  if (start.some((s) => s !== 0))
    last = make('add', 'offset', type, [input('in1', type, { nodename: last }), input('in2', type, number(start))]);
  return { text, last, type };
}

/**
 * Writes OpenPBR materials as a MaterialX 1.39 document that other programs and {@link readMaterialX} read: a
 * `surfacematerial` and an `open_pbr_surface` each, with a node graph for its textures. Values equal to the defaults
 * are left out; numbers are written to the last digit. Colours are linear Rec.709, which the document says.
 *
 * Lost, with a warning: textures on tangents, and normals that are neither textures nor unperturbed.
 *
 * @throws {OpenPbrError} `openpbr/parameter-type`
 * @example
 * const { document } = writeMaterialX([{ name: 'gold', parameters: OPENPBR_PRESETS.gold }]);
 */
export function writeMaterialX(materials: readonly MaterialXMaterial[]): WrittenMaterialX {
  const warnings: MaterialXWarning[] = [];
  const names = new Names();
  let body = '';
  for (const { name, parameters: given, textures = {} } of materials) {
    const { parameters, warnings: repaired } = validateParameters(given);
    for (const { code, message } of repaired) warnings.push({ code, message: `Material "${name}": ${message}` });
    const lost = (parameter: string, why: string) =>
      warnings.push({
        code: 'openpbr/materialx-unsupported',
        message: `Material "${name}": ${parameter} ${why}, which MaterialX documents of ours do not hold; it is left out.`,
      });
    const material = names.unique(name),
      surface = names.unique(`${material}_surface`),
      graph = names.unique(`${material}_textures`);
    const inside = new Names();
    let inputs = '',
      nodes = '',
      outputs = '';
    for (const parameter of OPENPBR_PARAMETER_NAMES) {
      const { type, default: initial, texturable } = OPENPBR_PARAMETER_SPECS[parameter];
      const value = parameters[parameter] ?? initial;
      const texture = textures[parameter];
      if (texture && texturable && !parameter.endsWith('tangent')) {
        const {
          text,
          last,
          type: made,
        } = textureNodes(parameter, texture, (value ?? 1) as number | readonly number[], inside);
        nodes += text;
        const out = inside.unique(`${parameter}_out`);
        outputs += `    <output name="${out}" type="${made}" nodename="${last}" />\n`;
        inputs += `    ${input(parameter, made, { nodegraph: graph, output: out })}\n`;
        continue;
      }
      if (texture) lost(parameter, 'is driven by a texture');
      if (value === null || JSON.stringify(value) === JSON.stringify(initial)) continue;
      if (type !== 'vector3') {
        inputs += `    ${input(parameter, type, { value: typeof value === 'boolean' ? String(value) : list(value) })}\n`;
        continue;
      }
      const [x, y, z] = value as readonly [number, number, number];
      if (!parameter.endsWith('tangent') || Math.abs(z) > 1e-6) {
        lost(parameter, 'is a vector that is not in the tangent plane');
        continue;
      }
      // MaterialX turns clockwise as seen from the tip of the axis.
      const tangent = inside.unique('tangent'),
        normal = inside.unique('normal'),
        turned = inside.unique(`${parameter}_turned`),
        out = inside.unique(`${parameter}_out`);
      const world = [input('space', 'string', { value: 'world' })];
      nodes += node('tangent', tangent, 'vector3', world) + node('normal', normal, 'vector3', world);
      nodes += node('rotate3d', turned, 'vector3', [
        input('in', 'vector3', { nodename: tangent }),
        input('amount', 'float', { value: list((-Math.atan2(y, x) * 180) / Math.PI) }),
        input('axis', 'vector3', { nodename: normal }),
      ]);
      outputs += `    <output name="${out}" type="vector3" nodename="${turned}" />\n`;
      inputs += `    ${input(parameter, 'vector3', { nodegraph: graph, output: out })}\n`;
    }
    if (nodes) body += `  <nodegraph name="${graph}">\n${nodes}${outputs}  </nodegraph>\n`;
    body += `  <open_pbr_surface name="${surface}" type="surfaceshader">\n${inputs}  </open_pbr_surface>\n`;
    body += `  <surfacematerial name="${material}" type="material">\n    ${input('surfaceshader', 'surfaceshader', { nodename: surface })}\n  </surfacematerial>\n`;
  }
  return {
    document: `<?xml version="1.0"?>\n<materialx version="1.39" colorspace="lin_rec709">\n${body}</materialx>\n`,
    warnings,
  };
}
