import { OperationCounter } from '@glanz/operations';
import { afterAll, describe, expect, it } from 'vitest';
import { decodeEnvironment, encodeExr, encodeHdr, ImageError } from '../src/index';
import { hasShared, shared } from './shared';

const counter = new OperationCounter(/\/packages\/image\/src\/|\/fflate\//);
afterAll(() => counter.end());

const exr = () =>
  encodeExr({
    width: 1,
    height: 1,
    compression: 'none',
    layers: [{ name: '', channels: { R: Float32Array.of(1), G: Float32Array.of(1), B: Float32Array.of(1) } }],
  });

/** An image of one pixel with numbers put over those of an attribute in its header. */
function patched(attribute: string, values: Float32Array | Int32Array): Uint8Array {
  const bytes = exr();
  // Two names that end with zeros, and the size.
  const at = String.fromCharCode(...bytes).indexOf(attribute) + attribute.length + 4;
  bytes.set(new Uint8Array(values.buffer), at);
  return bytes;
}

describe('decodeEnvironment', () => {
  it('distinguishes HDR from EXR by the first bytes', () => {
    const data = Float32Array.of(1, 2, 4, 0.5, 0.25, 0);
    expect([...decodeEnvironment(encodeHdr({ width: 2, height: 1, data })).data]).toEqual([...data]);
    const exr = encodeExr({
      width: 2,
      height: 1,
      layers: [
        { name: '', channels: { R: Float32Array.of(1, 0.5), G: Float32Array.of(2, 0.25), B: Float32Array.of(4, 0) } },
      ],
    });
    const image = decodeEnvironment(exr);
    expect([...image.data]).toEqual([...data]);
    expect(image.warnings).toEqual([]);
    expect(() => decodeEnvironment(Uint8Array.of(1, 2, 3, 4, 5))).toThrow(ImageError);
    expect(() => decodeEnvironment(new Uint8Array(0))).toThrow(/neither/);
  });
  it('takes grey from Y, and names the channels when there is no colour', () => {
    expect([
      ...decodeEnvironment(
        encodeExr({ width: 1, height: 1, layers: [{ name: '', channels: { Y: Float32Array.of(3) } }] }),
      ).data,
    ]).toEqual([3, 3, 3]);
    expect(() =>
      decodeEnvironment(
        encodeExr({ width: 1, height: 1, layers: [{ name: 'depth', channels: { Z: Float32Array.of(3) } }] }),
      ),
    ).toThrow(/only depth\.Z/);
  });
  it('warns where Y is taken as grey beside other colours, and not beside a depth', () => {
    const decode = (...names: string[]) =>
      decodeEnvironment(
        encodeExr({
          width: 1,
          height: 1,
          layers: [{ name: '', channels: Object.fromEntries(names.map((name, i) => [name, Float32Array.of(i + 1)])) }],
        }),
      );
    for (const [names, grey, unread] of [
      [['X', 'Y', 'Z'], 2, 'X, Z'],
      [['Y', 'RY', 'BY'], 1, 'RY, BY'],
      [['R', 'Y'], 2, 'R'],
    ] as const) {
      const image = decode(...names);
      expect([...image.data], names.join()).toEqual([grey, grey, grey]);
      expect(
        image.warnings.map(({ code }) => code),
        names.join(),
      ).toEqual(['image/grey']);
      expect(image.warnings[0]?.message).toContain(`${unread} not read`);
    }
    expect(decode('Y', 'Z', 'A').warnings).toEqual([]);
    expect([...decode('R', 'G', 'B', 'X', 'Y').data]).toEqual([1, 2, 3]);
  });
  it('warns of colours that are not those of Rec.709', () => {
    const primaries = (...numbers: number[]) =>
      decodeEnvironment(patched('chromaticities\0chromaticities\0', Float32Array.from(numbers))).warnings.map(
        ({ code }) => code,
      );
    expect(primaries(0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329)).toEqual([]);
    // ACES 2065-1 (SMPTE ST 2065-1).
    expect(primaries(0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767)).toEqual(['image/primaries']);
    expect(primaries(NaN, 0, 0, 0, 0, 0, 0, 0)).toEqual([]);
  });
  it('warns of a part of a larger image', () => {
    expect(
      decodeEnvironment(patched('displayWindow\0box2i\0', Int32Array.of(0, 0, 7, 0))).warnings.map(({ code }) => code),
    ).toEqual(['image/window']);
  });
  it('makes radiance of NaN, infinities and negatives, and says so', () => {
    const exr = encodeExr({
      width: 1,
      height: 1,
      layers: [
        {
          name: '',
          type: 'float',
          channels: { R: Float32Array.of(NaN), G: Float32Array.of(Infinity), B: Float32Array.of(-1) },
        },
      ],
    });
    const image = decodeEnvironment(exr);
    expect([...image.data]).toEqual([0, 3.4028234663852886e38, 0]);
    expect(image.warnings[0]?.message).toMatch(/3 negative or non-finite/);
  });
});

interface BadFile {
  readonly file: string;
  readonly kind: string;
  readonly expect: string;
  readonly alsoOk?: readonly string[];
  readonly why: string;
  readonly stored?: boolean;
}

describe.skipIf(!hasShared)(
  `${hasShared ? '' : '[skipped: ../shared is absent] '}the corpus of bad environments`,
  () => {
    const list = hasShared
      ? (JSON.parse(new TextDecoder().decode(shared('bad/index.json'))) as BadFile[]).filter(
          (e) => e.kind === 'env' && e.stored !== false,
        )
      : [];

    it('holds what it should', () => {
      expect(list.length).toBeGreaterThan(100);
    });
    it('every file ends as labelled: in few operations, no raw error, no number that is not radiance', async () => {
      for (const entry of list) {
        const bytes = shared(`bad/${entry.file}`);
        let outcome: string;
        let values = 0;
        const { operations } = await counter.measure(() => {
          try {
            const image = decodeEnvironment(bytes);
            values = image.data.length;
            expect(
              image.data.every((v) => v >= 0 && v < Infinity),
              entry.file,
            ).toBe(true);
            outcome = image.warnings.length > 0 ? 'accept-with-warning' : 'accept';
          } catch (error) {
            if (!(error instanceof ImageError)) throw new Error(`${entry.file}: raw error`, { cause: error });
            expect(error.message).not.toMatch(/\n/);
            outcome = 'reject';
          }
        });
        expect([entry.expect, ...(entry.alsoOk ?? [])], `${entry.file} (${entry.why})`).toContain(outcome!);
        // What a file costs depends on what is in it, not on what it claims: the Huffman codes of PIZ take 30
        // operations a byte.
        expect(operations, entry.file).toBeLessThan(4096 + 64 * (bytes.length + values));
      }
    });
  },
);
