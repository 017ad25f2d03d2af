/** A perspective camera with an optional thin lens. */
export interface PerspectiveCamera {
  type: 'perspective';
  name: string;
  /** Camera to world, 16 finite numbers, column-major; scale is ignored. At most 1e12 m away from the origin. */
  transform: ArrayLike<number>;
  /** Vertical field of view, radians, in (0, π). */
  yfov: number;
  /** Width over height that the author intended; a film of another shape keeps the vertical field of view. Above 0. */
  aspect?: number;
  /** Radius of the thin lens, metres, 0 to 1e12; default 0, a pinhole. */
  lens_radius?: number;
  /** Sides of the aperture, a regular polygon with its corners on the lens's edge; below 3 (default 0) it is round. */
  lens_blades?: number;
  /**
   * Rotates the aperture's polygon, radians, counter-clockwise as the camera sees it; at 0 a corner points right.
   */
  lens_rotation?: number;
  /** Distance of the plane in focus along the axis, metres, above 0; default 1. Only matters with a lens. */
  focus_distance?: number;
}

/** Parallel projection. */
export interface OrthographicCamera {
  type: 'orthographic';
  name: string;
  transform: ArrayLike<number>;
  /** Half the width of the view, metres, above 0 and at most 1e12. */
  xmag: number;
  /** Half the height of the view, metres, above 0 and at most 1e12. */
  ymag: number;
}

/**
 * The whole sphere around a point as a latitude-longitude image, which should be twice as wide as high: −Z in the
 * middle, +Y at the top, azimuth growing to the right. Rotated so that its −Z lies along the world's +X, its images
 * serve as a `LatLongEnvironment` without rotation.
 */
export interface PanoramaCamera {
  type: 'panorama';
  name: string;
  transform: ArrayLike<number>;
}

/** A camera of any type. All look along their local −Z, with +Y up. */
export type Camera = PerspectiveCamera | OrthographicCamera | PanoramaCamera;
