import { compose } from '@glanz/wgsl';
import { describe, expect, it } from 'vitest';
import {
  OPENPBR_PARAMETER_NAMES,
  OPENPBR_PARAMETERS,
  resolveParameters,
  type OpenPbrParameters,
} from '../src/parameters/index';
import { openPbrStruct, packOpenPbr } from '../src/wgsl/index';

describe('packOpenPbr', () => {
  // A number of its own for every component of every parameter.
  let next = 0;
  const own = () => ++next / 256;
  const distinct = Object.fromEntries(
    OPENPBR_PARAMETER_NAMES.map((name) => {
      const { type } = OPENPBR_PARAMETERS[name];
      return [name, type === 'boolean' ? true : type === 'float' ? own() : [own(), own(), own()]];
    }),
  ) as unknown as OpenPbrParameters;

  const own111 = OPENPBR_PARAMETER_NAMES.filter((name) => !OPENPBR_PARAMETERS[name].draft);

  it('has a field of its own for every parameter, but one for those of the draft', () => {
    expect(openPbrStruct.fields.map(({ name }) => name).toSorted()).toEqual([...own111, 'specular_lobes'].toSorted());
  });

  it('holds those of the draft in ten bits each, within the padding of a record without them', () => {
    const buffer = openPbrStruct.allocate();
    packOpenPbr(
      buffer,
      0,
      resolveParameters({ specular_haze: 1, specular_haze_spread: 0.25, specular_retroreflectivity: 0.5 }),
    );
    const at = openPbrStruct.offsetOf('specular_lobes');
    const word = new Uint32Array(buffer)[at / 4] as number;
    expect([word & 1023, (word >> 10) & 1023, word >> 20]).toEqual([1023, 256, 512]);
    expect(at + 4).toBe(openPbrStruct.size);
    const text = (OPENPBR_LOBES: boolean) => compose([openPbrStruct.module], { flags: { OPENPBR_LOBES } }).code;
    expect(text(true)).toBe(text(false).replace(/}\n$/, '  specular_lobes: u32,\n}\n'));
  });

  it('writes each into its place, and no other record', () => {
    const buffer = openPbrStruct.allocate(3);
    packOpenPbr(buffer, 1, distinct);
    const floats = new Float32Array(buffer, openPbrStruct.size),
      integers = new Uint32Array(buffer, openPbrStruct.size);
    const taken = new Set<number>();
    for (const name of own111) {
      const at = openPbrStruct.offsetOf(name as 'base_color') / 4;
      const value = distinct[name];
      if (typeof value === 'boolean') expect(integers[at]).toBe(1);
      else [value].flat().forEach((component, i) => expect(floats[at + i], name).toBe(component));
      for (let i = 0; i < [value].flat().length; i++) expect(taken.has(at + i) || !taken.add(at + i)).toBe(false);
    }
    const bytes = new Uint8Array(buffer);
    expect(bytes.subarray(0, openPbrStruct.size).every((byte) => byte === 0)).toBe(true);
    expect(bytes.subarray(2 * openPbrStruct.size).every((byte) => byte === 0)).toBe(true);
  });

  it('writes unperturbed vectors for null', () => {
    const buffer = openPbrStruct.allocate();
    packOpenPbr(buffer, 0, resolveParameters());
    const vector = (name: 'geometry_normal' | 'geometry_tangent' | 'geometry_coat_normal' | 'geometry_coat_tangent') =>
      Array.from(new Float32Array(buffer, openPbrStruct.offsetOf(name), 3));
    expect([
      vector('geometry_normal'),
      vector('geometry_tangent'),
      vector('geometry_coat_normal'),
      vector('geometry_coat_tangent'),
    ]).toEqual([
      [0, 0, 1],
      [1, 0, 0],
      [0, 0, 1],
      [1, 0, 0],
    ]);
  });
});
