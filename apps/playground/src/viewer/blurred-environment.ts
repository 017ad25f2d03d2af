import type { Camera, Environment, LatLongEnvironment } from '@glanz/scene';
import { toneMapPixels, type ToneMapOptions } from '@glanz/tonemap';

/** Pixels of the backdrop's longer side: it is blurred, more would not show. */
const LONGER_SIDE = 256;

/** A lat-long image blurred by a Gaussian on the sphere, in texels of half its standard deviation. */
export function blurEnvironment({ width, height, data }: LatLongEnvironment, degrees: number): LatLongEnvironment {
  const sigma = (Math.max(degrees, 2) * Math.PI) / 180;
  const rows = Math.max(8, Math.min(128, Math.round((2 * Math.PI) / sigma)));
  const columns = 2 * rows;
  const small = shrink(data, width, height, columns, rows);
  const out = new Float32Array(columns * rows * 3);
  const directions = new Float64Array(columns * rows * 3);
  const area = new Float64Array(rows);
  for (let j = 0; j < rows; j++) {
    const theta = ((j + 0.5) / rows) * Math.PI;
    area[j] = Math.sin(theta);
    for (let i = 0; i < columns; i++) {
      const phi = ((i + 0.5) / columns - 0.5) * 2 * Math.PI;
      directions.set(
        [Math.sin(theta) * Math.cos(phi), Math.cos(theta), Math.sin(theta) * Math.sin(phi)],
        (j * columns + i) * 3,
      );
    }
  }
  const reach = Math.cos(Math.min(Math.PI, 3 * sigma));
  const reachRows = Math.ceil((3 * sigma * rows) / Math.PI);
  for (let j = 0; j < rows; j++) {
    for (let i = 0; i < columns; i++) {
      const at = (j * columns + i) * 3;
      const [x, y, z] = [directions[at]!, directions[at + 1]!, directions[at + 2]!];
      let [r, g, b, total] = [0, 0, 0, 0];
      for (let k = Math.max(0, j - reachRows); k <= Math.min(rows - 1, j + reachRows); k++) {
        for (let l = 0; l < columns; l++) {
          const from = (k * columns + l) * 3;
          const cosine = x * directions[from]! + y * directions[from + 1]! + z * directions[from + 2]!;
          if (cosine < reach) continue;
          // 1 − cos is half the squared angle, near enough for a blur.
          const weight = area[k]! * Math.exp((cosine - 1) / (sigma * sigma));
          r += weight * small[from]!;
          g += weight * small[from + 1]!;
          b += weight * small[from + 2]!;
          total += weight;
        }
      }
      out.set([r / total, g / total, b / total], at);
    }
  }
  return { type: 'latlong', width: columns, height: rows, data: out };
}

/** Means over the areas of larger texels, along one axis after the other. */
function shrink(data: Float32Array, width: number, height: number, columns: number, rows: number): Float32Array {
  return resample(
    resample(
      data,
      width,
      columns,
      height,
      (x, y) => 3 * (y * width + x),
      (x, y) => 3 * (y * columns + x),
    ),
    height,
    rows,
    columns,
    (y, x) => 3 * (y * columns + x),
    (y, x) => 3 * (y * columns + x),
  );
}

/** Means along one axis from `count` texels to `wanted`, for each of the `others` along the other axis. */
function resample(
  data: Float32Array,
  count: number,
  requested: number,
  others: number,
  from: (i: number, other: number) => number,
  to: (i: number, other: number) => number,
): Float32Array {
  const out = new Float32Array(requested * others * 3);
  const size = count / requested;
  for (let i = 0; i < requested; i++) {
    const [begin, end] = [i * size, (i + 1) * size];
    for (let k = Math.floor(begin); k < Math.min(count, Math.ceil(end - 1e-9)); k++) {
      const share = (Math.min(end, k + 1) - Math.max(begin, k)) / size;
      for (let other = 0; other < others; other++) {
        const [source, target] = [from(k, other), to(i, other)];
        for (let c = 0; c < 3; c++) out[target + c]! += share * data[source + c]!;
      }
    }
  }
  return out;
}

/** Radiance of a lat-long image in a direction of its own frame, bilinear. */
function look(
  { width, height, data }: LatLongEnvironment,
  x: number,
  y: number,
  z: number,
  out: Float32Array,
  at: number,
): void {
  const u = (Math.atan2(z, x) / (2 * Math.PI) + 0.5) * width - 0.5;
  const v = Math.min(Math.max((Math.acos(Math.min(1, Math.max(-1, y))) / Math.PI) * height - 0.5, 0), height - 1);
  const [i, j] = [Math.floor(u), Math.floor(v)];
  const [fx, fy] = [u - i, v - j];
  const texel = (column: number, row: number, k: number) =>
    data[3 * (Math.min(row, height - 1) * width + (((column % width) + width) % width)) + k]!;
  for (let k = 0; k < 3; k++)
    out[at + k] =
      (texel(i, j, k) * (1 - fx) + texel(i + 1, j, k) * fx) * (1 - fy) +
      (texel(i, j + 1, k) * (1 - fx) + texel(i + 1, j + 1, k) * fx) * fy;
}

/** Draws a blurred environment behind an image whose own background is empty. */
export class BlurredEnvironment {
  readonly #canvas: HTMLCanvasElement;
  #blurred:
    | { readonly data: Float32Array; readonly degrees: number; readonly environment: LatLongEnvironment }
    | undefined;

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
  }

  /** Codes of what is behind the model, as {@link draw} last left them. */
  get image(): ImageData | undefined {
    const { width, height } = this.#canvas;
    return this.#canvas.hidden ? undefined : this.#canvas.getContext('2d')?.getImageData(0, 0, width, height);
  }

  hide(): void {
    this.#canvas.hidden = true;
  }

  /** @param aspect Width over height of the film. */
  draw(
    environment: Environment | undefined,
    degrees: number,
    camera: Camera,
    aspect: number,
    view: ToneMapOptions,
  ): void {
    const [width, height] =
      aspect > 1
        ? [LONGER_SIDE, Math.max(1, Math.round(LONGER_SIDE / aspect))]
        : [Math.max(1, Math.round(LONGER_SIDE * aspect)), LONGER_SIDE];
    const pixels = new Float32Array(width * height * 4).fill(1);
    if (environment?.type === 'latlong')
      this.#project(this.#blur(environment, degrees), environment, camera, width, height, pixels);
    else for (let i = 0; i < pixels.length; i += 4) pixels.set(environment?.radiance ?? [0, 0, 0], i);
    this.#canvas.width = width;
    this.#canvas.height = height;
    this.#canvas.hidden = false;
    this.#canvas
      .getContext('2d')
      ?.putImageData(
        new ImageData(toneMapPixels(pixels, width, height, { ...view, alpha: 'opaque' }), width, height),
        0,
        0,
      );
  }

  #blur(environment: LatLongEnvironment, degrees: number): LatLongEnvironment {
    if (this.#blurred?.data !== environment.data || this.#blurred.degrees !== degrees)
      this.#blurred = { data: environment.data, degrees, environment: blurEnvironment(environment, degrees) };
    return this.#blurred.environment;
  }

  #project(
    blurred: LatLongEnvironment,
    { intensity = 1, rotation = 0 }: LatLongEnvironment,
    camera: Camera,
    width: number,
    height: number,
    pixels: Float32Array,
  ): void {
    const m = camera.transform;
    const axis = (k: number) => {
      const [x, y, z] = [m[4 * k] as number, m[4 * k + 1] as number, m[4 * k + 2] as number];
      const length = Math.hypot(x, y, z) || 1;
      return [x / length, y / length, z / length] as const;
    };
    const [right, up, back] = [axis(0), axis(1), axis(2)];
    const tangent = camera.type === 'perspective' ? Math.tan(camera.yfov / 2) : 0;
    const [cos, sin] = [Math.cos(-rotation), Math.sin(-rotation)];
    for (let j = 0; j < height; j++) {
      for (let i = 0; i < width; i++) {
        const a = ((2 * (i + 0.5)) / width - 1) * tangent * (width / height);
        const b = (1 - (2 * (j + 0.5)) / height) * tangent;
        const d = [0, 1, 2].map((k) => right[k]! * a + up[k]! * b - back[k]!) as [number, number, number];
        const length = Math.hypot(...d);
        const [x, y, z] = [d[0] / length, d[1] / length, d[2] / length];
        const at = 4 * (j * width + i);
        // R_y(−rotation) takes a direction into the frame of the image.
        look(blurred, cos * x + sin * z, y, -sin * x + cos * z, pixels, at);
        for (let k = 0; k < 3; k++) pixels[at + k]! *= intensity;
      }
    }
  }
}
