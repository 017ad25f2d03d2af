import { textureEncoding, toLinear } from '../color/spaces';
import { failure, quote } from './error';
import {
  add,
  after,
  component,
  constant,
  convert,
  multiply,
  negate,
  reciprocal,
  Unsupported,
  type Affine,
  type Expression,
  type TextureLookup,
} from './expression';
import type { XmlElement } from './xml';

/** Components of MaterialX's types of numbers. */
const WIDTHS: ReadonlyMap<string, number> = new Map([
  ['float', 1],
  ['integer', 1],
  ['boolean', 1],
  ['color3', 3],
  ['color4', 4],
  ['vector2', 2],
  ['vector3', 3],
  ['vector4', 4],
  ['matrix33', 9],
]);
const widthOf = (type: string | undefined) => WIDTHS.get(type ?? '') ?? 0;

const WRAP: ReadonlyMap<string, TextureLookup['wrapU']> = new Map([
  ['periodic', 'repeat'],
  ['mirror', 'mirror'],
  ['clamp', 'clamp'],
]);
const IDENTITY: Affine = [1, 0, 0, 1, 0, 0];
/** How far a graph may be deep. */
const DEPTH = 64;

/** Receives warnings about values that are read with another meaning than intended. */
export type Tell = (code: 'color-space' | 'unsupported', message: string, line: number) => void;

/** Colours of a texture without a colour space: images of 8 bits are sRGB by custom, others linear. */
const customary = (file: string): 'srgb' | 'linear' => (/\.(exr|hdr|tif|tiff)$/i.test(file) ? 'linear' : 'srgb');

/** The nodes of a document, and what they are worth. */
export class Graph {
  readonly #defaultSpace: string;
  readonly #tell: Tell;
  readonly #scopes = new Map<XmlElement, ReadonlyMap<string, XmlElement>>();
  readonly #known = new Map<XmlElement, Map<string, Expression | Unsupported>>();
  readonly #visiting = new Set<XmlElement>();

  constructor(defaultSpace: string, tell: Tell) {
    this.#defaultSpace = defaultSpace;
    this.#tell = tell;
  }

  /** The element of that name inside of another. */
  find(scope: XmlElement, name: string): XmlElement | undefined {
    let names = this.#scopes.get(scope);
    if (!names) {
      const found = new Map<string, XmlElement>();
      for (const child of scope.children) {
        const key = child.attributes.get('name');
        if (key !== undefined && child.name !== 'input') found.set(key, child);
      }
      this.#scopes.set(scope, (names = found));
    }
    return names.get(name);
  }

  inputOf(node: XmlElement, name: string): XmlElement | undefined {
    return node.children.find((child) => child.name === 'input' && child.attributes.get('name') === name);
  }

  /**
   * What an input of a node is worth; undefined if it has neither value nor connection.
   * @param scope What holds the node: the document or a node graph.
   * @throws {Unsupported} and {@link MaterialXError}
   */
  input(input: XmlElement, scope: XmlElement): Expression | undefined {
    const get = (key: string) => input.attributes.get(key);
    const reach = (name: string, among: XmlElement) => {
      const found = this.find(among, name);
      if (!found) throw failure('reference', `${quote(name)} is not there.`, input.line);
      return found;
    };
    const outer = get('interfacename');
    if (outer !== undefined) {
      const declared = this.inputOf(scope, outer);
      if (!declared) throw failure('reference', `the node graph has no input ${quote(outer)}.`, input.line);
      if (!scope.parent)
        throw failure('reference', `${quote(outer)} is an interface outside of a node graph.`, input.line);
      const value = this.#entered(declared, () => this.input(declared, scope.parent as XmlElement));
      return value;
    }
    const graph = get('nodegraph'),
      node = get('nodename'),
      output = get('output');
    if (graph !== undefined) return this.#node(reach(graph, scope), output, scope);
    if (node !== undefined) return this.#node(reach(node, scope), output, scope);
    if (output !== undefined) return this.#node(reach(output, scope), undefined, scope);
    const value = get('value');
    return value === undefined ? undefined : this.#constant(input, value);
  }

  /** What a node is worth. */
  #node(node: XmlElement, output: string | undefined, scope: XmlElement): Expression {
    let known = this.#known.get(node);
    if (!known) this.#known.set(node, (known = new Map()));
    const key = output ?? '';
    let made = known.get(key);
    if (!made) {
      try {
        made = this.#entered(node, () => this.#evaluate(node, output, scope));
      } catch (error) {
        if (!(error instanceof Unsupported)) throw error;
        made = error;
      }
      known.set(key, made);
    }
    if (made instanceof Unsupported) throw made;
    return made;
  }

  #entered<T>(element: XmlElement, work: () => T): T {
    if (this.#visiting.has(element))
      throw failure(
        'reference',
        `${quote(element.attributes.get('name') ?? element.name)} is connected to itself.`,
        element.line,
      );
    if (this.#visiting.size >= DEPTH)
      throw failure('limit', `nodes are connected more than ${DEPTH} deep.`, element.line);
    this.#visiting.add(element);
    try {
      return work();
    } finally {
      this.#visiting.delete(element);
    }
  }

  /** The nearest attribute of an element or of what holds it. */
  #inherited(element: XmlElement, key: string): string | undefined {
    for (let at: XmlElement | undefined = element; at; at = at.parent) {
      const value = at.attributes.get(key);
      if (value !== undefined && value !== '') return value;
    }
    return undefined;
  }

  #constant(input: XmlElement, text: string): Expression {
    const type = input.attributes.get('type') ?? 'float';
    if (type === 'boolean') {
      if (text !== 'true' && text !== 'false')
        throw failure('value', `${quote(text)} is neither true nor false.`, input.line);
      return constant(text === 'true' ? 1 : 0);
    }
    const width = widthOf(type);
    if (width === 0) throw new Unsupported(`has the type ${quote(type)}`);
    const values = text.split(',').map((number) => (number.trim() === '' ? Number.NaN : Number(number)));
    if (values.length !== width || !values.every(Number.isFinite))
      throw failure(
        'value',
        `${quote(text)} is not a ${type}: ${width} finite number${width > 1 ? 's' : ''}.`,
        input.line,
      );
    if (!type.startsWith('color')) return { kind: 'constant', values };
    const space = this.#inherited(input, 'colorspace') ?? this.#defaultSpace;
    const [r, g, b, ...rest] = values as [number, number, number];
    const linear = toLinear([r, g, b], space);
    if (!linear)
      this.#tell(
        'color-space',
        `the colour space ${quote(space)} is not known; the colour is taken as linear Rec.709.`,
        input.line,
      );
    return { kind: 'constant', values: [...(linear ?? [r, g, b]), ...rest] };
  }

  /** The text of an input that is no number. */
  #text(
    node: XmlElement,
    name: string,
    scope: XmlElement,
  ): { readonly text: string; readonly input: XmlElement } | undefined {
    let input = this.inputOf(node, name);
    const outer = input?.attributes.get('interfacename');
    if (outer !== undefined) input = this.inputOf(scope, outer);
    const text = input?.attributes.get('value');
    return input && text !== undefined ? { text, input } : undefined;
  }

  #argument(node: XmlElement, name: string, scope: XmlElement, initial?: Expression): Expression {
    const input = this.inputOf(node, name);
    const value = (input && this.input(input, scope)) ?? initial;
    if (!value) throw new Unsupported(`has no input ${quote(name)}`);
    return value;
  }

  #numbers(node: XmlElement, name: string, scope: XmlElement, initial: readonly number[]): readonly number[] {
    const value = this.#argument(node, name, scope, { kind: 'constant', values: initial });
    if (value.kind !== 'constant') throw new Unsupported(`varies its input ${quote(name)}`);
    return value.values.length === 1 ? initial.map(() => value.values[0] as number) : value.values;
  }

  #coordinates(node: XmlElement, scope: XmlElement): Extract<Expression, { kind: 'coordinates' }> {
    const value = this.#argument(node, 'texcoord', scope, { kind: 'coordinates', uv: 0, transform: IDENTITY });
    if (value.kind !== 'coordinates') throw new Unsupported('takes texture coordinates that are none');
    return value;
  }

  #image(node: XmlElement, scope: XmlElement): Expression {
    const file = this.#text(node, 'file', scope);
    if (!file || file.text === '') throw new Unsupported('names no file');
    let prefix = '';
    for (let at: XmlElement | undefined = file.input; at; at = at.parent)
      prefix = (at.attributes.get('fileprefix') ?? '') + prefix;
    const tiled = node.name === 'tiledimage';
    const { uv, transform: placed } = this.#coordinates(node, scope);
    let transform = placed;
    if (tiled) {
      const [su, sv] = this.#numbers(node, 'uvtiling', scope, [1, 1]) as [number, number];
      const [ou, ov] = this.#numbers(node, 'uvoffset', scope, [0, 0]) as [number, number];
      const [iu, iv] = this.#numbers(node, 'realworldimagesize', scope, [1, 1]) as [number, number];
      const [tu, tv] = this.#numbers(node, 'realworldtilesize', scope, [1, 1]) as [number, number];
      transform = after(transform, [(su * tu) / iu, 0, 0, (sv * tv) / iv, (-ou * tu) / iu, (-ov * tv) / iv]);
      if (!transform.every(Number.isFinite)) throw failure('value', 'an image has no size.', node.line);
    }
    const wrap = (axis: 'u' | 'v') => {
      const mode = tiled ? 'periodic' : (this.#text(node, `${axis}addressmode`, scope)?.text ?? 'periodic');
      if (!WRAP.has(mode))
        this.#tell(
          'unsupported',
          `beyond its border an image is to be ${quote(mode)}; its border is repeated instead.`,
          node.line,
        );
      return WRAP.get(mode) ?? 'clamp';
    };
    const type = node.attributes.get('type') ?? 'color3';
    const width = widthOf(type);
    if (width === 0 || width > 4) throw new Unsupported(`has the type ${quote(type)}`);
    const texture: TextureLookup = {
      file: prefix + file.text,
      colorSpace: type.startsWith('color') ? this.#encoding(file.input, prefix + file.text) : 'linear',
      uv,
      transform,
      wrapU: wrap('u'),
      wrapV: wrap('v'),
      filter: this.#text(node, 'filtertype', scope)?.text === 'closest' ? 'nearest' : 'linear',
    };
    return {
      kind: 'texture',
      texture,
      width,
      channels: width === 1 ? 'r' : width === 4 ? 'rgba' : 'rgb',
      scale: [1],
      offset: [0],
    };
  }

  #encoding(input: XmlElement, file: string): 'srgb' | 'linear' {
    const space = this.#inherited(input, 'colorspace');
    const encoding = space === undefined ? customary(file) : textureEncoding(space);
    if (encoding) return encoding;
    this.#tell(
      'color-space',
      `the image ${quote(file)} is in the colour space ${quote(space ?? '')}, which textures cannot have; it is taken as ${customary(file) === 'srgb' ? 'sRGB' : 'linear Rec.709'}.`,
      input.line,
    );
    return customary(file);
  }

  #evaluate(node: XmlElement, output: string | undefined, scope: XmlElement): Expression {
    const argument = (name: string, initial?: Expression) => this.#argument(node, name, scope, initial);
    const numbers = (name: string, initial: readonly number[]) => this.#numbers(node, name, scope, initial);
    const width = widthOf(node.attributes.get('type'));
    switch (node.name) {
      case 'nodegraph': {
        const outputs = node.children.filter((child) => child.name === 'output');
        const chosen =
          output === undefined ? outputs[0] : outputs.find((child) => child.attributes.get('name') === output);
        if (!chosen)
          throw failure(
            'reference',
            `the node graph ${quote(node.attributes.get('name') ?? '')} has no output ${quote(output ?? '')}.`,
            node.line,
          );
        return this.#node(chosen, undefined, node);
      }
      case 'output': {
        const value = this.input(node, scope);
        if (!value) throw new Unsupported('has nothing to give');
        return value;
      }
      case 'image':
      case 'tiledimage':
        return this.#image(node, scope);
      case 'constant':
        return argument('value', constant(...Array.from({ length: width }, () => 0)));
      case 'multiply':
        return multiply(argument('in1'), argument('in2', constant(1)));
      case 'divide':
        return multiply(argument('in1'), reciprocal(argument('in2', constant(1))));
      case 'add':
        return add(argument('in1'), argument('in2', constant(0)));
      case 'subtract':
        return add(argument('in1'), negate(argument('in2', constant(0))));
      case 'invert':
        return add(argument('amount', constant(1)), negate(argument('in')));
      case 'mix': {
        const share = argument('mix', constant(0));
        return add(
          multiply(argument('fg', constant(0)), share),
          multiply(argument('bg', constant(0)), add(constant(1), negate(share))),
        );
      }
      case 'remap':
      case 'range': {
        if (node.name === 'range' && numbers('gamma', [1]).some((gamma) => gamma !== 1))
          throw new Unsupported('applies a gamma');
        const low = argument('inlow', constant(0)),
          outLow = argument('outlow', constant(0));
        const slope = multiply(
          add(argument('outhigh', constant(1)), negate(outLow)),
          reciprocal(add(argument('inhigh', constant(1)), negate(low))),
        );
        return add(multiply(add(argument('in'), negate(low)), slope), outLow);
      }
      case 'dot':
      case 'clamp':
        // Parameters are clamped anyhow.
        return argument('in');
      case 'convert':
        return convert(argument('in'), width);
      case 'extract':
        return component(argument('in'), numbers('index', [0])[0] as number);
      case 'swizzle': {
        const channels = this.#text(node, 'channels', scope)?.text ?? '';
        if (/^(rgb|xyz)a?$/.test(channels)) return convert(argument('in'), 3);
        const index = 'rgbaxyzw'.indexOf(channels);
        if (channels.length !== 1 || index < 0) throw new Unsupported(`rearranges channels to ${quote(channels)}`);
        return component(argument('in'), index % 4);
      }
      case 'separate2':
      case 'separate3':
      case 'separate4': {
        const index = ['outr', 'outg', 'outb', 'outa', 'outx', 'outy', 'outz', 'outw'].indexOf(output ?? 'outx');
        return component(argument('in'), index % 4);
      }
      case 'combine2':
      case 'combine3':
      case 'combine4':
        return {
          kind: 'constant',
          values: Array.from(
            { length: Number(node.name.slice(-1)) },
            (_, i) => numbers(`in${i + 1}`, [0])[0] as number,
          ),
        };
      case 'normalmap': {
        const value = argument('in');
        const [scale] = numbers('scale', [1]) as [number];
        if (
          value.kind !== 'texture' ||
          value.channels === 'r' ||
          value.width < 3 ||
          value.scale.some((s) => s !== 1) ||
          value.offset.some((o) => o !== 0)
        )
          throw new Unsupported('is not an image of normals');
        // Whatever the document says of the image's colours: normals are numbers.
        return { kind: 'normal map', texture: { ...value.texture, colorSpace: 'linear' }, scale };
      }
      case 'texcoord': {
        const index = this.#numbers(node, 'index', scope, [0])[0] as number;
        return { kind: 'coordinates', uv: index, transform: IDENTITY };
      }
      case 'geompropvalue': {
        const name = this.#text(node, 'geomprop', scope)?.text ?? '';
        if (width !== 2 || !/^(uv|st|uvmap|uvset|map|texcoord_?)[01]?$/i.test(name))
          throw new Unsupported(`reads the geometry's ${quote(name)}`);
        return { kind: 'coordinates', uv: name.endsWith('1') ? 1 : 0, transform: IDENTITY };
      }
      case 'place2d':
        return this.#place(node, scope);
      case 'rotate2d': {
        const value = argument('in');
        if (value.kind !== 'coordinates') throw new Unsupported('turns what are not texture coordinates');
        return { ...value, transform: after(value.transform, turn(numbers('amount', [0])[0] as number)) };
      }
      case 'transformmatrix': {
        const value = argument('in');
        const m = numbers('mat', [1, 0, 0, 0, 1, 0, 0, 0, 1]);
        if (value.kind !== 'coordinates' || m.length !== 9)
          throw new Unsupported('transforms what are not texture coordinates');
        return {
          ...value,
          transform: after(value.transform, [m[0], m[1], m[3], m[4], m[6], m[7]] as unknown as Affine),
        };
      }
      case 'normal':
        return { kind: 'direction', vector: [0, 0, 1] };
      case 'tangent':
        return { kind: 'direction', vector: [1, 0, 0] };
      case 'bitangent':
        return { kind: 'direction', vector: [0, 1, 0] };
      case 'rotate3d': {
        const value = argument('in'),
          axis = argument('axis', constant(0, 1, 0));
        if (value.kind !== 'direction' || axis.kind !== 'direction' || axis.vector[2] !== 1)
          throw new Unsupported('turns a direction about something else than the normal');
        // MaterialX turns clockwise as seen from the tip of the axis.
        const [a, b, c, d] = turn(numbers('amount', [0])[0] as number);
        const [x, y, z] = value.vector;
        return { kind: 'direction', vector: [a * x + c * y, b * x + d * y, z] };
      }
      default:
        throw new Unsupported(`is a <${node.name}>`);
    }
  }

  #place(node: XmlElement, scope: XmlElement): Expression {
    const value = this.#coordinates(node, scope);
    const [px, py] = this.#numbers(node, 'pivot', scope, [0, 0]) as [number, number];
    const [sx, sy] = this.#numbers(node, 'scale', scope, [1, 1]) as [number, number];
    const [ox, oy] = this.#numbers(node, 'offset', scope, [0, 0]) as [number, number];
    if (sx === 0 || sy === 0) throw failure('value', 'an image is placed with the scale 0.', node.line);
    const scaled: Affine = [1 / sx, 0, 0, 1 / sy, 0, 0],
      turned = turn(this.#numbers(node, 'rotate', scope, [0])[0] as number),
      moved: Affine = [1, 0, 0, 1, -ox, -oy];
    const order =
      this.#numbers(node, 'operationorder', scope, [0])[0] === 1 ? [moved, turned, scaled] : [scaled, turned, moved];
    const transform = [[1, 0, 0, 1, -px, -py] as Affine, ...order, [1, 0, 0, 1, px, py] as Affine].reduce(
      after,
      value.transform,
    );
    return { ...value, transform };
  }
}

/** Turned clockwise, by degrees, as MaterialX does. */
function turn(degrees: number): Affine {
  const c = Math.cos((degrees * Math.PI) / 180),
    s = Math.sin((degrees * Math.PI) / 180);
  return [c, -s, s, c, 0, 0];
}
