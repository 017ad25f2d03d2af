import { FAR, LEFT, LEFT_MAX, LEFT_MIN, leafReference, NODE_WORDS, PARENT, RIGHT, RIGHT_MAX, RIGHT_MIN } from '../layout';

/** What a build over boxes may be told. */
export interface BinnedSahOptions {
  /** Most primitives a leaf holds, 1 to 16. */
  readonly maxLeaf: number;
  /** Most inner nodes on the way to a leaf. */
  readonly maxDepth: number;
  /** Bins per axis. */
  readonly bins: number;
  /** Cost of visiting a node over that of testing a primitive. */
  readonly nodeCost: number;
}

/** A hierarchy over boxes. */
export interface Tree {
  /** 16 words a node. */
  readonly nodes: Float32Array<ArrayBuffer>;
  readonly nodeCount: number;
}

/** Words of a pending range: first, end, parent node, side, depth, box (6), box of the centres (6). */
const TASK = 17;

const area = (x: number, y: number, z: number) => x * y + y * z + z * x;

/**
 * Builds a hierarchy top down by binned surface area heuristic (Wald 2007, "On fast Construction of SAH-based Bounding
 * Volume Hierarchies") on all three axes, without recursion and without allocation per node. Where the depth left would
 * not suffice, or no plane separates the centres, ranges are halved by count, so the depth is bounded for any input.
 *
 * @param boxes Six numbers a primitive: min xyz, max xyz; finite.
 * @param order Primitive indices to build over; permuted into leaf order.
 */
export function buildBinnedSah(boxes: Float32Array, order: Uint32Array, options: BinnedSahOptions): Tree {
  const { maxLeaf, maxDepth, bins, nodeCost } = options;
  const count = order.length;
  const nodes = new Float32Array(Math.max(count - 1, 1) * NODE_WORDS);
  const words = new Uint32Array(nodes.buffer);
  let nodeCount = 0;

  const writeChild = (node: number, right: number, reference: number, x0: number, y0: number, z0: number, x1: number, y1: number, z1: number) => {
    const base = node * NODE_WORDS;
    const min = base + (right ? RIGHT_MIN : LEFT_MIN);
    const max = base + (right ? RIGHT_MAX : LEFT_MAX);
    nodes[min] = x0;
    nodes[min + 1] = y0;
    nodes[min + 2] = z0;
    nodes[max] = x1;
    nodes[max + 1] = y1;
    nodes[max + 2] = z1;
    words[base + (right ? RIGHT : LEFT)] = reference;
  };

  if (count < 2) {
    // Both references name the one leaf; for no primitives at all, a leaf that is never reached.
    const leaf = leafReference(0, 1);
    const b = (order[0] ?? 0) * 6;
    if (count === 1) writeChild(0, 0, leaf, boxes[b] as number, boxes[b + 1] as number, boxes[b + 2] as number, boxes[b + 3] as number, boxes[b + 4] as number, boxes[b + 5] as number);
    else writeChild(0, 0, leaf, FAR, FAR, FAR, FAR, FAR, FAR);
    writeChild(0, 1, leaf, FAR, FAR, FAR, FAR, FAR, FAR);
    return { nodes, nodeCount: 1 };
  }

  // Per bin and axis: box (6) and count, then the costs of the left sides.
  const binBoxes = new Float64Array(3 * bins * 6);
  const binCounts = new Uint32Array(3 * bins);
  const leftCosts = new Float64Array(bins);
  // Pending ranges: one a level, and the current two.
  const tasks = new Float64Array((maxDepth + 3) * TASK);
  const left = new Float64Array(12);
  const right = new Float64Array(12);

  const clear = (box: Float64Array) => {
    for (let i = 0; i < 12; i += 6) {
      box[i] = box[i + 1] = box[i + 2] = Infinity;
      box[i + 3] = box[i + 4] = box[i + 5] = -Infinity;
    }
  };
  const grow = (box: Float64Array, primitive: number) => {
    const b = primitive * 6;
    const x0 = boxes[b] as number, y0 = boxes[b + 1] as number, z0 = boxes[b + 2] as number;
    const x1 = boxes[b + 3] as number, y1 = boxes[b + 4] as number, z1 = boxes[b + 5] as number;
    if (x0 < (box[0] as number)) box[0] = x0;
    if (y0 < (box[1] as number)) box[1] = y0;
    if (z0 < (box[2] as number)) box[2] = z0;
    if (x1 > (box[3] as number)) box[3] = x1;
    if (y1 > (box[4] as number)) box[4] = y1;
    if (z1 > (box[5] as number)) box[5] = z1;
    const x = x0 + x1, y = y0 + y1, z = z0 + z1;
    if (x < (box[6] as number)) box[6] = x;
    if (y < (box[7] as number)) box[7] = y;
    if (z < (box[8] as number)) box[8] = z;
    if (x > (box[9] as number)) box[9] = x;
    if (y > (box[10] as number)) box[10] = y;
    if (z > (box[11] as number)) box[11] = z;
  };
  const push = (top: number, first: number, end: number, parent: number, side: number, depth: number, box: Float64Array) => {
    const t = top * TASK;
    tasks[t] = first;
    tasks[t + 1] = end;
    tasks[t + 2] = parent;
    tasks[t + 3] = side;
    tasks[t + 4] = depth;
    tasks.set(box, t + 5);
  };

  clear(left);
  for (let i = 0; i < count; i++) grow(left, order[i] as number);
  push(0, 0, count, -1, 0, 0, left);
  let top = 1;
  while (top > 0) {
    const t = --top * TASK;
    const first = tasks[t] as number, end = tasks[t + 1] as number, parent = tasks[t + 2] as number, side = tasks[t + 3] as number, depth = tasks[t + 4] as number;
    const x0 = tasks[t + 5] as number, y0 = tasks[t + 6] as number, z0 = tasks[t + 7] as number, x1 = tasks[t + 8] as number, y1 = tasks[t + 9] as number, z1 = tasks[t + 10] as number;
    const cx0 = tasks[t + 11] as number, cy0 = tasks[t + 12] as number, cz0 = tasks[t + 13] as number, cx1 = tasks[t + 14] as number, cy1 = tasks[t + 15] as number, cz1 = tasks[t + 16] as number;
    const size = end - first;
    const isRoot = parent < 0;
    // The best plane: axis and first bin of the right side.
    let bestAxis = -1, bestBin = 0, bestCost = Infinity;
    const kx = bins / (cx1 - cx0), ky = bins / (cy1 - cy0), kz = bins / (cz1 - cz0);
    // Depth that halving would need from here on.
    const needed = Math.ceil(Math.log2(size / maxLeaf)) + 1;
    if (size > 1 && depth + needed < maxDepth) {
      // An axis of no extent, or one too short to tell bins apart, has no plane.
      const useX = kx < Infinity, useY = ky < Infinity, useZ = kz < Infinity;
      for (let i = 0; i < 3 * bins; i++) {
        const b = i * 6;
        binBoxes[b] = binBoxes[b + 1] = binBoxes[b + 2] = Infinity;
        binBoxes[b + 3] = binBoxes[b + 4] = binBoxes[b + 5] = -Infinity;
        binCounts[i] = 0;
      }
      for (let i = first; i < end; i++) {
        const b = (order[i] as number) * 6;
        const px0 = boxes[b] as number, py0 = boxes[b + 1] as number, pz0 = boxes[b + 2] as number;
        const px1 = boxes[b + 3] as number, py1 = boxes[b + 4] as number, pz1 = boxes[b + 5] as number;
        for (let axis = 0; axis < 3; axis++) {
          let bin: number;
          if (axis === 0) {
            if (!useX) continue;
            bin = ((px0 + px1 - cx0) * kx) | 0;
          } else if (axis === 1) {
            if (!useY) continue;
            bin = ((py0 + py1 - cy0) * ky) | 0;
          } else {
            if (!useZ) continue;
            bin = ((pz0 + pz1 - cz0) * kz) | 0;
          }
          bin = (bin >= bins ? bins - 1 : bin) + axis * bins;
          binCounts[bin] = (binCounts[bin] as number) + 1;
          const o = bin * 6;
          if (px0 < (binBoxes[o] as number)) binBoxes[o] = px0;
          if (py0 < (binBoxes[o + 1] as number)) binBoxes[o + 1] = py0;
          if (pz0 < (binBoxes[o + 2] as number)) binBoxes[o + 2] = pz0;
          if (px1 > (binBoxes[o + 3] as number)) binBoxes[o + 3] = px1;
          if (py1 > (binBoxes[o + 4] as number)) binBoxes[o + 4] = py1;
          if (pz1 > (binBoxes[o + 5] as number)) binBoxes[o + 5] = pz1;
        }
      }
      for (let axis = 0; axis < 3; axis++) {
        if (axis === 0 ? !useX : axis === 1 ? !useY : !useZ) continue;
        let n = 0, ax0 = Infinity, ay0 = Infinity, az0 = Infinity, ax1 = -Infinity, ay1 = -Infinity, az1 = -Infinity;
        for (let bin = 0; bin < bins - 1; bin++) {
          const o = (axis * bins + bin) * 6;
          n += binCounts[axis * bins + bin] as number;
          ax0 = Math.min(ax0, binBoxes[o] as number);
          ay0 = Math.min(ay0, binBoxes[o + 1] as number);
          az0 = Math.min(az0, binBoxes[o + 2] as number);
          ax1 = Math.max(ax1, binBoxes[o + 3] as number);
          ay1 = Math.max(ay1, binBoxes[o + 4] as number);
          az1 = Math.max(az1, binBoxes[o + 5] as number);
          leftCosts[bin] = n === 0 ? Infinity : n * area(ax1 - ax0, ay1 - ay0, az1 - az0);
        }
        n = 0;
        ax0 = ay0 = az0 = Infinity;
        ax1 = ay1 = az1 = -Infinity;
        for (let bin = bins - 1; bin > 0; bin--) {
          const o = (axis * bins + bin) * 6;
          n += binCounts[axis * bins + bin] as number;
          ax0 = Math.min(ax0, binBoxes[o] as number);
          ay0 = Math.min(ay0, binBoxes[o + 1] as number);
          az0 = Math.min(az0, binBoxes[o + 2] as number);
          ax1 = Math.max(ax1, binBoxes[o + 3] as number);
          ay1 = Math.max(ay1, binBoxes[o + 4] as number);
          az1 = Math.max(az1, binBoxes[o + 5] as number);
          if (n === 0) continue;
          const cost = n * area(ax1 - ax0, ay1 - ay0, az1 - az0) + (leftCosts[bin - 1] as number);
          if (cost < bestCost) {
            bestCost = cost;
            bestAxis = axis;
            bestBin = bin;
          }
        }
      }
    }
    const box = area(x1 - x0, y1 - y0, z1 - z0);
    // Splitting must pay: costs are over the probability of a hit, which is the box's area.
    if (!isRoot && size <= maxLeaf && !(bestCost + nodeCost * box < size * box)) {
      writeChild(parent, side, leafReference(first, size), x0, y0, z0, x1, y1, z1);
      continue;
    }
    const node = nodeCount++;
    if (!isRoot) {
      writeChild(parent, side, node, x0, y0, z0, x1, y1, z1);
      words[node * NODE_WORDS + PARENT] = parent;
    }
    clear(left);
    clear(right);
    let middle = first;
    if (bestAxis >= 0) {
      const low = bestAxis === 0 ? cx0 : bestAxis === 1 ? cy0 : cz0;
      const scale = bestAxis === 0 ? kx : bestAxis === 1 ? ky : kz;
      let j = end;
      while (middle < j) {
        const primitive = order[middle] as number;
        const b = primitive * 6 + bestAxis;
        let bin = (((boxes[b] as number) + (boxes[b + 3] as number) - low) * scale) | 0;
        if (bin >= bins) bin = bins - 1;
        if (bin < bestBin) {
          grow(left, primitive);
          middle++;
        } else {
          grow(right, primitive);
          order[middle] = order[--j] as number;
          order[j] = primitive;
        }
      }
    } else {
      // Halves by count, along the longest extent of the centres.
      const ex = cx1 - cx0, ey = cy1 - cy0, ez = cz1 - cz0;
      const axis = ex >= ey && ex >= ez ? 0 : ey >= ez ? 1 : 2;
      middle = (first + end) >>> 1;
      if (ex > 0 || ey > 0 || ez > 0) selectNth(order, boxes, axis, first, end, middle);
      for (let i = first; i < middle; i++) grow(left, order[i] as number);
      for (let i = middle; i < end; i++) grow(right, order[i] as number);
    }
    push(top++, middle, end, node, 1, depth + 1, right);
    push(top++, first, middle, node, 0, depth + 1, left);
  }
  return { nodes: nodes.slice(0, nodeCount * NODE_WORDS), nodeCount };
}

/** Permutes `order[first, end)` so that the centres before `nth` are no larger along `axis` than those from it on (quickselect). */
function selectNth(order: Uint32Array, boxes: Float32Array, axis: number, first: number, end: number, nth: number): void {
  const key = (i: number) => {
    const b = (order[i] as number) * 6 + axis;
    return (boxes[b] as number) + (boxes[b + 3] as number);
  };
  let low = first, high = end - 1;
  while (low < high) {
    const pivot = key((low + high) >>> 1);
    let i = low, j = high;
    while (i <= j) {
      while (key(i) < pivot) i++;
      while (key(j) > pivot) j--;
      if (i <= j) {
        const swap = order[i] as number;
        order[i++] = order[j] as number;
        order[j--] = swap;
      }
    }
    if (nth <= j) high = j;
    else if (nth >= i) low = i;
    else return;
  }
}
