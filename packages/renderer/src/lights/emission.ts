import type { Image, Scene, Texture, TextureBinding } from '@glanz/scene';

const srgbToLinear = (c: number) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

/** Mean luminance of an emission texture over triangles, to weigh them as lights. The weights only steer sampling. */
export class EmissionEstimate {
  readonly #image: Image;
  readonly #texture: Texture;
  readonly #binding: TextureBinding;
  readonly #decode: Float32Array;

  constructor(scene: Scene, binding: TextureBinding) {
    this.#binding = binding;
    this.#texture = scene.textures[binding.texture] as Texture;
    this.#image = scene.images[this.#texture.image] as Image;
    const curve = this.#texture.color_space === 'srgb' ? srgbToLinear : (c: number) => c;
    this.#decode = Float32Array.from({ length: 256 }, (_, code) => curve(code / 255));
  }

  /**
   * Mean over a triangle given by its uvs, from a grid of texels as fine as the triangle is large on the image, up to
   * 16 × 16.
   */
  mean(uv: readonly [number, number, number, number, number, number]): number {
    const [a, b, c, d] = this.#binding.transform ?? [1, 0, 0, 1, 0, 0];
    const area =
      Math.abs((uv[2] - uv[0]) * (uv[5] - uv[1]) - (uv[3] - uv[1]) * (uv[4] - uv[0])) * Math.abs(a * d - b * c);
    const n = Math.min(16, Math.max(2, Math.ceil(Math.sqrt(area * this.#image.width * this.#image.height) / 4)));
    let sum = 0;
    let count = 0;
    for (let i = 0; i < n; i++) {
      for (let j = 0; j < n - i; j++) {
        const s = (i + 1 / 3) / n;
        const t = (j + 1 / 3) / n;
        sum += this.#luminance(
          uv[0] + s * (uv[2] - uv[0]) + t * (uv[4] - uv[0]),
          uv[1] + s * (uv[3] - uv[1]) + t * (uv[5] - uv[1]),
        );
        count++;
      }
    }
    return sum / count;
  }

  #luminance(u: number, v: number): number {
    const [a, b, c, d, x, y] = this.#binding.transform ?? [1, 0, 0, 1, 0, 0];
    const { width, height, data } = this.#image;
    const px = Math.floor(wrap(a * u + c * v + x, this.#texture.wrap_u) * width);
    const py = Math.floor(wrap(b * u + d * v + y, this.#texture.wrap_v) * height);
    const at = 4 * (Math.min(py, height - 1) * width + Math.min(px, width - 1));
    const value = (k: number) =>
      data instanceof Float32Array ? (data[at + k] as number) : (this.#decode[data[at + k] as number] as number);
    return 0.2126 * value(0) + 0.7152 * value(1) + 0.0722 * value(2);
  }
}

function wrap(x: number, mode: Texture['wrap_u']): number {
  if (!Number.isFinite(x)) return 0;
  if (mode === 'clamp') return Math.min(Math.max(x, 0), 1);
  if (mode === 'mirror') {
    const t = x - 2 * Math.floor(x / 2);
    return t <= 1 ? t : 2 - t;
  }
  return x - Math.floor(x);
}
