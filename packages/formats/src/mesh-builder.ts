import type { Mesh } from '@glanz/scene';

type Point = readonly [number, number, number];

/** Numbers in single precision that grow as they come. */
export class FloatList {
  // Files may have a group for each triangle.
  #numbers = new Float32Array(0);
  length = 0;

  push(...values: readonly number[]): void {
    if (this.length + values.length > this.#numbers.length) {
      const wider = new Float32Array(Math.max(36, 2 * this.#numbers.length, this.length + values.length));
      wider.set(this.#numbers);
      this.#numbers = wider;
    }
    for (const value of values) this.#numbers[this.length++] = value;
  }

  at(index: number): number {
    return this.#numbers[index] as number;
  }

  toArray(): Float32Array<ArrayBuffer> {
    return this.#numbers.slice(0, this.length);
  }
}

/** Collects triangles of bare corners; corners at the same place are one vertex. */
export class MeshBuilder {
  /** Triangles with corners that are not finite. */
  dropped = 0;
  readonly #positions = new FloatList();
  readonly #indices: number[] = [];
  readonly #vertices = new Map<string, number>();

  triangle(a: Point, b: Point, c: Point): void {
    const corners = [a, b, c].map((p) => [Math.fround(p[0]), Math.fround(p[1]), Math.fround(p[2])] as const);
    if (!corners.every((corner) => corner.every(Number.isFinite))) {
      this.dropped++;
      return;
    }
    for (const corner of corners) {
      const key = corner.join(' ');
      let vertex = this.#vertices.get(key);
      if (vertex === undefined) {
        vertex = this.#vertices.size;
        this.#vertices.set(key, vertex);
        this.#positions.push(...corner);
      }
      this.#indices.push(vertex);
    }
  }

  /** Undefined without triangles. */
  build(name: string): Mesh | undefined {
    return this.#indices.length === 0
      ? undefined
      : { name, positions: this.#positions.toArray(), indices: Uint32Array.from(this.#indices) };
  }
}
