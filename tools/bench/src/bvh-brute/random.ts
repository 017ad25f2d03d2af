/** A seeded generator of numbers in [0, 1): PCG-RXS-M-XS of 32 bits (O'Neill 2014). */
export function randomNumbers(seed: number): () => number {
  let state = (seed ^ 0x9e3779b9) >>> 0;
  return () => {
    state = (Math.imul(state, 747796405) + 2891336453) >>> 0;
    const word = Math.imul((state >>> ((state >>> 28) + 4)) ^ state, 277803737);
    return (((word >>> 22) ^ word) >>> 0) / 2 ** 32;
  };
}

/** A direction of unit length, evenly spread. */
export function randomDirection(random: () => number): [number, number, number] {
  const z = 2 * random() - 1,
    phi = 2 * Math.PI * random(),
    r = Math.sqrt(1 - z * z);
  return [r * Math.cos(phi), r * Math.sin(phi), z];
}
