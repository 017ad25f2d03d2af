import type { LatLongEnvironment } from './environment';
import { finish } from './slices';
import { STUDIOS, type Rgb, type SoftBox, type StudioSetup } from './studios';

export { STUDIOS, type SoftBox, type StudioName, type StudioSetup } from './studios';

/** Options for {@link studioEnvironment}. */
export interface StudioOptions {
  /** Walls and lights: one of `STUDIOS`, or your own. Default: the neutral studio. */
  readonly setup?: StudioSetup;
  /** Width of the image, pixels; the height is half of it. A multiple of 2, at least 16. Default 512. */
  readonly width?: number;
  /** Multiplies the radiance; default 1. */
  readonly intensity?: number;
  /** Rotates the studio about +Y, radians, as `LatLongEnvironment.rotation`. Default 0. */
  readonly rotation?: number;
  /** Whether the camera sees it; default true. */
  readonly visible?: boolean;
}

type Vector = readonly [number, number, number];

/** Rows computed between two yields. */
const ROWS = 8;

const smooth = (low: number, high: number, x: number) => {
  const t = Math.min(Math.max((x - low) / (high - low), 0), 1);
  return t * t * (3 - 2 * t);
};

const grey = (value: number | Rgb): Rgb => (typeof value === 'number' ? [value, value, value] : value);

interface Placed {
  readonly box: SoftBox;
  /** Half extents, as tangents of the half angles. */
  readonly half: readonly [number, number];
  readonly radiance: Rgb;
  readonly normal: Vector;
  readonly right: Vector;
  readonly up: Vector;
}

function place(box: SoftBox): Placed {
  const { azimuth: a, elevation: e } = box;
  return {
    box,
    half: [Math.tan(box.width / 2), Math.tan(box.height / 2)],
    radiance: grey(box.radiance),
    normal: [Math.sin(a) * Math.cos(e), Math.sin(e), Math.cos(a) * Math.cos(e)],
    right: [Math.cos(a), 0, -Math.sin(a)],
    up: [-Math.sin(a) * Math.sin(e), Math.cos(e), -Math.cos(a) * Math.sin(e)],
  };
}

const dot = (a: Vector, b: Vector) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/**
 * Fraction of a box's radiance in direction d. The edge is smoothed over `blur`, so that no texel edge shows in
 * reflections.
 */
function boxFalloff({ box, half, normal, right, up }: Placed, d: Vector, blur: number): number {
  const depth = dot(d, normal);
  if (depth <= 0.05) return 0;
  const u = Math.abs(dot(d, right)) / depth / half[0];
  const v = Math.abs(dot(d, up)) / depth / half[1];
  const edge = (x: number, size: number) => 1 - smooth(1 - blur / size, 1 + blur / size, x);
  const falloff = 1 - 0.25 * Math.min(u * u + v * v, 1);
  if (box.shape === 'disc') return edge(Math.hypot(u, v), Math.min(...half)) * falloff;
  if (u > 1 + blur / half[0] || v > 1 + blur / half[1]) return 0;
  return edge(u, half[0]) * edge(v, half[1]) * falloff;
}

/**
 * A photo studio as a computed environment. The default is neutral: grey walls and five soft boxes, colourless; a white
 * diffuse surface facing up or forward renders near 1, so exposure 0 suits most models. Front is +Z, as in glTF.
 *
 * @example
 * if (!scene.environment) scene.environment = studioEnvironment();
 * scene.environment = studioEnvironment({ setup: STUDIOS['low-key'], rotation: 0.5 });
 */
export function studioEnvironment(options: StudioOptions = {}): LatLongEnvironment {
  return finish(studioSteps(options));
}

/** The same as {@link studioEnvironment} in steps of a millisecond or so, for `inSlices` of `@glanz/scene`. */
export function* studioSteps(options: StudioOptions = {}): Generator<void, LatLongEnvironment> {
  const width = Math.max(16, Math.round((options.width ?? 512) / 2) * 2);
  const height = width / 2;
  const { backdrop, boxes } = options.setup ?? STUDIOS.neutral;
  const placed = boxes.map(place);
  const blur = Math.max(0.03, (2 * Math.PI) / width);
  const data = new Float32Array(width * height * 3);
  for (let j = 0; j < height; j++) {
    const theta = ((j + 0.5) / height) * Math.PI;
    const sin = Math.sin(theta);
    const y = Math.cos(theta);
    const up = y >= 0;
    const share = up ? smooth(0, 0.9, y) : smooth(0, 1, -y);
    const wall = backdrop.horizon.map(
      (low, k) => low + ((up ? backdrop.zenith : backdrop.nadir)[k]! - low) * share,
    ) as [number, number, number];
    for (let i = 0; i < width; i++) {
      // u = atan2(z, x)/2π + ½: see LatLongEnvironment.
      const phi = ((i + 0.5) / width - 0.5) * 2 * Math.PI;
      const d: Vector = [sin * Math.cos(phi), y, sin * Math.sin(phi)];
      let [r, g, b] = wall;
      for (const light of placed) {
        const lit = boxFalloff(light, d, blur);
        if (lit === 0) continue;
        r += light.radiance[0] * lit;
        g += light.radiance[1] * lit;
        b += light.radiance[2] * lit;
      }
      const at = (j * width + i) * 3;
      data[at] = r;
      data[at + 1] = g;
      data[at + 2] = b;
    }
    if (j % ROWS === 0) yield;
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
