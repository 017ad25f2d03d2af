import type { Blas, TriangleMesh } from '@glanz/bvh';
import { buildBlasAsync } from '@glanz/bvh/async';
import { best, bestSplit } from '@glanz/bvh/best';
import { fast } from '@glanz/bvh/fast';
import { BlasCache, type BlasStore } from '@glanz/bvh/cache';
import { openIndexedDbStore } from '@glanz/bvh/indexed-db';
import { bvhStatistics, type BvhStatistics } from '@glanz/bvh/statistics';
import { endPointOverlap } from '@glanz/bvh/tree-quality';
import { makeModel, type HierarchyModel } from './models';
import { boxesOnLevel, trace } from './trace';

export const HIERARCHY_BUILDERS = { fast, balanced: 'balanced', best, 'best-split': bestSplit } as const;

export type HierarchyBuilderName = keyof typeof HIERARCHY_BUILDERS;

/** What is to be seen. */
export interface HierarchyView {
  readonly model: HierarchyModel;
  readonly builder: HierarchyBuilderName;
  readonly show: 'heat' | 'levels';
  readonly level: number;
  /** Degrees around the model. */
  readonly turn: number;
}

/** What the page shows of a tree. */
export interface HierarchyFacts extends BvhStatistics {
  readonly triangles: number;
  readonly endPointOverlap: number;
  /** How the tree came, and how long that took. */
  readonly source: 'built' | 'store';
  readonly milliseconds: number;
}

/** What the page shows of an image. */
export interface ImageFacts {
  /** Nodes and triangles that a ray which meets the root's box looks at, on the average. */
  readonly meanCost: number;
  readonly boxes: number;
}

/** The cost that the heat map's last colour stands for. */
export const HOTTEST = 80;

/** Yields to the event loop after so many milliseconds. */
const SLICE_MS = 12;

/** Keeps nothing: for windows in which the browser gives no database. */
const NO_STORE: BlasStore = { get: () => Promise.resolve(undefined), set: () => Promise.resolve() };

const HEAT = [
  [10, 9, 30],
  [66, 18, 104],
  [168, 42, 86],
  [232, 104, 40],
  [250, 190, 70],
  [255, 250, 225],
] as const;

/** A colour of the heat map, 0 to 1. */
export function heat(share: number): [number, number, number] {
  const x = Math.min(1, Math.max(0, share)) * (HEAT.length - 1),
    i = Math.min(HEAT.length - 2, Math.floor(x));
  return [0, 1, 2].map((k) => HEAT[i]![k]! + (x - i) * (HEAT[i + 1]![k]! - HEAT[i]![k]!)) as [number, number, number];
}

const turned = (x: number, y: number, z: number, yaw: number, pitch: number): [number, number, number] => {
  const a = x * Math.cos(yaw) + z * Math.sin(yaw),
    b = z * Math.cos(yaw) - x * Math.sin(yaw);
  return [a, y * Math.cos(pitch) - b * Math.sin(pitch), b * Math.cos(pitch) + y * Math.sin(pitch)];
};

/** Trees of the page's models, kept in the browser's database, and images of them on a canvas. */
export class HierarchySession {
  readonly #context: CanvasRenderingContext2D;
  readonly #cache: BlasCache;
  #model: HierarchyModel | undefined;
  #mesh: TriangleMesh = { positions: new Float32Array(0) };
  #blas: Blas | undefined;
  #words = new Uint32Array(0);

  private constructor(context: CanvasRenderingContext2D, store: BlasStore) {
    this.#context = context;
    // A mesh as small as these is built faster than it is read; here it is to be seen.
    this.#cache = new BlasCache(
      store,
      { buildBlas: (mesh, options) => buildBlasAsync(mesh, options) },
      { minTriangles: 0 },
    );
  }

  static async create(canvas: HTMLCanvasElement): Promise<HierarchySession> {
    const context = canvas.getContext('2d');
    if (!context) throw new Error('The canvas gave no context.');
    return new HierarchySession(context, await openIndexedDbStore({ name: 'glanz-docs-bvh' }).catch(() => NO_STORE));
  }

  /** Gets the tree. */
  async build(model: HierarchyModel, builder: HierarchyBuilderName, signal: AbortSignal): Promise<HierarchyFacts> {
    if (model !== this.#model) this.#mesh = makeModel(model);
    this.#model = model;
    const hits = this.#cache.hits,
      start = performance.now();
    const blas = await this.#cache.buildBlas(this.#mesh, { builder: HIERARCHY_BUILDERS[builder], signal });
    const milliseconds = performance.now() - start;
    this.#blas = blas;
    this.#words = new Uint32Array(blas.nodes.buffer, blas.nodes.byteOffset, blas.nodes.length);
    await this.#cache.written();
    const { positions, indices } = this.#mesh;
    return {
      ...bvhStatistics(blas),
      triangles: (indices ? indices.length : positions.length / 3) / 3,
      endPointOverlap: endPointOverlap(blas, this.#mesh),
      source: this.#cache.hits > hits ? 'store' : 'built',
      milliseconds,
    };
  }

  /** Draws the tree that was got last: coarse at first, then every pixel. */
  async draw({ show, level, turn }: HierarchyView, signal: AbortSignal): Promise<ImageFacts> {
    const blas = this.#blas;
    if (!blas) return { meanCost: 0, boxes: 0 };
    const context = this.#context,
      { width, height } = context.canvas;
    const { min, max } = blas.bounds;
    const center = [0, 1, 2].map((k) => (min[k]! + max[k]!) / 2),
      radius = Math.hypot(...[0, 1, 2].map((k) => max[k]! - min[k]!)) / 2;
    const yaw = (turn * Math.PI) / 180,
      pitch = 0.45,
      distance = 2.4 * radius,
      lens = 2.4;
    const eye = turned(0, 0, distance, 0, -pitch);
    const world = ([x, y, z]: readonly [number, number, number]): [number, number, number] => [
      x * Math.cos(yaw) - z * Math.sin(yaw),
      y,
      x * Math.sin(yaw) + z * Math.cos(yaw),
    ];
    const origin = world(eye).map((x, k) => x + center[k]!);
    const image = context.createImageData(width, height);
    const traced = { cost: 0, facing: 0 };
    let sum = 0,
      counted = 0,
      last = performance.now();
    for (const step of [8, 2, 1]) {
      sum = counted = 0;
      for (let y = 0; y < height; y += step) {
        for (let x = 0; x < width; x += step) {
          const [dx, dy, dz] = turned(
            (x + step / 2 - width / 2) / (height / 2),
            (height / 2 - y - step / 2) / (height / 2),
            -lens,
            0,
            -pitch,
          );
          const length = Math.hypot(dx, dy, dz);
          const direction = world([dx / length, dy / length, dz / length]);
          trace(blas, this.#words, this.#mesh, origin, direction, traced);
          if (traced.cost > 1) {
            sum += traced.cost;
            counted++;
          }
          const grey = traced.facing < 0 ? 26 : 70 + 150 * traced.facing;
          const [r, g, b] = show === 'heat' ? heat(traced.cost / HOTTEST) : [grey, grey, grey];
          for (let j = y; j < Math.min(height, y + step); j++) {
            for (let i = x; i < Math.min(width, x + step); i++) image.data.set([r, g, b, 255], 4 * (j * width + i));
          }
        }
        if (performance.now() - last < SLICE_MS) continue;
        context.putImageData(image, 0, 0);
        await new Promise((resolve) => setTimeout(resolve, 0));
        signal.throwIfAborted();
        last = performance.now();
      }
      context.putImageData(image, 0, 0);
    }
    const boxes = show === 'levels' ? boxesOnLevel(blas, level) : [];
    const project = (x: number, y: number, z: number): [number, number] => {
      const [a, b, c] = turned(x - center[0]!, y - center[1]!, z - center[2]!, yaw, pitch);
      const scale = (height / 2) * (lens / (distance - c));
      return [width / 2 + a * scale, height / 2 - b * scale];
    };
    for (const [i, box] of boxes.entries()) {
      context.strokeStyle = `hsl(${(i * 137.5) % 360} 90% 62% / ${Math.max(0.25, 1 / (1 + boxes.length / 300))})`;
      context.lineWidth = boxes.length > 200 ? 1 : 1.5;
      context.beginPath();
      for (let corner = 0; corner < 8; corner++) {
        for (let axis = 0; axis < 3; axis++) {
          if (corner & (1 << axis)) continue;
          const at = (c: number) => project(box[c & 1 ? 3 : 0]!, box[c & 2 ? 4 : 1]!, box[c & 4 ? 5 : 2]!);
          context.moveTo(...at(corner));
          context.lineTo(...at(corner | (1 << axis)));
        }
      }
      context.stroke();
    }
    return { meanCost: counted > 0 ? sum / counted : 0, boxes: boxes.length };
  }
}
