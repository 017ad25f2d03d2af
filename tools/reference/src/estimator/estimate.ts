import type { Scene } from '@glanz/scene';
import { ReferenceError } from '../error';
import { matterOf, type Matter } from './matter';
import { along, cauchyIndex, dot, drawWavelength, paneReflectance, smoothInterface, unit, type Vec3 } from './optics';
import { nearestHit, trianglesOf } from './triangles';

/** Options for {@link estimate}. */
export interface EstimateOptions {
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  /** Samples per pixel, at least 2. */
  readonly samples: number;
  /** Maximum number of edges of a path from the camera to a light, counted as `PathTracerOptions.maxDepth` does. */
  readonly maxDepth: number;
  /** A whole number, 0 to 4,294,967,295. */
  readonly seed: number;
  /** Called after each row of pixels, with the number of rows that are done. */
  readonly onRow?: (rows: number) => unknown;
}

/** An image with its noise. RGB, stride 3, linear, top row first. */
export interface Estimate {
  readonly mean: Float64Array;
  /** Standard error of each value of `mean`. */
  readonly standardError: Float64Array;
}

/** Uniform numbers in [0, 1): Doty-Humphrey's generator sfc32. */
export function uniforms(seed: number): () => number {
  let [a, b, c, d] = [seed | 0, 0x9e3779b9 | 0, 0x243f6a88 | 0, 1];
  const next = () => {
    const t = (((a + b) | 0) + d) | 0;
    d = (d + 1) | 0;
    a = b ^ (b >>> 9);
    b = (c + (c << 3)) | 0;
    c = (c << 21) | (c >>> 11);
    c = (c + t) | 0;
    return (t >>> 0) / 2 ** 32;
  };
  for (let i = 0; i < 16; i++) next();
  return next;
}

/** Throughputs below this end paths by roulette. */
const FAINT = 0.05;

type Clear = Extract<Matter, { kind: 'clear' }>;

/** The interior that counts: of the highest priority, the last entered among equals. */
function inner(interiors: readonly Clear[]): Clear | undefined {
  let top: Clear | undefined;
  for (const one of interiors) if (!top || one.priority >= top.priority) top = one;
  return top;
}

/** A direction around a normal by the cosine. */
function matt(normal: Vec3, u: number, v: number): Vec3 {
  // A uniform point on the unit sphere around the tip of the normal.
  const z = 1 - 2 * u;
  const r = Math.sqrt(Math.max(0, 1 - z * z));
  return unit(along([r * Math.cos(2 * Math.PI * v), r * Math.sin(2 * Math.PI * v), z], 1, normal));
}

/**
 * Estimates an image by brute force: paths from the camera that find lights by chance alone. No light sampling, no
 * multiple importance sampling, one random choice at each interface; rays in double precision against triangles. It has
 * no code in common with the renderer and its packages, which makes its images references for scenes of smooth glass.
 *
 * It knows: a perspective camera with a pinhole and the box filter; matt surfaces and emitters; smooth glass, solid, one
 * in another by `dielectric_priority`, with absorption and dispersion, or thin-walled; a constant environment.
 *
 * @throws {ReferenceError} `reference/unsupported` for any other scene.
 */
export function estimate(scene: Scene, options: EstimateOptions): Estimate {
  const { width, height, samples, seed, onRow } = options;
  const random = uniforms(seed);
  const ray = cameraRays(scene, width / height);
  const trace = paths(scene, options.maxDepth, random);
  const mean = new Float64Array(3 * width * height);
  const standardError = new Float64Array(3 * width * height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const at = 3 * (y * width + x);
      // Welford's running means and sums of squares.
      for (let i = 1; i <= samples; i++) {
        const value = trace(...ray((x + random()) / width, (y + random()) / height));
        for (let k = 0; k < 3; k++) {
          const away = value[k]! - mean[at + k]!;
          mean[at + k]! += away / i;
          standardError[at + k]! += away * (value[k]! - mean[at + k]!);
        }
      }
      for (let k = at; k < at + 3; k++) standardError[k] = Math.sqrt(standardError[k]! / (samples - 1) / samples);
    }
    onRow?.(y + 1);
  }
  return { mean, standardError };
}

/** Rays of the scene's first camera through places in the image, 0..1 from its upper left corner. */
function cameraRays({ cameras: [camera] }: Scene, aspect: number): (u: number, v: number) => [Vec3, Vec3] {
  if (camera?.type !== 'perspective' || camera.lens_radius)
    throw new ReferenceError('reference/unsupported', 'The estimator needs a perspective camera without a lens.');
  const { transform: m, yfov } = camera;
  const column = (k: number): Vec3 => [m[4 * k]!, m[4 * k + 1]!, m[4 * k + 2]!];
  const [right, up, back, position] = [unit(column(0)), unit(column(1)), unit(column(2)), column(3)];
  const half = Math.tan(yfov / 2);
  return (u, v) => {
    const across = along(along([0, 0, 0], (2 * u - 1) * half * aspect, right), (1 - 2 * v) * half, up);
    return [position, unit(along(across, -1, back))];
  };
}

/** Paths through a scene: the radiance that one sample finds along a ray from outside of all interiors. */
function paths(
  scene: Scene,
  maxDepth: number,
  random: () => number,
): (start: Vec3, towards: Vec3) => [number, number, number] {
  const { environment } = scene;
  if ((environment && environment.type !== 'constant') || scene.lights.length > 0)
    throw new ReferenceError('reference/unsupported', 'The estimator knows no lights but emitters and even skies.');
  const sky: Vec3 = environment?.radiance ?? [0, 0, 0];
  const matters = scene.materials.map(matterOf);
  const triangles = trianglesOf(scene);
  const nearest = nearestHit(triangles);

  return (start, towards) => {
    let [origin, direction, from] = [start, towards, -1];
    const carried: [number, number, number] = [1, 1, 1];
    const found = (radiance: Vec3): [number, number, number] => [
      carried[0] * radiance[0],
      carried[1] * radiance[1],
      carried[2] * radiance[2],
    ];
    const tint = (factor: (k: 0 | 1 | 2) => number): void => {
      carried[0] *= factor(0);
      carried[1] *= factor(1);
      carried[2] *= factor(2);
    };
    let interiors: readonly Clear[] = [];
    let wavelength = 0;
    const indexOf = (matter: Clear | undefined): number => {
      if (!matter) return 1;
      if (matter.abbe === Infinity) return matter.index;
      if (wavelength === 0) {
        const drawn = drawWavelength(random());
        wavelength = drawn.wavelength;
        tint((k) => drawn.weight[k]);
      }
      return cauchyIndex(matter.index, matter.abbe, wavelength);
    };

    for (let edges = 1; ;) {
      const hit = nearest(origin, direction, from);
      if (!hit) return found(sky);
      const around = inner(interiors);
      if (around) tint((k) => Math.exp(-around.absorption[k] * hit.distance));
      const { normal: front, material } = triangles[hit.triangle]!;
      const matter = matters[material]!;
      const outside = dot(front, direction) < 0;
      const normal = outside ? front : along([0, 0, 0], -1, front);
      const cosine = Math.min(1, -dot(normal, direction));
      origin = along(origin, hit.distance, direction);
      from = hit.triangle;

      if (matter.kind === 'emitter') return outside ? found(matter.radiance) : [0, 0, 0];
      // Whether the path goes on straight, which is no edge.
      let straight = false;
      let next = direction;
      if (matter.kind === 'matt') {
        tint((k) => matter.albedo[k]);
        next = matt(normal, random(), random());
      } else if (matter.kind === 'pane') {
        if (around) throw new ReferenceError('reference/unsupported', 'The estimator has panes in air alone.');
        const face = smoothInterface(1, matter.index, cosine);
        straight = random() >= paneReflectance(face.reflectance);
        if (straight) tint((k) => matter.color[k] ** (1 / face.cosine));
        else next = along(direction, 2 * cosine, normal);
      } else {
        const beyond = outside ? [...interiors, matter] : interiors.filter((one) => one !== matter);
        const behind = inner(beyond);
        straight = behind === around;
        if (!straight) {
          const [n1, n2] = [indexOf(around), indexOf(behind)];
          const { reflectance, cosine: refracted } = smoothInterface(n1, n2, cosine);
          if (random() < reflectance) {
            next = along(direction, 2 * cosine, normal);
          } else {
            // Snell: the part along the surface shrinks by n1 / n2.
            next = unit(along(along([0, 0, 0], n1 / n2, along(direction, cosine, normal)), -refracted, normal));
            interiors = beyond;
          }
        } else {
          interiors = beyond;
        }
      }
      direction = next;
      if (straight) continue;
      if (++edges > maxDepth) return [0, 0, 0];
      const brightest = Math.max(...carried);
      if (brightest < FAINT) {
        if (random() * FAINT >= brightest) return [0, 0, 0];
        tint(() => FAINT / brightest);
      }
    }
  };
}
