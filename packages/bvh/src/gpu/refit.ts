import { BvhError } from '../error';
import { COPY_SRC, createBuffers, readBuffer, STORAGE, type Kernel } from './device';
import { inputOf } from './input';
import { compileHeights, compileRefit, compileSort, compileTriangles } from './kernels';
import type { GpuBlas, GpuMesh } from './options';
import { prepareSteps, sortPass, submitPhases, type PreparedSteps, type Step } from './passes';
import { GLOBALS_BYTES, planBuild } from './plan';

/** What {@link GpuRefitter} needs of a hierarchy: one of `GpuBuilder`, or of the CPU in buffers. */
export type RefitBlas = Pick<GpuBlas, 'depth' | 'nodeCount' | 'nodes' | 'triangleIndices'>;

/** Bytes of a packed triangle. */
const TRIANGLE_BYTES = 48;

/** A refit that is recorded repeatedly; see {@link GpuRefitter.prepare}. */
export type PreparedRefit = PreparedSteps;

/** Nodes of a height. */
interface Height {
  readonly first: number;
  readonly count: number;
}

/**
 * Fits the boxes of a hierarchy on the GPU to moved vertices, in place, as `refitBlas` does on the CPU, bit for bit. The
 * tree keeps its topology, so its quality drops as the mesh departs from the one that it was built for. Four bytes a
 * node of memory.
 *
 * @example
 * const refitter = await GpuRefitter.create(device, blas);
 * await refitter.refit(mesh); // each time that `mesh.positions` has changed
 */
export class GpuRefitter {
  readonly #device: GPUDevice;
  readonly #blas: RefitBlas;
  /** Nodes by height. */
  readonly #order: GPUBuffer;
  readonly #heights: readonly Height[];
  readonly #kernels = new Map<string, Promise<Kernel>>();
  #destroyed = false;

  private constructor(device: GPUDevice, blas: RefitBlas, order: GPUBuffer, heights: readonly Height[]) {
    this.#device = device;
    this.#blas = blas;
    this.#order = order;
    this.#heights = heights;
  }

  /**
   * Finds in which order nodes are refitted.
   *
   * @throws {BvhError} `bvh/memory`, `bvh/pipeline`, `bvh/device`.
   */
  static async create(device: GPUDevice, blas: RefitBlas): Promise<GpuRefitter> {
    const { nodes, nodeCount, depth } = blas;
    const { tiles, sizes } = planBuild(nodeCount);
    const size = 4 * nodeCount;
    const [sort, kernel, { order, ...temporary }] = await Promise.all([
      compileSort(device),
      compileHeights(device),
      createBuffers(
        device,
        { order: size, heights: size, unused: size, sorted: size, digits: sizes.digits, globals: GLOBALS_BYTES },
        STORAGE | COPY_SRC,
      ),
    ]);
    try {
      const { heights, sorted, unused, digits, globals } = temporary;
      const params = { count: nodeCount, vertices: 0, maxLeaf: 0, maxDepth: 0 };
      const steps = Array.from({ length: depth }, (_, i): Step => ({
        kernel,
        params: { ...params, level: i + 1 },
        buffers: { 1: nodes, 2: heights },
        workgroups: Math.ceil(nodeCount / 256),
      }));
      // One digit: no tree is higher than 255.
      const byHeight = sortPass(
        sort,
        { ...params, tiles, holes: 1 },
        globals,
        digits,
        [heights, unused],
        [sorted, order],
      );
      submitPhases(device, [['heights', [...steps, ...byHeight]]]);
      const counts = new Uint32Array(await readBuffer(device, digits, sizes.digits), 4 * 256 * tiles, 256);
      let first = counts[0] as number;
      const found = Array.from(counts.subarray(1, depth + 1), (count) => ({ first: (first += count) - count, count }));
      return new GpuRefitter(device, blas, order, found);
    } catch (error) {
      order.destroy();
      throw error;
    } finally {
      for (const buffer of Object.values(temporary)) buffer.destroy();
    }
  }

  /**
   * Fits the boxes. Resolves when the work is submitted: what is submitted later sees the new boxes. Not checked:
   * triangles that are no longer finite get boxes that are undefined.
   *
   * @param mesh The mesh with its new positions; same triangles, same order.
   * @throws {BvhError} `bvh/options`, `bvh/positions`, `bvh/indices`, `bvh/pipeline`, `bvh/destroyed`.
   */
  async refit(mesh: GpuMesh): Promise<void> {
    const prepared = await this.prepare(mesh);
    const encoder = this.#device.createCommandEncoder({ label: 'bvh refit' });
    prepared.encode(encoder);
    this.#device.queue.submit([encoder.finish()]);
    prepared.destroy();
  }

  /**
   * Prepares {@link refit} for a mesh whose positions change repeatedly in the same buffer: each time, what it
   * returns is recorded after what writes them.
   *
   * @param triangles Also packs the triangles in leaf order, as {@link GpuBlas.triangles}, into this buffer, of 48 bytes
   * each.
   * @throws As {@link refit}.
   */
  async prepare(mesh: GpuMesh, triangles?: GPUBuffer): Promise<PreparedRefit> {
    const { kind, buffers } = inputOf(mesh);
    const device = this.#device;
    const [kernel, pack] = await Promise.all([
      this.#kernel(`refit ${kind}`, () => compileRefit(device, kind)),
      triangles && this.#kernel(`triangles ${kind}`, () => compileTriangles(device, kind)),
    ]);
    this.#expectAlive();
    const { nodes, triangleIndices } = this.#blas;
    const numbers = { vertices: mesh.vertexCount, maxLeaf: 0, maxDepth: 0 };
    const steps = this.#heights.map(({ first, count }): Step => ({
      kernel,
      params: { ...numbers, count, firstDraft: first },
      buffers: { ...buffers, 3: triangleIndices, 4: this.#order, 5: nodes },
      workgroups: Math.ceil(count / 256),
    }));
    if (pack && triangles) {
      const count = Math.floor(triangles.size / TRIANGLE_BYTES);
      steps.push({
        kernel: pack,
        params: { ...numbers, count },
        buffers: { ...buffers, 3: triangleIndices, 4: triangles },
        workgroups: Math.ceil(count / 256),
      });
    }
    return prepareSteps(device, 'bvh refit', steps);
  }

  #kernel(name: string, compile: () => Promise<Kernel>): Promise<Kernel> {
    let compiled = this.#kernels.get(name);
    if (!compiled) {
      this.#kernels.set(name, (compiled = compile()));
      // A failure is not kept: the next call tries again.
      compiled.catch(() => this.#kernels.delete(name));
    }
    return compiled;
  }

  #expectAlive(): void {
    if (this.#destroyed) throw new BvhError('bvh/destroyed', 'This GpuRefitter was destroyed: create another one.');
  }

  /** Frees what was allocated; the hierarchy stays. */
  destroy(): void {
    this.#destroyed = true;
    this.#order.destroy();
  }
}
