import { existsSync, readFileSync, statSync } from 'node:fs';
import { validateScene } from '@glanz/scene';
import { OperationCounter } from '@glanz/operations';
import { afterAll, describe, expect, test } from 'vitest';
import { decodeImage, GltfError, loadGltf, loadGltfFile } from '../src/node';
import { presence, sharedIndex, sharedPath } from './shared';

interface Case {
  readonly file: string;
  readonly kind: string;
  readonly expect: Outcome;
  readonly alsoOk?: readonly Outcome[];
}

type Outcome = 'reject' | 'accept-with-warning' | 'accept';

const { present, note } = presence('bad/index.json');
const stored = sharedIndex<Case>('bad/index.json').filter(({ file }) => existsSync(sharedPath(`bad/${file}`)));
const cases = stored.filter(({ kind }) => kind === 'gltf');
/** PNG, JPEG and WebP; ktx2.test.ts has the others. */
const images = stored.filter(({ kind, file }) => kind === 'image' && !file.endsWith('.ktx2'));

const counter = new OperationCounter(/\/packages\/(gltf|scene|openpbr)\/src\/|\/node_modules\/(?!sharp)/);
afterAll(() => counter.end());

/** Files whose operations are counted at once: reading the counters takes longer than reading a file. */
const TOGETHER = 32;

async function judge({ file }: Case): Promise<{ outcome: Outcome; fault?: string }> {
  try {
    const scene = await loadGltfFile(sharedPath(`bad/${file}`), { allowEmpty: true });
    const outcome = scene.warnings.length > 0 ? 'accept-with-warning' : 'accept';
    try {
      validateScene(scene);
    } catch (error) {
      return { outcome, fault: `gives a scene that is none: ${(error as Error).message}` };
    }
    return { outcome };
  } catch (error) {
    if (!(error instanceof GltfError)) return { outcome: 'reject', fault: `throws ${String(error)}` };
    return /\n/.test(error.message)
      ? { outcome: 'reject', fault: 'has a message of several lines' }
      : { outcome: 'reject' };
  }
}

describe.skipIf(!present)(`files that are broken, hostile or odd${note}`, () => {
  test(
    'each is a scene that is sound or a typed error of one line, as its label says',
    { timeout: 600_000 },
    async () => {
      const faults: string[] = [],
        missed: string[] = [];
      for (let first = 0; first < cases.length; first += TOGETHER) {
        const some = cases.slice(first, first + TOGETHER);
        const { operations } = await counter.measure(async () => {
          for (const one of some) {
            const { outcome, fault } = await judge(one);
            if (fault) faults.push(`${one.file} ${fault}`);
            if (outcome !== one.expect && !one.alsoOk?.includes(outcome))
              missed.push(`${one.file}: ${outcome} instead of ${one.expect}`);
          }
        });
        // What a file costs depends on its length, not on what it claims: 50,000 nodes without names take 23 operations
        // a byte.
        const limit = some.reduce((sum, { file }) => sum + 65_536 + 64 * statSync(sharedPath(`bad/${file}`)).size, 0);
        if (operations > limit)
          faults.push(`${some[0]?.file} to ${some.at(-1)?.file} take ${operations} operations, more than ${limit}`);
      }
      expect(faults).toEqual([]);
      expect(Object.keys(Object.prototype)).toEqual([]);
      expect(missed).toEqual([]);
      expect(cases.length).toBeGreaterThan(1000);
    },
  );

  test(
    'each image is decoded, left out with a warning or refused, as its label says',
    { timeout: 120_000 },
    async () => {
      const missed: string[] = [];
      for (const { file, expect: expected, alsoOk = [] } of images) {
        const uri = `data:image/png;base64,${readFileSync(sharedPath(`bad/${file}`)).toString('base64')}`;
        const document = {
          asset: { version: '2.0' },
          images: [{ uri }],
          textures: [{ source: 0 }],
          materials: [{ normalTexture: { index: 0 } }],
        };
        const load = loadGltf(new TextEncoder().encode(JSON.stringify(document)), { allowEmpty: true, decodeImage });
        const outcome = await load.then(
          ({ warnings }): Outcome =>
            warnings.some(({ message }) => message.includes('cannot be decoded and is left out'))
              ? 'reject'
              : warnings.length > 0
                ? 'accept-with-warning'
                : 'accept',
          (error: unknown): Outcome => {
            if (error instanceof GltfError) return 'reject';
            throw error;
          },
        );
        if (outcome !== expected && !alsoOk.includes(outcome))
          missed.push(`${file}: ${outcome} instead of ${expected}`);
      }
      expect(missed).toEqual([]);
      expect(images.length).toBeGreaterThan(40);
    },
  );
});
