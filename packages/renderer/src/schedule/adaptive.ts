import { TILE } from './tile';

/** Samples before noise is first looked at: four chunks. */
export const FIRST_CHECK = 64;

/** The number of samples after `samples` at which noise is looked at: 64, 96, 128, 192, 256, 384, … */
export function nextCheck(samples: number): number {
  for (let check = FIRST_CHECK; ; check *= 2) {
    if (samples < check) return check;
    if (samples < 1.5 * check) return 1.5 * check;
  }
}

/** The tiles of an image. */
export class TileGrid {
  readonly width: number;
  readonly height: number;
  readonly columns: number;
  readonly rows: number;

  constructor(width: number, height: number) {
    this.width = width;
    this.height = height;
    this.columns = Math.ceil(width / TILE);
    this.rows = Math.ceil(height / TILE);
  }

  /** Tiles. */
  get count(): number {
    return this.columns * this.rows;
  }

  /** Pixels of a tile: fewer at the right and lower edge. */
  pixelsIn(tile: number): number {
    const [x, y] = [(tile % this.columns) * TILE, Math.floor(tile / this.columns) * TILE];
    return Math.min(TILE, this.width - x) * Math.min(TILE, this.height - y);
  }

  /** Numbers of all pixels, tile by tile. */
  allPixels(): Uint32Array<ArrayBuffer> {
    const { width, height } = this;
    const out = new Uint32Array(width * height);
    for (let y0 = 0, at = 0; y0 < height; y0 += TILE)
      for (let x0 = 0; x0 < width; x0 += TILE) at = this.#write(out, at, x0, y0);
    return out;
  }

  /** Numbers of the pixels of some tiles, tile by tile. */
  pixels(tiles: readonly number[]): Uint32Array<ArrayBuffer> {
    const out = new Uint32Array(tiles.reduce((sum, tile) => sum + this.pixelsIn(tile), 0));
    let at = 0;
    for (const tile of tiles)
      at = this.#write(out, at, (tile % this.columns) * TILE, Math.floor(tile / this.columns) * TILE);
    return out;
  }

  /** Writes the numbers of a tile's pixels from `at` on; where the next tile's belong. */
  #write(out: Uint32Array, at: number, x0: number, y0: number): number {
    const x1 = Math.min(x0 + TILE, this.width),
      y1 = Math.min(y0 + TILE, this.height);
    for (let y = y0; y < y1; y++) for (let x = x0; x < x1; x++) out[at++] = y * this.width + x;
    return at;
  }
}
