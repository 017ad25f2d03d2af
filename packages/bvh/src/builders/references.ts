import type { TriangleMesh } from '../layout';
import { PAIR, type Primitives } from './primitives';
import { part, STEP, type Steps } from './steps';

/** Cells per axis of the grid along which triangles are cut. */
const GRID = 1 << 16;
/** Maximum number of pieces of one triangle. */
const PIECES_MAX = 64;
/**
 * Maximum number of additional pieces as a fraction of the primitives, and the multiple of the mean priority that a
 * triangle must have to be cut.
 */
const SHARE = 0.3;
const OUTSTANDING = 2;
/** From this many boxes along a ray, more triangles are cut. */
const CROWDED = 25;
/** A coordinate of a cut is moved out by this part of itself, more than rounding can have moved it in. */
const ROUNDING = 2 ** -21;

/** What a tree is built over: primitives, and pieces of triangles that would fill their boxes badly. */
export type References = Primitives;

/** The three vertices of a triangle, 9 numbers. */
function corners({ positions, indices }: TriangleMesh, triangle: number, out: Float64Array): void {
  for (let c = 0; c < 3; c++) {
    const vertex = 3 * (indices ? (indices[3 * triangle + c] as number) : 3 * triangle + c);
    for (let k = 0; k < 3; k++) out[3 * c + k] = positions[vertex + k] as number;
  }
}

/** Half the surface that a triangle's box has beyond what the boxes of infinitely many pieces would have together. */
function excess(v: Float64Array): number {
  const e = (i: number) => (v[3 + i] as number) - (v[i] as number),
    f = (i: number) => (v[6 + i] as number) - (v[i] as number);
  const extent = (i: number) =>
    Math.max(v[i] as number, v[3 + i] as number, v[6 + i] as number) -
    Math.min(v[i] as number, v[3 + i] as number, v[6 + i] as number);
  const x = extent(0),
    y = extent(1),
    z = extent(2);
  const ideal =
    0.5 *
    (Math.abs(e(1) * f(2) - e(2) * f(1)) + Math.abs(e(2) * f(0) - e(0) * f(2)) + Math.abs(e(0) * f(1) - e(1) * f(0)));
  return x * y + y * z + z * x - ideal;
}

/**
 * Cuts triangles whose boxes are mostly empty into pieces before a build (Karras and Aila 2013, "Fast Parallel
 * Construction of High-Quality Bounding Volume Hierarchies", section 5): along planes of one grid, so that the pieces
 * of neighbours fit each other. Only outliers are cut: a smooth mesh of small triangles stays whole.
 */
class Cutter {
  readonly #mesh: TriangleMesh;
  readonly #primitives: Primitives;
  /** How many pieces more each primitive's triangles get, by priority. */
  readonly #priorities: Float64Array;
  #factor = 0;
  /** Surface of all boxes. */
  #area = 0;
  /** Surface of the box around all. */
  readonly #whole: number;
  readonly #corners = new Float64Array(9);
  readonly #low = new Float64Array(3);
  readonly #scale = new Float64Array(3);

  constructor(mesh: TriangleMesh, primitives: Primitives) {
    this.#mesh = mesh;
    this.#primitives = primitives;
    this.#priorities = new Float64Array(primitives.count);
    const { bounds } = primitives;
    const [x, y, z] = [0, 1, 2].map((k) => (bounds[3 + k] as number) - (bounds[k] as number)) as [
      number,
      number,
      number,
    ];
    this.#whole = x * y + y * z + z * x;
    const extent = Math.max(x, y, z);
    for (let k = 0; k < 3; k++) {
      this.#low[k] = bounds[k] as number;
      this.#scale[k] = extent > 0 ? GRID / extent : 0;
    }
  }

  /** Finds all priorities. */
  *rate(): Steps<void> {
    const { count } = this.#primitives;
    for (let from = 0; from < count; from += STEP >> 2) {
      this.#rate(from, Math.min(count, from + (STEP >> 2)));
      yield from / count;
    }
  }

  #rate(from: number, to: number): void {
    const { triangles, boxes } = this.#primitives;
    const v = this.#corners;
    for (let i = from; i < to; i++) {
      const first = triangles[i] as number;
      corners(this.#mesh, first & (PAIR - 1), v);
      let excessArea = excess(v);
      if (first >= PAIR) {
        corners(this.#mesh, (first & (PAIR - 1)) + 1, v);
        excessArea += excess(v);
      }
      const b = 6 * i;
      const dx = (boxes[b + 3] as number) - (boxes[b] as number),
        dy = (boxes[b + 4] as number) - (boxes[b + 1] as number),
        dz = (boxes[b + 5] as number) - (boxes[b + 2] as number);
      this.#area += dx * dy + dy * dz + dz * dx;
      this.#priorities[i] = excessArea > 0 ? Math.cbrt(excessArea * 2 ** -this.#level(boxes, 6 * i)) : 0;
    }
  }

  /** The coarsest plane of the grid that crosses a box: 0 halves the scene; 16 if none does. */
  #level(boxes: ArrayLike<number>, at: number): number {
    let bits = 0;
    for (let k = 0; k < 3; k++)
      bits |= this.#cell(boxes[at + k] as number, k) ^ this.#cell(boxes[at + 3 + k] as number, k);
    return Math.min(16, Math.clz32(bits) - 16);
  }

  #cell(x: number, axis: number): number {
    return Math.min(GRID - 1, Math.max(0, (x - (this.#low[axis] as number)) * (this.#scale[axis] as number)) | 0);
  }

  /**
   * Decides how many pieces to make.
   *
   * @returns Upper bound on the number of references.
   */
  *plan(): Steps<number> {
    const { count, triangles } = this.#primitives;
    const priorities = this.#priorities;
    let sum = 0;
    for (let i = 0; i < count; i++) sum += priorities[i] as number;
    // The mean number of boxes that a ray crosses: the more, the more additional pieces pay off.
    const crowd = this.#whole > 0 ? Math.min(3, Math.max(1, this.#area / this.#whole / CROWDED)) : 1;
    const outstanding = OUTSTANDING / crowd;
    const budget = Math.floor(SHARE * crowd * count);
    // The largest factor that keeps to the budget and to what stands out, by bisection.
    let low = 0,
      high = sum > 0 ? count / (outstanding * sum) : 0;
    if ((yield* this.#total(high)) > budget) {
      for (let step = 0; step < 12; step++) {
        const middle = 0.5 * (low + high);
        if ((yield* this.#total(middle)) > budget) high = middle;
        else low = middle;
      }
    } else low = high;
    this.#factor = low;
    let pairs = 0;
    for (let i = 0; i < count; i++) if (this.#pieces(i, low) > 0 && (triangles[i] as number) >= PAIR) pairs++;
    return count + (yield* this.#total(low)) + pairs;
  }

  /** All pieces more. */
  *#total(factor: number): Steps<number> {
    const { count } = this.#primitives;
    let pieces = 0;
    for (let from = 0; from < count; from += STEP) {
      const end = Math.min(count, from + STEP);
      for (let i = from; i < end; i++) pieces += this.#pieces(i, factor);
      yield 0;
    }
    return pieces;
  }

  #pieces(primitive: number, factor: number): number {
    return Math.min(PIECES_MAX - 1, Math.floor((this.#priorities[primitive] as number) * factor));
  }

  /** Makes the references. */
  *cut(room: number): Steps<References> {
    const { count, boxes: whole, triangles: firsts, bounds } = this.#primitives;
    const boxes = new Float32Array(6 * room);
    const triangles = new Uint32Array(room);
    let made = 0;
    for (let i = 0; i < count; i++) {
      if (i % (STEP >> 2) === 0) yield i / count;
      const first = firsts[i] as number;
      const pieces = this.#pieces(i, this.#factor);
      if (pieces === 0) {
        for (let k = 0; k < 6; k++) boxes[6 * made + k] = whole[6 * i + k] as number;
        triangles[made++] = first;
        continue;
      }
      // A pair that is cut is taken apart first.
      const second = first >= PAIR;
      made = this.#pieceTogether(first & (PAIR - 1), second ? pieces >> 1 : pieces, boxes, triangles, made);
      if (second) made = this.#pieceTogether((first & (PAIR - 1)) + 1, pieces - (pieces >> 1), boxes, triangles, made);
    }
    return { boxes, triangles, count: made, bounds };
  }

  readonly #pieceBoxes = new Float64Array(6 * (PIECES_MAX + 1));
  readonly #pieceCuts = new Uint8Array(PIECES_MAX + 1);

  /** Cuts a triangle `cuts` times. Gives the number of references made so far. */
  #pieceTogether(triangle: number, cuts: number, boxes: Float32Array, triangles: Uint32Array, made: number): number {
    const v = this.#corners,
      stack = this.#pieceBoxes,
      left = this.#pieceCuts;
    corners(this.#mesh, triangle, v);
    for (let k = 0; k < 3; k++) {
      stack[k] = Math.min(v[k] as number, v[3 + k] as number, v[6 + k] as number);
      stack[3 + k] = Math.max(v[k] as number, v[3 + k] as number, v[6 + k] as number);
    }
    left[0] = cuts;
    for (let top = 1; top > 0;) {
      const at = 6 * (top - 1),
        n = left[top - 1] as number;
      if (n === 0 || !this.#halve(at)) {
        top--;
        for (let k = 0; k < 6; k++) boxes[6 * made + k] = stack[at + k] as number;
        triangles[made++] = triangle;
        continue;
      }
      // The remaining cuts go by the longest sides.
      const side = (b: number) =>
        Math.max(
          (stack[b + 3] as number) - (stack[b] as number),
          (stack[b + 4] as number) - (stack[b + 1] as number),
          (stack[b + 5] as number) - (stack[b + 2] as number),
        );
      const a = side(at),
        b = side(at + 6);
      const own = Math.round(((n - 1) * a) / (a + b));
      left[top - 1] = own;
      left[top++] = n - 1 - own;
    }
    return made;
  }

  /** Cuts the piece at `at` into two, the second put behind it; false if there is nothing to cut. */
  #halve(at: number): boolean {
    const box = this.#pieceBoxes,
      v = this.#corners;
    // The coarsest plane of the grid within the piece.
    let axis = -1,
      bit = -1,
      longest = 0;
    for (let k = 0; k < 3; k++) {
      const extent = (box[at + 3 + k] as number) - (box[at + k] as number);
      const changed = 31 - Math.clz32(this.#cell(box[at + k] as number, k) ^ this.#cell(box[at + 3 + k] as number, k));
      if (changed > bit || (changed === bit && extent > longest)) {
        axis = k;
        bit = changed;
        longest = extent;
      }
    }
    if (bit < 0) return false;
    const low = box[at + axis] as number,
      high = box[at + 3 + axis] as number;
    const cell = (this.#cell(high, axis) >>> bit) << bit;
    const plane = Math.fround((this.#low[axis] as number) + cell / (this.#scale[axis] as number));
    if (!(plane > low && plane < high)) return false;
    const to = at + 6;
    for (let k = 0; k < 6; k++) box[to + k] = box[at + k] as number;
    box[at + 3 + axis] = plane;
    box[to + axis] = plane;
    for (let k = 0; k < 3; k++) {
      if (k === axis) continue;
      // The extent of the triangle on either side of the plane.
      let a0 = Infinity,
        a1 = -Infinity,
        b0 = Infinity,
        b1 = -Infinity;
      for (let c = 0; c < 3; c++) {
        const d = (c + 1) % 3;
        const p = v[3 * c + axis] as number,
          q = v[3 * d + axis] as number;
        const x = v[3 * c + k] as number,
          y = v[3 * d + k] as number;
        if (p <= plane) {
          a0 = Math.min(a0, x);
          a1 = Math.max(a1, x);
        }
        if (p >= plane) {
          b0 = Math.min(b0, x);
          b1 = Math.max(b1, x);
        }
        if (p < plane === q < plane) continue;
        const crossing = x + ((y - x) * (plane - p)) / (q - p);
        const slack = ROUNDING * (Math.abs(x) + Math.abs(y));
        a0 = Math.min(a0, crossing - slack);
        a1 = Math.max(a1, crossing + slack);
        b0 = Math.min(b0, crossing - slack);
        b1 = Math.max(b1, crossing + slack);
      }
      box[at + k] = Math.max(box[at + k] as number, a0);
      box[at + 3 + k] = Math.min(box[at + 3 + k] as number, a1);
      box[to + k] = Math.max(box[to + k] as number, b0);
      box[to + 3 + k] = Math.min(box[to + 3 + k] as number, b1);
    }
    return true;
  }
}

/** Cuts what stands out of a mesh's primitives into pieces. */
export function* cutTriangles(mesh: TriangleMesh, primitives: Primitives): Steps<References> {
  const cutter = new Cutter(mesh, primitives);
  yield* part(cutter.rate(), 0, 0.4);
  const room = yield* part(cutter.plan(), 0.4, 0.6);
  return yield* part(cutter.cut(room), 0.6, 1);
}
