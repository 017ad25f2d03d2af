/** Samples that the history counts for at most, as in the filter. */
const LONGEST = 8;

/**
 * Reprojection as the first idea has it, to compare with: each pixel is averaged with what was where its surface was,
 * whatever that showed. Leaves ghosts wherever what is seen moves otherwise than the surface, or was hidden.
 */
export function uncheckedReprojection(width: number, height: number) {
  let history: Float32Array | undefined;
  let frames = 0;
  return {
    /**
     * @param frame Linear RGBA, the top row first.
     * @param motion Pixels from where the surface is to where it was, two a pixel.
     * @returns The frame, averaged with those before it.
     */
    add(frame: Float32Array, motion: Float32Array): Float32Array {
      frames = Math.min(frames + 1, LONGEST);
      const out = Float32Array.from(frame);
      const before = history;
      if (before)
        for (let y = 0; y < height; y++)
          for (let x = 0; x < width; x++) {
            const at = y * width + x;
            const [u, v] = [x + motion[2 * at]!, y + motion[2 * at + 1]!];
            if (u < 0 || v < 0 || u > width - 1 || v > height - 1) continue;
            const [left, top] = [Math.min(Math.floor(u), width - 2), Math.min(Math.floor(v), height - 2)];
            const [s, t] = [u - left, v - top];
            for (let k = 0; k < 4; k++) {
              const of = (dx: number, dy: number) => before[4 * ((top + dy) * width + left + dx) + k]!;
              const past = (1 - t) * ((1 - s) * of(0, 0) + s * of(1, 0)) + t * ((1 - s) * of(0, 1) + s * of(1, 1));
              out[4 * at + k] = past + (frame[4 * at + k]! - past) / frames;
            }
          }
      history = out;
      return out;
    },
  };
}
