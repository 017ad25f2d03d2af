import { describe, expect, it } from 'vitest';
import { CadError, cadToScene, checkMaterialMap, readCad } from '../src/index';
import { openOcct } from '../src/node';
import { CUBE, stepBytes } from './step';

const bytes = (text: string) => new TextEncoder().encode(text);
const step = (data: string) =>
  bytes(
    `ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n${data}\nENDSEC;\nEND-ISO-10303-21;\n`,
  );

describe('CAD files that make no sense are typed errors, or a model without them', { timeout: 120_000 }, () => {
  it.each([
    ['nothing in it', step('')],
    ['an entity that does not exist', step('#1=FOO(#1,#2);')],
    [
      'entities made of themselves',
      step(
        "#1=SHAPE_DEFINITION_REPRESENTATION(#1,#1);\n#2=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#2),#2);\n#3=MANIFOLD_SOLID_BREP('',#3);\n#4=CLOSED_SHELL('',(#4));",
      ),
    ],
    ['parentheses a hundred thousand deep', step(`#1=A(${'('.repeat(100_000)}${')'.repeat(100_000)});`)],
    ['a text without an end', step("#1=PRODUCT('x")],
    ['numbers beyond all bounds', step("#1=CARTESIAN_POINT('',(1.E999,-1.E999,NAN));\n#2=VERTEX_POINT('',#1);")],
    ['a name of a megabyte', step(`#1=PRODUCT('${'x'.repeat(1e6)}','','',());`)],
    ['a head alone', bytes('ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((')],
    ['zeros behind a head', new Uint8Array([...bytes('ISO-10303-21;'), ...new Uint8Array(1e5)])],
    [
      'a sound file whose middle is noise',
      (() => {
        const file = stepBytes(CUBE).slice();
        for (let i = 2000; i < 4000; i++) file[i] = (i * 7919) % 256;
        return file;
      })(),
    ],
  ] as const)('%s', async (_, file) => {
    const outcome = await readCad(file, { openOcct, format: 'step', name: 'a.step' }).catch((error: unknown) => error);
    if (outcome instanceof Error) expect(outcome).toBeInstanceOf(CadError);
    else
      for (const { positions } of cadToScene(outcome as Awaited<ReturnType<typeof readCad>>).meshes)
        expect(positions.every(Number.isFinite)).toBe(true);
  });

  it.each([
    ['iges', `${'x'.repeat(72)}S      1\n`],
    ['brep', 'DBRep_DrawableShape\nCASCADE Topology V1\nLocations 99999999\n'],
  ] as const)('%s', async (format, text) => {
    await expect(readCad(bytes(text), { openOcct, format, name: 'a' })).rejects.toBeInstanceOf(CadError);
  });

  it('maps cannot reach prototypes or hang in their wild cards', () => {
    expect(() => checkMaterialMap(JSON.parse('{"rules":[{"part":"x","preset":"constructor"}]}'))).toThrow(CadError);
    expect(() =>
      checkMaterialMap(JSON.parse('{"rules":[{"part":"x","parameters":{"__proto__":{"polluted":1}}}]}')),
    ).toThrow(CadError);
    expect('polluted' in {}).toBe(false);
    const map = checkMaterialMap({ rules: [{ part: `${'*a'.repeat(2000)}b`, preset: 'brass' }] });
    const model = {
      name: 'm',
      parts: [
        {
          name: 'a'.repeat(5000),
          path: [],
          positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]),
          indices: new Uint32Array([0, 1, 2]),
          ranges: [{ from: 0, to: 1 }],
        },
      ],
    };
    expect(cadToScene(model as never, { materials: map }).instances.length).toBe(1);
  });
});
