const hash = (x: number, y: number, z: number): number => {
  let h = Math.imul(x, 0x27d4eb2d) ^ Math.imul(y, 0x165667b1) ^ Math.imul(z, 0x9e3779b1);
  h = Math.imul(h ^ (h >>> 15), 0x85ebca6b);
  h = Math.imul(h ^ (h >>> 13), 0xc2b2ae35);
  return ((h ^ (h >>> 16)) >>> 0) / 2 ** 32;
};
const fade = (t: number): number => t * t * t * (t * (6 * t - 15) + 10);

/** Smooth value noise in [−1, 1] of period 1 between lattice points. */
export function noise(x: number, y: number, z: number): number {
  const [i, j, k] = [Math.floor(x), Math.floor(y), Math.floor(z)];
  const [u, v, w] = [fade(x - i), fade(y - j), fade(z - k)];
  const mix = (a: number, b: number, t: number) => a + (b - a) * t;
  const row = (dj: number, dk: number) => mix(hash(i, j + dj, k + dk), hash(i + 1, j + dj, k + dk), u);
  return 2 * mix(mix(row(0, 0), row(1, 0), v), mix(row(0, 1), row(1, 1), v), w) - 1;
}

/** Noise of several octaves, each of half the size and half the height. */
export function fractalNoise(x: number, y: number, z: number, octaves: number): number {
  let sum = 0;
  for (let i = 0; i < octaves; i++) sum += noise(x * 2 ** i, y * 2 ** i, z * 2 ** i + 17 * i) / 2 ** i;
  return sum;
}

/** A repeatable sequence of numbers in [0, 1). */
export function randomSequence(seed: number): () => number {
  let i = 0;
  return () => hash(seed, ++i, 7919);
}
