import {
  Color,
  DataTexture,
  EquirectangularReflectionMapping,
  FloatType,
  LinearFilter,
  RGBAFormat,
  RepeatWrapping,
  Spherical,
  Vector2,
  Vector3,
  type Texture,
} from 'three';

/** An equirectangular image that a function of the direction fills. */
export class ProceduralEquirectTexture extends DataTexture {
  /**
   * Sets the colour of a texel. Assign a function and call {@link update}.
   *
   * @param polar Its direction, with a radius of 1.
   * @param uv Its centre, 0..1, from the lower left corner.
   * @param coord Column and row.
   * @param color Linear; to be set.
   */
  generationCallback: (polar: Spherical, uv: Vector2, coord: Vector2, color: Color) => void = (_, __, ___, color) =>
    void color.set(0);

  /** @param width Texels, default 512. @param height Texels, default 512. */
  constructor(width = 512, height = 512) {
    super(new Float32Array(width * height * 4), width, height, RGBAFormat, FloatType, EquirectangularReflectionMapping);
    this.wrapS = RepeatWrapping;
    this.minFilter = this.magFilter = LinearFilter;
  }

  /** Calls {@link generationCallback} for each texel. */
  update(): void {
    const { width, height } = this.image;
    const data = this.image.data as Float32Array;
    const [polar, uv, coord, color, direction] = [
      new Spherical(),
      new Vector2(),
      new Vector2(),
      new Color(),
      new Vector3(),
    ];
    for (let y = 0; y < height; y++)
      for (let x = 0; x < width; x++) {
        uv.set((x + 0.5) / width, (y + 0.5) / height);
        const [azimuth, elevation] = [(uv.x - 0.5) * 2 * Math.PI, (uv.y - 0.5) * Math.PI];
        const flat = Math.cos(elevation);
        direction.set(flat * Math.cos(azimuth), Math.sin(elevation), flat * Math.sin(azimuth));
        this.generationCallback(polar.setFromVector3(direction), uv, coord.set(x, y), color);
        data.set([color.r, color.g, color.b, 1], 4 * (y * width + x));
      }
    this.needsUpdate = true;
  }
}

/** An environment that fades from one colour below to another above. */
export class GradientEquirectTexture extends ProceduralEquirectTexture {
  /** Linear. Default white. */
  topColor = new Color(0xffffff);
  /** Linear. Default black. */
  bottomColor = new Color(0x000000);
  /** Above 1 the lower colour takes more of the sphere. Default 2. */
  exponent = 2;

  /** @param resolution Width and height in texels, default 512. Call {@link update} afterwards. */
  constructor(resolution = 512) {
    super(resolution, resolution);
    this.generationCallback = ({ phi }, _, __, color) =>
      void color.lerpColors(this.bottomColor, this.topColor, (Math.cos(phi) * 0.5 + 0.5) ** this.exponent);
  }
}

/**
 * Replaces the class that blurs environments to reduce noise. Here environments are importance-sampled, so blurring is
 * not needed: {@link generate} returns an unblurred copy.
 */
export class BlurredEnvMapGenerator {
  /** @param renderer Not used. */
  constructor(renderer?: unknown) {
    void renderer;
  }

  /** @returns A copy that shares the image; the caller disposes of it. The blur is ignored. */
  generate<T extends Texture>(texture: T, blur?: number): T {
    void blur;
    const copy = texture.clone();
    copy.needsUpdate = true;
    return copy;
  }

  /** Does nothing. */
  dispose(): void {
    return;
  }
}
