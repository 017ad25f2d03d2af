import { OperationCounter } from '@glanz/operations';
import { afterAll, describe, expect, it, vi } from 'vitest';
import { document as documented, dress } from '../../../apps/docs/examples/materialx';
import {
  MaterialXError,
  readMaterialX,
  writeMaterialX,
  type MaterialXMaterial,
  type MaterialXTexture,
} from '../src/materialx/index';
import {
  OPENPBR_PARAMETER_NAMES,
  OPENPBR_PARAMETERS,
  resolveParameters,
  type OpenPbrParameterName,
  type OpenPbrParameters,
} from '../src/parameters/index';
import { OPENPBR_PRESET_NAMES, OPENPBR_PRESETS } from '../src/presets/index';
import { presets as shared } from './oracle/index';

const counter = new OperationCounter(/\/packages\/openpbr\/src\/materialx\//);
afterAll(() => counter.end());

/** A document around inputs of a surface and the elements beside it. */
const wrap = (inputs: string, beside = '', attributes = 'colorspace="lin_rec709"') => `<?xml version="1.0"?>
<materialx version="1.39" ${attributes}>
${beside}
<open_pbr_surface name="surface" type="surfaceshader">
${inputs}
</open_pbr_surface>
<surfacematerial name="stuff" type="material"><input name="surfaceshader" type="surfaceshader" nodename="surface" /></surfacematerial>
</materialx>`;
const only = (text: string, options?: Parameters<typeof readMaterialX>[1]) => {
  const { materials, warnings } = readMaterialX(text, options);
  expect(materials.length).toBe(1);
  return { ...(materials[0] as MaterialXMaterial), warnings };
};
const fails = (text: string | Uint8Array, options?: Parameters<typeof readMaterialX>[1]) => {
  try {
    readMaterialX(text, options);
  } catch (error) {
    if (!(error instanceof MaterialXError)) throw error;
    expect(error.message).not.toContain('\n');
    expect(error.message.length).toBeLessThan(300);
    return `${error.code.replace('openpbr/materialx-', '')} ${error.location?.line ?? '-'}`;
  }
  return 'read';
};

describe('values', () => {
  it('numbers, colours, booleans', () => {
    const { name, parameters, warnings } = only(
      wrap(`
      <input name="base_color" type="color3" value="0.1, 0.2,0.3" />
      <input name="specular_ior" type="float" value="1.4e0" />
      <input name="geometry_thin_walled" type="boolean" value="true" />
      <input name="specular_roughness" type="float" value="2" />`),
    );
    expect([name, parameters]).toEqual([
      'stuff',
      { base_color: [0.1, 0.2, 0.3], specular_ior: 1.4, geometry_thin_walled: true, specular_roughness: 1 },
    ]);
    expect(warnings.map(({ code, line }) => [code, line])).toEqual([['openpbr/clamped', 4]]);
  });

  it('a surface that no material shows is a material of its own', () => {
    expect(
      readMaterialX('<materialx><open_pbr_surface name="a"/><open_pbr_surface name="b"/></materialx>').materials,
    ).toEqual([
      { name: 'a', parameters: {} },
      { name: 'b', parameters: {} },
    ]);
  });

  it.each([
    // Numbers of MaterialX's own colour management library, single precision.
    ['acescg', [0.5, 0.25, 0.125], [0.68667, 0.218755, 0.099877]],
    ['lin_rec709', [0.5, 0.25, 0.125], [0.5, 0.25, 0.125]],
    ['srgb_texture', [0.5, 0.02, 1], [0.214041, 0.001548, 1]],
    ['g22_rec709', [0.5, 0.5, 0.5], [0.217638, 0.217638, 0.217638]],
    ['g18_rec709', [0.5, 0.5, 0.5], [0.287175, 0.287175, 0.287175]],
    ['lin_displayp3', [0.5, 0.25, 0.5], [0.556235, 0.239486, 0.519659]],
    ['lin_adobergb', [0.5, 0.25, 0.5], [0.599589, 0.25, 0.510732]],
  ])('a colour in %s, whether its input or the document says so', (space, given, expected) => {
    const input = (own: string) => `<input name="emission_color" type="color3" value="${given}" ${own} />`;
    for (const text of [
      wrap(input(`colorspace="${space}"`)),
      wrap(input(''), '', `colorspace="${space}"`),
      wrap(input(''), '', ''),
    ]) {
      const { parameters, warnings } = only(text, { colorSpace: space });
      parameters.emission_color!.forEach((c, k) => expect(c).toBeCloseTo(expected[k]!, 5));
      expect(warnings).toEqual([]);
    }
  });

  it('by default, colours are in ACEScg', () => {
    expect(
      only(wrap('<input name="emission_color" type="color3" value="1, 1, 0" />', '', '')).parameters.emission_color![0],
    ).toBeCloseTo(1.083259, 5);
  });

  it('an unknown colour space is reported', () => {
    const { parameters, warnings } = only(
      wrap('<input name="base_color" type="color3" value="1, 0.5, 0" colorspace="my_space" />'),
    );
    expect([parameters.base_color, warnings.map(({ code }) => code)]).toEqual([
      [1, 0.5, 0],
      ['openpbr/materialx-color-space'],
    ]);
  });

  it('lengths in their units', () => {
    const { parameters } = only(
      wrap(`
      <input name="transmission_depth" type="float" value="3" unittype="distance" unit="centimeter" />
      <input name="thin_film_thickness" type="float" value="550" unittype="distance" unit="nanometer" />
      <input name="subsurface_radius" type="float" value="2" />`),
    );
    expect(parameters.transmission_depth).toBeCloseTo(0.03, 12);
    expect(parameters.thin_film_thickness).toBeCloseTo(0.55, 12);
    expect(parameters.subsurface_radius).toBe(2);
  });

  it("the specification's example materials, written as its documents are", () => {
    for (const [name, overrides] of Object.entries(shared())) {
      const inputs = Object.entries(overrides).map(
        ([key, value]) =>
          `<input name="${key}" type="${OPENPBR_PARAMETERS[key as OpenPbrParameterName].type}" value="${Array.isArray(value) ? value.join(', ') : value}" />`,
      );
      const { parameters } = only(wrap(inputs.join('\n'), '', 'colorspace="acescg"'));
      expect(parameters, name).toEqual(OPENPBR_PRESETS[name as keyof typeof OPENPBR_PRESETS]);
    }
  });
});

describe('textures', () => {
  const GRAPH = `
  <nodegraph name="NG">
    <tiledimage name="color" type="color3">
      <input name="file" type="filename" value="base.png" colorspace="srgb_texture" fileprefix="maps/" />
      <input name="uvtiling" type="vector2" value="2, 3" />
    </tiledimage>
    <image name="rough" type="float"><input name="file" type="filename" value="rough.png" /><input name="uaddressmode" type="string" value="clamp"/><input name="vaddressmode" type="string" value="mirror"/><input name="filtertype" type="string" value="closest"/></image>
    <image name="normal" type="vector3"><input name="file" type="filename" value="normal.png" /></image>
    <normalmap name="map" type="vector3"><input name="in" type="vector3" nodename="normal" /><input name="scale" type="float" value="0.5" /></normalmap>
    <image name="packed" type="color4"><input name="file" type="filename" value="packed.png" colorspace="raw" /></image>
    <extract name="alpha" type="float"><input name="in" type="color4" nodename="packed" /><input name="index" type="integer" value="3" /></extract>
    <separate3 name="split" type="multioutput"><input name="in" type="color3" nodename="linear" /></separate3>
    <image name="linear" type="color3"><input name="file" type="filename" value="orm.png" /></image>
    <output name="color_out" type="color3" nodename="color" /><output name="rough_out" type="float" nodename="rough" /><output name="normal_out" type="vector3" nodename="map" />
    <output name="alpha_out" type="float" nodename="alpha" /><output name="metal_out" type="float" nodename="split" output="outb" />
  </nodegraph>`;

  it('images, normal maps, single channels', () => {
    const { textures, parameters, warnings } = only(
      wrap(
        `
      <input name="base_color" type="color3" nodegraph="NG" output="color_out" />
      <input name="specular_roughness" type="float" nodegraph="NG" output="rough_out" />
      <input name="geometry_normal" type="vector3" nodegraph="NG" output="normal_out" />
      <input name="coat_weight" type="float" nodegraph="NG" output="alpha_out" />
      <input name="base_metalness" type="float" nodegraph="NG" output="metal_out" />`,
        GRAPH,
        'colorspace="lin_rec709" fileprefix="root/"',
      ),
    );
    expect(warnings).toEqual([]);
    expect(textures).toEqual({
      // v' = 3 v with v running up is 1 - 3 (1 - v) = 3 v - 2 with v running down.
      base_color: { file: 'root/maps/base.png', channels: 'rgb', colorSpace: 'srgb', transform: [2, 0, 0, 3, 0, -2] },
      specular_roughness: {
        file: 'root/rough.png',
        channels: 'r',
        colorSpace: 'linear',
        wrapU: 'clamp',
        wrapV: 'mirror',
        filter: 'nearest',
      },
      geometry_normal: { file: 'root/normal.png', channels: 'rgb', colorSpace: 'linear', scale: 0.5 },
      coat_weight: { file: 'root/packed.png', channels: 'a', colorSpace: 'linear' },
      base_metalness: { file: 'root/orm.png', channels: 'b', colorSpace: 'linear' },
    });
    expect(parameters).toEqual({ base_color: [1, 1, 1], specular_roughness: 1, coat_weight: 1, base_metalness: 1 });
  });

  /** What the parameter is where the texel has a value, by the answer. */
  const worth = ({ parameters, textures }: MaterialXMaterial, name: OpenPbrParameterName, texel: number) => {
    const [from, to] = textures?.[name]?.range ?? [0, 1];
    return [parameters[name] as number | number[]].flat().map((value) => value * (from + (to - from) * texel));
  };
  const arithmetic = (node: string, type = 'float') =>
    only(
      wrap(
        `<input name="${type === 'float' ? 'specular_weight' : 'emission_color'}" type="${type}" nodename="last" />`,
        `<image name="t" type="${type}"><input name="file" type="filename" value="t.exr"/></image><constant name="k" type="float"><input name="value" type="float" value="0.25"/></constant>${node}`,
      ),
    );
  it.each<[string, string, (t: number) => number]>([
    [
      'a product',
      '<multiply name="last" type="float"><input name="in1" type="float" nodename="t"/><input name="in2" type="float" value="0.5"/></multiply>',
      (t) => t * 0.5,
    ],
    [
      'a product with a constant node, in the other order',
      '<multiply name="last" type="float"><input name="in1" type="float" nodename="k"/><input name="in2" type="float" nodename="t"/></multiply>',
      (t) => 0.25 * t,
    ],
    [
      'a quotient',
      '<divide name="last" type="float"><input name="in1" type="float" nodename="t"/><input name="in2" type="float" value="4"/></divide>',
      (t) => t / 4,
    ],
    [
      'a sum',
      '<add name="last" type="float"><input name="in1" type="float" nodename="t"/><input name="in2" type="float" value="0.5"/></add>',
      (t) => t + 0.5,
    ],
    [
      'what is left',
      '<subtract name="last" type="float"><input name="in1" type="float" value="0.75"/><input name="in2" type="float" nodename="t"/></subtract>',
      (t) => 0.75 - t,
    ],
    [
      'an inversion',
      '<invert name="last" type="float"><input name="in" type="float" nodename="t"/></invert>',
      (t) => 1 - t,
    ],
    [
      'a remapping',
      '<remap name="last" type="float"><input name="in" type="float" nodename="t"/><input name="inlow" type="float" value="0.2"/><input name="inhigh" type="float" value="0.7"/><input name="outlow" type="float" value="1"/><input name="outhigh" type="float" value="0.4"/></remap>',
      (t) => 1 + ((t - 0.2) / 0.5) * -0.6,
    ],
    [
      'a mixture',
      '<mix name="last" type="float"><input name="fg" type="float" nodename="t"/><input name="bg" type="float" value="0.9"/><input name="mix" type="float" nodename="k"/></mix>',
      (t) => 0.25 * t + 0.75 * 0.9,
    ],
    [
      'a chain',
      '<dot name="last" type="float"><input name="in" type="float" nodename="m"/></dot><multiply name="m" type="float"><input name="in1" type="float" nodename="i"/><input name="in2" type="float" value="0.3"/></multiply><invert name="i" type="float"><input name="in" type="float" nodename="t"/></invert>',
      (t) => 0.3 * (1 - t),
    ],
  ])('%s with constants', (_, node, expected) => {
    const material = arithmetic(node);
    expect(material.warnings).toEqual([]);
    for (const texel of [0, 0.3, 1])
      expect(worth(material, 'specular_weight', texel)[0]).toBeCloseTo(expected(texel), 9);
  });

  it('a product of an image and a colour', () => {
    const material = arithmetic(
      '<multiply name="last" type="color3"><input name="in1" type="color3" nodename="t"/><input name="in2" type="color3" value="0.5, 0.25, 1"/></multiply>',
      'color3',
    );
    expect(worth(material, 'emission_color', 0.5)).toEqual([0.25, 0.125, 0.5]);
  });

  it.each([
    [
      'two images',
      '<multiply name="last" type="float"><input name="in1" type="float" nodename="t"/><input name="in2" type="float" nodename="t"/></multiply>',
    ],
    ['a procedure', '<noise2d name="last" type="float"/>'],
    [
      'a power',
      '<power name="last" type="float"><input name="in1" type="float" nodename="t"/><input name="in2" type="float" value="2"/></power>',
    ],
    ['an image without a file', '<image name="last" type="float"/>'],
  ])('%s: the parameter keeps its default, with a warning that says where', (_, node) => {
    const { parameters, textures, warnings } = arithmetic(node);
    expect([parameters, textures, warnings.map(({ code, line }) => [code, line])]).toEqual([
      {},
      undefined,
      [['openpbr/materialx-unsupported', 5]],
    ]);
  });

  it('through the interface of a node graph', () => {
    const graph =
      '<nodegraph name="NG"><input name="image" type="filename" value="x.jpg" colorspace="srgb_texture"/><input name="tint" type="color3" value="0.5,0.5,0.5"/><image name="i" type="color3"><input name="file" type="filename" interfacename="image"/></image><multiply name="m" type="color3"><input name="in1" type="color3" nodename="i"/><input name="in2" type="color3" interfacename="tint"/></multiply><output name="out" type="color3" nodename="m"/></nodegraph>';
    const { parameters, textures } = only(wrap('<input name="base_color" type="color3" nodegraph="NG"/>', graph));
    expect([parameters.base_color, textures!.base_color]).toEqual([
      [0.5, 0.5, 0.5],
      { file: 'x.jpg', channels: 'rgb', colorSpace: 'srgb' },
    ]);
  });

  const placed = (nodes: string) =>
    only(
      wrap(
        '<input name="base_color" type="color3" nodename="i"/>',
        `<texcoord name="uv" type="vector2"><input name="index" type="integer" value="1"/></texcoord>${nodes}<image name="i" type="color3"><input name="file" type="filename" value="a.png"/><input name="texcoord" type="vector2" nodename="p"/></image>`,
      ),
    ).textures!.base_color!;
  /** MaterialX's definition of place2d, step by step, on coordinates whose v runs up. */
  const place2d = (
    u: number,
    v: number,
    {
      pivot,
      scale,
      rotate,
      offset,
      order,
    }: { pivot: number[]; scale: number[]; rotate: number; offset: number[]; order: number },
  ) => {
    type Point = readonly [number, number];
    const turn = ([x, y]: Point): Point => [
      Math.cos(rotate) * x + Math.sin(rotate) * y,
      -Math.sin(rotate) * x + Math.cos(rotate) * y,
    ];
    const shrink = ([x, y]: Point): Point => [x / scale[0]!, y / scale[1]!];
    const move = ([x, y]: Point): Point => [x - offset[0]!, y - offset[1]!];
    let at: Point = [u - pivot[0]!, v - pivot[1]!];
    for (const step of order === 0 ? [shrink, turn, move] : [move, turn, shrink]) at = step(at);
    return [at[0] + pivot[0]!, at[1] + pivot[1]!] as const;
  };
  it.each([0, 1])('placement by place2d, order %s', (order) => {
    const placement = { pivot: [0.5, 0.25], scale: [2, 0.5], rotate: Math.PI / 6, offset: [0.1, -0.3], order };
    const { uv, transform } = placed(
      `<place2d name="p" type="vector2"><input name="texcoord" type="vector2" nodename="uv"/><input name="pivot" type="vector2" value="0.5,0.25"/><input name="scale" type="vector2" value="2,0.5"/><input name="rotate" type="float" value="30"/><input name="offset" type="vector2" value="0.1,-0.3"/><input name="operationorder" type="integer" value="${order}"/></place2d>`,
    );
    expect(uv).toBe(1);
    const [a, b, c, d, x, y] = transform!;
    for (const [u, v] of [
      [0, 0],
      [1, 0],
      [0, 1],
      [0.3, 0.8],
    ] as const) {
      const [eu, ev] = place2d(u, 1 - v, placement);
      expect(a * u + c * v + x).toBeCloseTo(eu, 9);
      expect(b * u + d * v + y).toBeCloseTo(1 - ev, 9);
    }
  });

  it('a tangent turned by an angle; MaterialX turns clockwise', () => {
    const { parameters, warnings } = only(
      wrap(
        '<input name="geometry_tangent" type="vector3" nodename="r"/>',
        '<tangent name="t" type="vector3"/><normal name="n" type="vector3"/><rotate3d name="r" type="vector3"><input name="in" type="vector3" nodename="t"/><input name="amount" type="float" value="-90"/><input name="axis" type="vector3" nodename="n"/></rotate3d>',
      ),
    );
    expect(warnings).toEqual([]);
    expect(parameters.geometry_tangent!.map((c) => Math.round(c * 1e9) / 1e9)).toEqual([0, 1, 0]);
  });
});

describe('documents that are broken or hostile', () => {
  const laughs = `<?xml version="1.0"?>\n<!DOCTYPE lolz [<!ENTITY lol "lol">${Array.from({ length: 9 }, (_, i) => `<!ENTITY lol${i} "${'&lol;'.repeat(10)}">`).join('')}]>\n<materialx>&lol9;</materialx>`;
  const circle =
    '<nodegraph name="G"><multiply name="a" type="float"><input name="in1" type="float" nodename="b"/></multiply><multiply name="b" type="float"><input name="in1" type="float" nodename="a"/></multiply><output name="o" type="float" nodename="a"/></nodegraph>';
  it.each([
    ['entities', laughs, 'syntax 2'],
    ['an external entity', '<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]><materialx/>', 'syntax 1'],
    ['a reference to no entity', wrap('<input name="base_weight" type="float" value="&e;"/>'), 'syntax 5'],
    ['depth', `<materialx>${'<a>'.repeat(100_000)}`, 'limit 1'],
    ['elements', `<materialx>${'<a/>'.repeat(100_001)}</materialx>`, 'limit 1'],
    ['length', `<materialx>${' '.repeat(1 << 24)}</materialx>`, 'limit 1'],
    ['nothing', '', 'syntax 1'],
    ['no XML', '{"a": 1}', 'syntax 1'],
    ['another format', '<svg/>', 'syntax 1'],
    ['text behind', '<materialx/>\nmore', 'syntax 1'],
    ['two elements', '<materialx/>\n<materialx/>', 'syntax 2'],
    ['an end too many', '<materialx></materialx></materialx>', 'syntax 1'],
    ['ends in the wrong order', '<materialx>\n<a>\n<b></a></b></materialx>', 'syntax 3'],
    ['no end', '<materialx>\n\n<a>', 'syntax 3'],
    ['an open tag', '<materialx', 'syntax 1'],
    ['an open comment', '<materialx>\n<!-- ', 'syntax 2'],
    ['an attribute without quotes', '<materialx>\n<a b=c /></materialx>', 'syntax 2'],
    ['an attribute twice', '<materialx a="1" a="2"/>', 'syntax 1'],
    ['a circle', wrap('<input name="base_weight" type="float" nodegraph="G"/>', circle), 'reference 3'],
    [
      'an interface that is its own',
      wrap(
        '<input name="base_weight" type="float" nodegraph="G"/>',
        '<nodegraph name="G"><input name="i" type="float" nodegraph="G"/><output name="o" type="float" interfacename="i"/></nodegraph>',
      ),
      'reference 3',
    ],
    ['a node that is not there', wrap('\n<input name="base_weight" type="float" nodename="nowhere"/>'), 'reference 6'],
    [
      'a node graph without an output',
      wrap('<input name="base_weight" type="float" nodegraph="G"/>', '<nodegraph name="G"/>'),
      'reference 3',
    ],
    [
      'a surface that is not there',
      '<materialx><surfacematerial name="m"><input name="surfaceshader" nodename="s"/></surfacematerial></materialx>',
      'reference 1',
    ],
    ['a word for a number', wrap('<input name="base_weight" type="float" value="much"/>'), 'value 5'],
    ['an infinity', wrap('<input name="base_weight" type="float" value="1e999"/>'), 'value 5'],
    ['too few numbers', wrap('<input name="base_color" type="color3" value="1, 2"/>'), 'value 5'],
    ['no surface', '<materialx version="1.39">\n</materialx>', 'no-surface 1'],
    [
      'another surface',
      '<materialx><standard_surface name="s"/><surfacematerial name="m"><input name="surfaceshader" nodename="s"/></surfacematerial></materialx>',
      'no-surface 1',
    ],
  ])('%s', (_, text, expected) => {
    expect(fails(text)).toBe(expected);
  });

  it('bytes that are no UTF-8', () => expect(fails(Uint8Array.of(0xff, 0xfe, 0x3c, 0x00))).toBe('syntax -'));
  it('limits can be set', () => expect(fails(wrap(''), { limits: { elements: 2 } })).toBe('limit 7'));

  it('a graph in which every node is used twice costs what its nodes cost, not its paths', async () => {
    const graph = (levels: number, value: number) => {
      const nodes = Array.from(
        { length: levels },
        (_, i) =>
          `<add name="n${i}" type="float"><input name="in1" type="float" nodename="n${i + 1}"/><input name="in2" type="float" nodename="n${i + 1}"/></add>`,
      ).join('');
      const leaf = `<constant name="n${levels}" type="float"><input name="value" type="float" value="${value}"/></constant>`;
      return wrap('<input name="specular_weight" type="float" nodename="n0"/>', nodes + leaf);
    };
    const { operations: once } = await counter.measure(() => only(graph(10, 1e-9)));
    const { operations: twice } = await counter.measure(() => only(graph(20, 1e-9)));
    expect(twice / once).toBeLessThan(2.5);
    expect(only(graph(50, 1e-15)).parameters.specular_weight).toBeCloseTo(2 ** 50 * 1e-15, 6);
  });

  it('a chain that is too long is refused, not a crash', () => {
    const nodes = Array.from(
      { length: 20_000 },
      (_, i) => `<dot name="n${i}" type="float"><input name="in" type="float" nodename="n${i + 1}"/></dot>`,
    ).join('');
    expect(fails(wrap('<input name="base_weight" type="float" nodename="n0"/>', nodes))).toBe('limit 3');
  });

  it.each([
    ['on one line', ''],
    ['on many lines', '\n'],
  ])('a document %s costs what its length costs', async (_, end) => {
    const input = `<input name="file" type="filename" value="some/image/of/something.png" colorspace="srgb_texture" />${end}`;
    // Built-in searches count no operations, but the characters that they pass.
    let passed = 0;
    const { indexOf } = String.prototype;
    const search = vi.spyOn(String.prototype, 'indexOf').mockImplementation(function (this: string, what, from = 0) {
      const at = indexOf.call(this, what, from);
      passed += (at < 0 ? this.length : at) - from;
      return at;
    });
    const costs: { readonly operations: number; readonly passed: number; readonly length: number }[] = [];
    for (const images of [200, 400]) {
      const text = wrap('', `<image name="i" type="color3">${input.repeat(20)}</image>`.repeat(images));
      passed = 0;
      const { operations } = await counter.measure(() => void readMaterialX(text));
      costs.push({ operations, passed, length: text.length });
    }
    search.mockRestore();
    const [once, twice] = costs as [(typeof costs)[0], (typeof costs)[0]];
    expect(once.operations).toBeGreaterThan(200 * 20);
    expect(twice.operations / once.operations).toBeLessThan(2.1);
    // Each character at most once for the next tag, and once for the next line.
    expect(twice.passed).toBeLessThanOrEqual(2 * twice.length);
  });

  it('names of prototypes are names', () => {
    const { parameters, warnings } = only(
      wrap(
        '<input name="__proto__" type="float" value="1"/><input name="constructor" type="float" value="1"/><input name="base_weight" type="float" nodename="toString"/>',
        '<constant name="toString" type="float"><input name="value" type="float" value="0.5"/></constant>',
      ),
    );
    expect([parameters, warnings.length, ({} as Record<string, unknown>)['value']]).toEqual([
      { base_weight: 0.5 },
      2,
      undefined,
    ]);
  });

  it('10,000 documents with bytes changed at random are read or refused with a code', () => {
    const sound = writeMaterialX([
      {
        name: 'm',
        parameters: { base_color: [0.1, 0.2, 0.3], coat_weight: 0.5 },
        textures: {
          base_color: {
            file: 'a.png',
            channels: 'rgb',
            colorSpace: 'srgb',
            transform: [1, 2, 3, 4, 5, 6],
            range: [0.5, 1],
          },
          geometry_normal: { file: 'n.png', channels: 'rgb', colorSpace: 'linear' },
        },
      },
    ]).document;
    let state = 1;
    const random = (n: number) => (((state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32) * n) | 0;
    let read = 0;
    for (let round = 0; round < 10_000; round++) {
      const letters = [...sound];
      for (let k = random(4); k >= 0; k--)
        letters.splice(
          random(letters.length),
          random(3),
          ['<', '>', '"', '&', '/', 'a', '1', '-', ' ', ''][random(10)]!,
        );
      if (fails(letters.join('')) === 'read') read++;
    }
    expect(read).toBeGreaterThan(100);
    expect(read).toBeLessThan(9900);
  }, 30_000);
});

describe('writeMaterialX', () => {
  it('every preset comes back as it was', () => {
    for (const name of OPENPBR_PRESET_NAMES) {
      const { document, warnings } = writeMaterialX([{ name, parameters: OPENPBR_PRESETS[name] }]);
      expect(warnings).toEqual([]);
      const back = only(document);
      expect([back.name, back.warnings]).toEqual([name, []]);
      expect(resolveParameters(back.parameters), name).toEqual(resolveParameters(OPENPBR_PRESETS[name]));
    }
  });

  const close = (a: unknown, b: unknown): boolean => {
    if (typeof a === 'number' && typeof b === 'number') return Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(a));
    if (Array.isArray(a) && Array.isArray(b)) return a.length === b.length && a.every((x, i) => close(x, b[i]));
    if (a && b && typeof a === 'object' && typeof b === 'object')
      return close(Object.entries(a).toSorted(), Object.entries(b).toSorted());
    return Object.is(a, b);
  };
  it('200 random materials with textures come back as they were', () => {
    let state = 7;
    const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
    const pick = <T>(...values: readonly T[]) => values[Math.floor(random() * values.length)] as T;
    for (let round = 0; round < 200; round++) {
      const parameters: Partial<Record<OpenPbrParameterName, unknown>> = {},
        textures: Partial<Record<OpenPbrParameterName, MaterialXTexture>> = {};
      for (const parameter of OPENPBR_PARAMETER_NAMES) {
        const { type, softRange, default: initial } = OPENPBR_PARAMETERS[parameter];
        if (random() < 0.6) continue;
        const { texturable } = OPENPBR_PARAMETERS[parameter];
        const number = () => softRange![0] + (softRange![1] - softRange![0]) * (0.01 + 0.98 * random());
        if (type === 'boolean') parameters[parameter] = true;
        else if (type === 'float') parameters[parameter] = number();
        else if (type === 'color3') parameters[parameter] = [number(), number(), number()];
        else if (parameter.endsWith('tangent')) {
          const angle = 6 * random() - 3;
          parameters[parameter] = [Math.cos(angle), Math.sin(angle), 0];
        } else
          textures[parameter] = {
            file: 'normal & "map".png',
            channels: 'rgb',
            colorSpace: 'linear',
            ...(random() < 0.5 ? { scale: random() } : {}),
          };
        if (!texturable || type === 'vector3' || random() < 0.4) continue;
        parameters[parameter] ??= initial;
        textures[parameter] = {
          file: `dir/${parameter}.png`,
          channels: type === 'color3' ? pick('rgb', 'rgb', 'g', 'r') : pick('r', 'g', 'b', 'a'),
          colorSpace: pick('srgb', 'linear'),
          ...(random() < 0.3 ? { uv: 1 } : {}),
          ...(random() < 0.3
            ? { transform: [random(), random(), -random(), random(), random(), random()] as const }
            : {}),
          ...(random() < 0.3 ? { range: pick([0.25, 1] as const, [1, 0.5] as const) } : {}),
          ...(random() < 0.3 ? { wrapU: pick('clamp', 'mirror') } : {}),
          ...(random() < 0.3 ? { wrapV: pick('clamp', 'mirror') } : {}),
          ...(random() < 0.3 ? { filter: 'nearest' as const } : {}),
        };
      }
      const given: MaterialXMaterial = {
        name: `m_${round}`,
        parameters: parameters as Partial<OpenPbrParameters>,
        ...(Object.keys(textures).length ? { textures } : {}),
      };
      const { document, warnings } = writeMaterialX([given]);
      const { warnings: read, ...back } = only(document);
      expect([warnings, read]).toEqual([[], []]);
      expect(close(back, given), `${JSON.stringify(given)}\n${JSON.stringify(back)}`).toBe(true);
    }
  });

  it('names of many materials stay apart, and fit MaterialX', () => {
    const { document } = writeMaterialX([
      { name: 'Ein Lack', parameters: {} },
      { name: 'Ein_Lack', parameters: {} },
      { name: '3"<>', parameters: {} },
    ]);
    expect(readMaterialX(document).materials.map(({ name }) => name)).toEqual(['Ein_Lack', 'Ein_Lack_1', '_3___']);
    expect(document).not.toContain('<>');
  });

  it('says what it cannot hold', () => {
    const { warnings } = writeMaterialX([
      {
        name: 'm',
        parameters: { geometry_normal: [0, 1, 0] },
        textures: { geometry_tangent: { file: 'a', channels: 'rgb', colorSpace: 'linear' } },
      },
    ]);
    expect(warnings.map(({ code }) => code)).toEqual([
      'openpbr/materialx-unsupported',
      'openpbr/materialx-unsupported',
    ]);
  });
});

describe("the documentation's examples", () => {
  it('write what they say', () => {
    const { materials, warnings } = readMaterialX(documented);
    expect([warnings, materials.map(({ name }) => name), materials[1]!.textures]).toEqual([
      [],
      ['housing', 'label'],
      { base_color: { file: 'label.png', channels: 'rgb', colorSpace: 'srgb' } },
    ]);
  });

  it('dress a scene', async () => {
    const set: unknown[][] = [];
    await dress(
      { setMaterial: async (...given: unknown[]) => void set.push(given) } as never,
      `data:text/xml,${encodeURIComponent(documented)}`,
    );
    expect(set.map(([name]) => name)).toEqual(['housing', 'label']);
    expect(set[1]![1]).toEqual({ base_color: [0.8, 0.8, 0.8], specular_roughness: 0.8 });
  });
});
