import { Camera, PerspectiveCamera, RectAreaLight, SpotLight, type Texture } from 'three';

/** A perspective camera with a lens, for depth of field. */
export class PhysicalCamera extends PerspectiveCamera {
  /** Focal length over the diameter of the aperture, above 0. Default 1.4. */
  fStop = 1.4;
  /** Corners of the aperture; 0 (default) is round. */
  apertureBlades = 0;
  /** Rotates the aperture, radians. Default 0. */
  apertureRotation = 0;
  /** Distance of what is sharp, in the scene's units, along the axis. Default 25. */
  focusDistance = 25;
  /** Width over height of the aperture. Default 1; others are not supported and draw a warning. */
  anamorphicRatio = 1;

  /** Diameter of the aperture in millimetres: the focal length over {@link fStop}. */
  get bokehSize(): number {
    return this.getFocalLength() / this.fStop;
  }

  set bokehSize(size: number) {
    this.fStop = this.getFocalLength() / size;
  }

  override copy(source: this, recursive?: boolean): this {
    super.copy(source, recursive);
    const { fStop, apertureBlades, apertureRotation, focusDistance, anamorphicRatio } = source;
    return Object.assign(this, { fStop, apertureBlades, apertureRotation, focusDistance, anamorphicRatio });
  }
}

/** A camera that sees the whole sphere around it, as an equirectangular image. three's own renderers cannot use it. */
export class EquirectCamera extends Camera {
  readonly isEquirectCamera = true;
}

/** A spot light as three-gpu-pathtracer has it. Its `radius` and `iesMap` are not supported and draw a warning. */
export class PhysicalSpotLight extends SpotLight {
  /** Radius of the luminous disk. Default 0, a point, which is what is rendered. */
  radius = 0;
  /** Measured intensities, not supported: a `ProfileLight` of a Glanz scene has them. Default `null`. */
  iesMap: Texture | null = null;

  override copy(source: this, recursive?: boolean): this {
    super.copy(source, recursive);
    return Object.assign(this, { radius: source.radius, iesMap: source.iesMap });
  }
}

/** A rectangular light, or with {@link isCircular} a disk of the diameter √(width × height). */
export class ShapedAreaLight extends RectAreaLight {
  /** Default false. */
  isCircular = false;

  override copy(source: this): this {
    super.copy(source);
    this.isCircular = source.isCircular;
    return this;
  }
}
