import type { Mesh } from '@glanz/scene';

/** Numbers, growing. */
class Growing {
  #data: Float64Array = new Float64Array(1024);
  length = 0;
  push(a: number, b: number, c: number): void {
    if (this.length + 3 > this.#data.length) {
      const larger = new Float64Array(this.#data.length * 2);
      larger.set(this.#data);
      this.#data = larger;
    }
    this.#data[this.length++] = a;
    this.#data[this.length++] = b;
    this.#data[this.length++] = c;
  }
  get view(): Float64Array {
    return this.#data.subarray(0, this.length);
  }
}

const METRES_PER_MILLIMETRE = 0.001;

/** Collects vertices with normals, in millimetres, and triangles; several closed shells may share one builder. */
export class MeshBuilder {
  readonly #positions = new Growing();
  readonly #normals = new Growing();
  readonly #triangles = new Growing();

  /** Adds a vertex and gives its index. The normal need not be unit. */
  vertex(x: number, y: number, z: number, nx: number, ny: number, nz: number): number {
    this.#positions.push(x, y, z);
    const length = Math.hypot(nx, ny, nz) || 1;
    this.#normals.push(nx / length, ny / length, nz / length);
    return this.#positions.length / 3 - 1;
  }

  /** Adds a triangle, counter-clockwise from outside. */
  triangle(a: number, b: number, c: number): void {
    this.#triangles.push(a, b, c);
  }

  /** Adds a quadrilateral, counter-clockwise from outside. */
  quad(a: number, b: number, c: number, d: number): void {
    this.triangle(a, b, c);
    this.triangle(a, c, d);
  }

  /** Number of vertices so far. */
  get vertexCount(): number {
    return this.#positions.length / 3;
  }

  /** Moves all vertices from index `first` on. */
  transformFrom(
    first: number,
    matrix: (x: number, y: number, z: number, w: 0 | 1) => readonly [number, number, number],
  ): void {
    const [p, n] = [this.#positions.view, this.#normals.view];
    for (let i = first * 3; i < p.length; i += 3) {
      p.set(matrix(p[i]!, p[i + 1]!, p[i + 2]!, 1), i);
      n.set(matrix(n[i]!, n[i + 1]!, n[i + 2]!, 0), i);
    }
  }

  /** Builds a shape inside out: the wall of a cavity. */
  inverted(shape: () => void): void {
    const [vertices, triangles] = [this.#normals.length, this.#triangles.length];
    shape();
    const [n, t] = [this.#normals.view, this.#triangles.view];
    for (let i = vertices; i < n.length; i++) n[i] = -n[i]!;
    for (let i = triangles; i < t.length; i += 3) [t[i + 1], t[i + 2]] = [t[i + 2]!, t[i + 1]!];
  }

  /** The mesh, in metres. */
  build(name: string): Mesh {
    return {
      name,
      positions: Float32Array.from(this.#positions.view, (value) => value * METRES_PER_MILLIMETRE),
      normals: Float32Array.from(this.#normals.view),
      indices: Uint32Array.from(this.#triangles.view),
    };
  }
}
