/** A perspective camera with an optional thin lens. Looks along its local −Z, +Y up. */
export interface PerspectiveCamera {
  type: 'perspective';
  name: string;
  /** Camera to world, 16 numbers, column-major; scale is ignored. */
  transform: ArrayLike<number>;
  /** Vertical field of view, radians, in (0, π). */
  yfov: number;
  /** Width over height the author had in mind; a film of another shape keeps the vertical field of view. */
  aspect?: number;
  /** Radius of the thin lens, metres; default 0, a pinhole. */
  lens_radius?: number;
  /** Distance of the plane in focus along the axis, metres; default 1. Only matters with a lens. */
  focus_distance?: number;
}

/** Parallel projection. */
export interface OrthographicCamera {
  type: 'orthographic';
  name: string;
  transform: ArrayLike<number>;
  /** Half the width of the view, metres. */
  xmag: number;
  /** Half the height of the view, metres. */
  ymag: number;
}

/** What a scene is looked at through. Both look along their local −Z, +Y up. */
export type Camera = PerspectiveCamera | OrthographicCamera;
