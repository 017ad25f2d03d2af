import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { decodeExr, decodeHdr, type ExrImage } from '@glanz/image';
import { loadGltfFile, type GltfOptions } from '@glanz/gltf/node';
import type { Environment, Material, Scene } from '@glanz/scene';
import { lookAt } from './camera';
import { ReferenceError } from './error';

type Vector = readonly [number, number, number];

/** `scene.json` of a ground-truth scene, as far as it is used. */
export interface SceneDescription {
  readonly name: string;
  readonly title: string;
  readonly camera: {
    readonly position: Vector;
    readonly target: Vector;
    readonly up: Vector;
    readonly yfov_deg: number;
    readonly lens_radius: number;
    readonly focus_distance: number;
  };
  readonly film: { readonly width: number; readonly height: number };
  readonly environment:
    | { readonly type: 'none' }
    | { readonly type: 'constant'; readonly radiance: Vector }
    | { readonly type: 'latlong'; readonly file: string; readonly rotation_y_deg: number; readonly scale: number };
  readonly variants: readonly { readonly id: string; readonly max_path_edges: number }[];
}

/** How far from its reference an image may lie. */
export interface Tolerance {
  /** Relative error of the image's mean. */
  readonly mean: number;
  /** Relative error of a 16 × 16 block. */
  readonly block: number;
  /** Error per sample, in multiples of the reference renderer's. */
  readonly k: number;
  readonly floor: number;
  /** Share of outlier pixels. */
  readonly outlier: number;
}

/** A reference image. */
export interface ReferenceImage {
  /** RGB, stride 3, linear, top row first. */
  readonly mean: Float32Array;
  /** Standard error of each value of `mean`. */
  readonly standardError: Float32Array;
  /** Samples per pixel behind it, and figures of the renderer that made it. */
  readonly stats: {
    readonly spp: number;
    readonly relmse_eps: number;
    readonly relmse_1spp: number;
    readonly relmse_of_reference: number;
  };
}

const OWN = 'tools/reference/scenes';

/**
 * The folder of the reference set: the one that `GLANZ_GROUNDTRUTH` names, or `tools/reference/scenes`; `undefined` where
 * neither is found, such as in a bundle outside of the repository.
 */
export function referenceFolder(): string | undefined {
  const named = process.env['GLANZ_GROUNDTRUTH'];
  if (named) return existsSync(join(named, 'tolerances.json')) ? named : undefined;
  // Looked for upwards, since a bundle lies elsewhere than this source.
  for (let folder = dirname(fileURLToPath(import.meta.url)); ; folder = dirname(folder)) {
    const candidate = join(folder, OWN);
    if (existsSync(join(candidate, 'tolerances.json'))) return candidate;
    if (folder === dirname(folder)) return undefined;
  }
}

const json = <T>(file: string) => JSON.parse(readFileSync(file, 'utf8')) as T;

/** Channels of an EXR as RGB, stride 3. */
function rgbOf({ width, height, channels }: ExrImage, file: string, layer: string): Float32Array {
  const values = ['R', 'G', 'B'].map((name) => {
    const data = channels.get(`${layer}${name}`)?.data;
    if (!data) throw new ReferenceError('reference/channels', `${file} has no channel ${layer}${name}.`);
    return data;
  });
  return Float32Array.from({ length: 3 * width * height }, (_, i) => values[i % 3]![Math.floor(i / 3)]!);
}

function floats(file: string): Float32Array {
  const bytes = readFileSync(file);
  return new Float32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
}

/** What the reference set says about a material beyond glTF. */
interface GroundTruthExtras {
  readonly gt?: {
    readonly f82_tint?: Vector;
    readonly medium?: { readonly sigma_t: Vector; readonly albedo: Vector; readonly g: number };
  };
}

/** glTF has no way to say F82 tint or a scattering medium: the reference set puts them into the extras. */
function applyExtras(material: Material): Material {
  const { f82_tint, medium } = (material.extras as GroundTruthExtras | undefined)?.gt ?? {};
  const parameters = { ...material.parameters };
  if (f82_tint) parameters.specular_color = f82_tint;
  if (medium) {
    // Extinction is what makes white this colour at this depth: a shallow one, so that scattering stays below 1.
    const depth = 0.1;
    const per = (value: (k: 0 | 1 | 2) => number): Vector => [value(0), value(1), value(2)];
    parameters.transmission_depth = depth;
    parameters.transmission_color = per((k) => Math.exp(-medium.sigma_t[k] * depth));
    parameters.transmission_scatter = per((k) => medium.sigma_t[k] * medium.albedo[k] * depth);
    parameters.transmission_scatter_anisotropy = medium.g;
  }
  return { ...material, parameters };
}

/** One scene of the reference set. */
export class GroundTruth {
  readonly folder: string;
  readonly description: SceneDescription;
  readonly tolerance: Tolerance;

  readonly #loading: GltfOptions;

  /**
   * @param loading How its images are decoded, where it is read.
   * @throws {ReferenceError} `reference/absent` without the reference set, `reference/unknown-scene`
   */
  constructor(name: string, loading: GltfOptions = {}) {
    this.#loading = loading;
    const scenes = referenceFolder();
    if (!scenes)
      throw new ReferenceError(
        'reference/absent',
        'The reference set is not here: set GLANZ_GROUNDTRUTH to its folder "scenes".',
      );
    this.folder = join(scenes, name);
    if (!existsSync(join(this.folder, 'scene.json')))
      throw new ReferenceError('reference/unknown-scene', `The reference set has no scene "${name}".`);
    this.description = json(join(this.folder, 'scene.json'));
    this.tolerance = json<Record<string, Tolerance>>(join(scenes, 'tolerances.json'))[name] as Tolerance;
  }

  /** Most path edges of a variant. */
  maxDepth(variant = 'full'): number {
    const found = this.description.variants.find(({ id }) => id === variant);
    if (!found)
      throw new ReferenceError(
        'reference/unknown-variant',
        `Ground-truth scene "${this.description.name}" has no variant "${variant}"; it has: ${this.description.variants.map(({ id }) => id).join(', ')}.`,
      );
    return found.max_path_edges;
  }

  /**
   * The reference image of a variant: an EXR with the channels R, G, B and `standard_error.R`, …, or, in reference sets
   * with full precision, float32 files for both.
   *
   * @throws {ReferenceError} `reference/unknown-variant`, `reference/channels`
   */
  image(variant = 'full'): ReferenceImage {
    this.maxDepth(variant);
    const stem = join(this.folder, variant === 'full' ? 'ref' : `ref.${variant}`);
    const stats = json<ReferenceImage['stats']>(`${stem}.stats.json`);
    const file = `${stem}.exr`;
    if (!existsSync(file)) return { mean: floats(`${stem}.f32`), standardError: floats(`${stem}.se.f32`), stats };
    const image = decodeExr(readFileSync(file));
    return { mean: rgbOf(image, file, ''), standardError: rgbOf(image, file, 'standard_error.'), stats };
  }

  /** The scene with the reference's camera first, and its environment. */
  async scene(options: GltfOptions = this.#loading): Promise<Scene> {
    const scene = await loadGltfFile(join(this.folder, 'scene.glb'), options);
    scene.materials = scene.materials.map(applyExtras);
    scene.cameras = [lookAt(this.description.camera)];
    const environment = this.#environment();
    if (environment) scene.environment = environment;
    else delete scene.environment;
    return scene;
  }

  #environment(): Environment | undefined {
    const source = this.description.environment;
    if (source.type === 'none') return undefined;
    if (source.type === 'constant') return { type: 'constant', radiance: source.radiance };
    const { width, height, data } = decodeHdr(readFileSync(join(this.folder, source.file)));
    return {
      type: 'latlong',
      width,
      height,
      data,
      intensity: source.scale,
      rotation: (source.rotation_y_deg * Math.PI) / 180,
    };
  }
}
