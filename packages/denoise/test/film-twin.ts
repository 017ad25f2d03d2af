/** Images in memory: four floats a pixel. */
export interface TwinImages {
  readonly width: number;
  readonly height: number;
  readonly film: Float32Array;
  readonly denoised: Float32Array;
  readonly variance?: Float32Array | undefined;
}

const TILE = 8;
const LUMINANCE = [0.212671, 0.71516, 0.072169] as const;
const BINOMIAL = [1 / 16, 4 / 16, 6 / 16, 4 / 16, 1 / 16] as const;
/** Share of the power of white noise after that blur along both axes. */
const LEFT = BINOMIAL.reduce((sum, weight) => sum + weight ** 2, 0) ** 2;

const clean = (value: number) => (Number.isFinite(value) && value > 0 ? Math.min(value, 1e15) : 0);
const power = (rgb: readonly number[]) => rgb.reduce((sum, value) => sum + value ** 2, 0) / 3;

/** What the blend of film and denoised image is, written from its description: RGBA. */
export function blendTwin({ width, height, film, denoised, variance }: TwinImages): Float32Array {
  const tilesX = Math.ceil(width / TILE);
  const tilesY = Math.ceil(height / TILE);
  const inside = (x: number, y: number) => x >= 0 && y >= 0 && x < width && y < height;
  const difference = (x: number, y: number) =>
    [0, 1, 2].map((c) => {
      const at = 4 * (y * width + x) + c;
      return inside(x, y) ? clean(film[at]!) - denoised[at]! : 0;
    });
  const blurred = (x: number, y: number) => {
    const sum = [0, 0, 0];
    for (let v = 0; v < 5; v++)
      for (let u = 0; u < 5; u++)
        difference(x + u - 2, y + v - 2).forEach((value, c) => (sum[c]! += BINOMIAL[u]! * BINOMIAL[v]! * value));
    return sum;
  };
  const varianceAt = (x: number, y: number) =>
    variance ? [0, 1, 2].reduce((sum, c) => sum + variance[4 * (y * width + x) + c]! / 3, 0) : 0;
  const tiles = Array.from({ length: tilesX * tilesY }, (_, tile) => {
    const sums = [0, 0, 0, 0];
    let count = 0;
    for (let i = 0; i < TILE * TILE; i++) {
      const x = (tile % tilesX) * TILE + (i % TILE);
      const y = Math.floor(tile / tilesX) * TILE + Math.floor(i / TILE);
      if (!inside(x, y)) continue;
      count++;
      sums[0]! += power(difference(x, y));
      sums[1]! += power(blurred(x, y));
      sums[2]! += LUMINANCE.reduce((sum, weight, c) => sum + weight * denoised[4 * (y * width + x) + c]!, 0);
      sums[3]! += varianceAt(x, y);
    }
    return sums.map((sum) => sum / count);
  });
  const spline = (t: number) => [0.5 * (0.5 - t) ** 2, 0.75 - t ** 2, 0.5 * (0.5 + t) ** 2];
  const result = film.slice();
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++) {
      const [tx, ty] = [Math.floor(x / TILE), Math.floor(y / TILE)];
      const [wx, wy] = [spline((x + 0.5) / TILE - tx - 0.5), spline((y + 0.5) / TILE - ty - 0.5)];
      const [all, low, L, known] = [0, 1, 2, 3].map((k) => {
        let sum = 0;
        for (let v = 0; v < 3; v++)
          for (let u = 0; u < 3; u++) {
            const nearX = Math.min(Math.max(tx + u - 1, 0), tilesX - 1);
            const nearY = Math.min(Math.max(ty + v - 1, 0), tilesY - 1);
            sum += wx[u]! * wy[v]! * tiles[nearY * tilesX + nearX]![k]!;
          }
        return sum;
      }) as [number, number, number, number];
      const bias = Math.min(Math.max((low - LEFT * all) / (1 - LEFT), 0), all);
      let noise = Math.max(all - bias, power(difference(x, y)) / 9);
      if (variance) noise = Math.min(noise, Math.max(known, varianceAt(x, y)));
      noise = Math.max(noise - (0.005 * L) ** 2, 0);
      if (noise === 0) continue;
      const share = noise / (noise + bias + (0.08 * L) ** 2);
      for (let c = 0; c < 3; c++) {
        const at = 4 * (y * width + x) + c;
        result[at] = clean(film[at]!) + share * (denoised[at]! - clean(film[at]!));
      }
    }
  return result;
}
