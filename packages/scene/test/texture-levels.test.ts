import { describe, expect, it } from 'vitest';
import { planTextureLevels, textureBytes, visibleLoss, type TextureCost } from '../src/texture-budget';

const SEED = 20261128;

function randomly(seed: number): () => number {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** All choices of levels that are allowed. */
function* choices(textures: readonly TextureCost[], at = 0): Generator<number[]> {
  const texture = textures[at];
  if (!texture) return yield [];
  const full = Math.floor(Math.log2(Math.max(texture.width, texture.height)));
  const last = Math.min(full, texture.maxLevel ?? full);
  for (let level = Math.min(texture.minLevel ?? 0, last); level <= last; level++)
    for (const rest of choices(textures, at + 1)) yield [level, ...rest];
}

const bytesOf = (textures: readonly TextureCost[], levels: readonly number[]) =>
  textures.reduce((sum, texture, i) => sum + textureBytes(texture, levels[i]), 0);
const lossOf = (textures: readonly TextureCost[], levels: readonly number[]) =>
  Math.max(0, ...textures.map((texture, i) => visibleLoss(texture, levels[i]!)));

describe('planTextureLevels', () => {
  it(`fits, loses as little as any choice does, and leaves no room for a level (seed ${SEED})`, () => {
    const random = randomly(SEED);
    const whole = (n: number) => Math.floor(n * random());
    let [refused, dropped] = [0, 0];
    for (let round = 0; round < 400; round++) {
      const textures = Array.from({ length: 1 + whole(4) }, (): TextureCost => ({
        width: 1 + whole(40),
        height: 1 + whole(40),
        texelBytes: [1, 4, 8][whole(3)]!,
        mips: random() < 0.8,
        minLevel: random() < 0.2 ? 1 : 0,
        ...(random() < 0.3 ? { maxLevel: whole(3) } : {}),
        ...(random() < 0.7 ? { need: 6 * random() - 2 } : {}),
      }));
      const budget = whole(
        1.1 *
          bytesOf(
            textures,
            textures.map(() => 0),
          ),
      );
      const fitting = [...choices(textures)].filter((levels) => bytesOf(textures, levels) <= budget);
      if (fitting.length === 0) {
        refused++;
        expect(() => planTextureLevels(textures, budget)).toThrowError(
          expect.objectContaining({ code: 'scene/texture-budget' }),
        );
        continue;
      }
      const plan = planTextureLevels(textures, budget);
      expect(plan.bytes).toBe(bytesOf(textures, plan.levels));
      expect(plan.fullBytes).toBe(
        bytesOf(
          textures,
          textures.map(() => 0),
        ),
      );
      expect(fitting).toContainEqual(plan.levels);
      expect(lossOf(textures, plan.levels)).toBe(Math.min(...fitting.map((levels) => lossOf(textures, levels))));
      plan.levels.forEach((level, i) => {
        if (level > 0) dropped++;
        const finer = plan.levels.map((other, j) => (i === j ? other - 1 : other));
        expect(fitting).not.toContainEqual(finer);
      });
    }
    expect([refused > 20, dropped > 200]).toEqual([true, true]);
  });

  it('drops nothing within the budget, and exactly what is over it', () => {
    const textures = Array.from({ length: 60 }, () => ({ width: 8192, height: 8192, texelBytes: 4 }));
    const full = textureBytes(textures[0]!);
    expect(planTextureLevels(textures, 60 * full).levels).toEqual(textures.map(() => 0));
    expect(planTextureLevels(textures, 60 * full - 1).levels).toEqual([1, ...textures.slice(1).map(() => 0)]);
  });

  it('drops what cannot be seen before what can, and the largest of equals', () => {
    const far = { width: 64, height: 64, texelBytes: 4, need: 2 };
    const near = { width: 1024, height: 1024, texelBytes: 4, need: 0 };
    const sum = textureBytes(far) + textureBytes(near);
    expect(planTextureLevels([near, far], sum - 1).levels).toEqual([0, 1]);
    const [small, large] = [256, 512].map((width) => ({ width, height: 256, texelBytes: 4 })) as [
      TextureCost,
      TextureCost,
    ];
    expect(planTextureLevels([small, large], textureBytes(small) + textureBytes(large) - 1).levels).toEqual([0, 1]);
  });

  it('says what it lacks', () => {
    const blocks = { width: 2048, height: 2048, texelBytes: 1, maxLevel: 0, mips: false };
    expect(() => planTextureLevels([blocks, blocks], 2 ** 20)).toThrowError(
      /2 images take 8\.0 MiB, and 8\.0 MiB with all levels dropped that can be; the budget is 1\.0 MiB/,
    );
  });
});
