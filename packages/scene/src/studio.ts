import type { LatLongEnvironment } from './environment';

/** What {@link studioEnvironment} may be told. */
export interface StudioOptions {
  /** Pixels around; the height is half of it. A multiple of 2, at least 16. Default 512. */
  readonly width?: number;
  /** Multiplies the radiance; default 1. */
  readonly intensity?: number;
  /** Turns the studio about +Y, radians, as `LatLongEnvironment.rotation`. Default 0. */
  readonly rotation?: number;
  /** Whether the camera sees it; default true. */
  readonly visible?: boolean;
}

type Vector = readonly [number, number, number];

/** A soft box: a rectangle at distance 1 that faces the subject. */
interface SoftBox {
  /** Where it hangs: azimuth from +Z (the front) towards +X, and height above the horizon, degrees. */
  readonly azimuth: number;
  readonly elevation: number;
  /** Half extents, as tangents of the angles they span. */
  readonly halfWidth: number;
  readonly halfHeight: number;
  /** Radiance in the middle; it falls off a little towards the edges, as a real one does. */
  readonly radiance: number;
}

// A product photographer's set for a subject that faces +Z, seen from the front right: the key from the front left, a
// wide weak fill on the right, a large box overhead, and two strips behind that draw the edges. The strips hang high
// enough to stay out of a camera that looks slightly down.
const BOXES: readonly SoftBox[] = [
  { azimuth: -50, elevation: 38, halfWidth: 0.42, halfHeight: 0.5, radiance: 4.6 },
  { azimuth: 65, elevation: 22, halfWidth: 0.55, halfHeight: 0.5, radiance: 0.9 },
  { azimuth: 0, elevation: 88, halfWidth: 0.7, halfHeight: 0.5, radiance: 0.5 },
  { azimuth: 150, elevation: 42, halfWidth: 0.14, halfHeight: 0.5, radiance: 3 },
  { azimuth: -145, elevation: 42, halfWidth: 0.14, halfHeight: 0.5, radiance: 2.4 },
];

const smooth = (low: number, high: number, x: number) => {
  const t = Math.min(Math.max((x - low) / (high - low), 0), 1);
  return t * t * (3 - 2 * t);
};

/** The walls: a grey sweep, light at the horizon, a little darker above and towards the floor. */
function backdrop(y: number): number {
  return y >= 0 ? 0.5 - 0.25 * smooth(0, 0.9, y) : 0.5 - 0.2 * smooth(0, 1, -y);
}

interface Placed extends SoftBox {
  readonly normal: Vector;
  readonly right: Vector;
  readonly up: Vector;
}

function place(box: SoftBox): Placed {
  const a = (box.azimuth * Math.PI) / 180;
  const e = (box.elevation * Math.PI) / 180;
  return {
    ...box,
    normal: [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)],
    right: [Math.cos(a), 0, -Math.sin(a)],
    up: [-Math.sin(a) * Math.sin(e), Math.cos(e), -Math.cos(a) * Math.sin(e)],
  };
}

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Radiance of a box in direction d; the edge is smoothed over `blur`, so that no texel edge shows in reflections. */
function boxRadiance(box: Placed, d: Vector, blur: number): number {
  const depth = dot(d, box.normal);
  if (depth <= 0.05) return 0;
  const u = Math.abs(dot(d, box.right)) / depth / box.halfWidth;
  const v = Math.abs(dot(d, box.up)) / depth / box.halfHeight;
  if (u > 1 + blur / box.halfWidth || v > 1 + blur / box.halfHeight) return 0;
  const edge = (x: number, half: number) => 1 - smooth(1 - blur / half, 1 + blur / half, x);
  return box.radiance * edge(u, box.halfWidth) * edge(v, box.halfHeight) * (1 - 0.25 * Math.min(u * u + v * v, 1));
}

/**
 * A neutral photo studio as surroundings: grey walls and five soft boxes, colourless, made on the spot. A white diffuse
 * surface facing up or forward comes out near 1, so exposure 0 suits most models. Front is +Z, as in glTF.
 *
 * @example
 * if (!scene.environment) scene.environment = studioEnvironment();
 */
export function studioEnvironment(options: StudioOptions = {}): LatLongEnvironment {
  const width = Math.max(16, Math.round((options.width ?? 512) / 2) * 2);
  const height = width / 2;
  const boxes = BOXES.map(place);
  const blur = Math.max(0.03, (2 * Math.PI) / width);
  const data = new Float32Array(width * height * 3);
  for (let j = 0; j < height; j++) {
    const theta = ((j + 0.5) / height) * Math.PI;
    const sin = Math.sin(theta);
    const y = Math.cos(theta);
    for (let i = 0; i < width; i++) {
      // u = atan2(z, x)/2π + ½: see LatLongEnvironment.
      const phi = ((i + 0.5) / width - 0.5) * 2 * Math.PI;
      const d: Vector = [sin * Math.cos(phi), y, sin * Math.sin(phi)];
      let radiance = backdrop(y);
      for (const box of boxes) radiance += boxRadiance(box, d, blur);
      data.fill(radiance, (j * width + i) * 3, (j * width + i) * 3 + 3);
    }
  }
  return {
    type: 'latlong',
    width,
    height,
    data,
    ...(options.intensity === undefined ? {} : { intensity: options.intensity }),
    ...(options.rotation === undefined ? {} : { rotation: options.rotation }),
    ...(options.visible === undefined ? {} : { visible: options.visible }),
  };
}
