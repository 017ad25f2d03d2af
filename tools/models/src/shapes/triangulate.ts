/** A loop of points in the plane, stride 2. */
export type Loop = readonly (readonly [x: number, y: number])[];

interface Node {
  readonly index: number;
  readonly x: number;
  readonly y: number;
  previous: Node;
  next: Node;
}

const area = (a: Node, b: Node, c: Node) => (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);

function ring(loop: Loop, offset: number): Node {
  const nodes = loop.map(([x, y], i) => ({ index: offset + i, x, y }) as Node);
  for (const [i, node] of nodes.entries()) {
    node.next = nodes[(i + 1) % nodes.length]!;
    node.previous = nodes[(i + nodes.length - 1) % nodes.length]!;
  }
  return nodes[0]!;
}

function* around(start: Node): Generator<Node> {
  let node = start;
  do {
    yield node;
    node = node.next;
  } while (node !== start);
}

const within = (a: Node, b: Node, c: Node, p: Node) => area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0;
const samePlace = (a: Node, b: Node) => a.x === b.x && a.y === b.y;

/** Whether the segments ab and cd cross or touch, apart from shared end points. */
function cross(a: Node, b: Node, c: Node, d: Node): boolean {
  if (samePlace(a, c) || samePlace(a, d) || samePlace(b, c) || samePlace(b, d)) return false;
  return area(a, b, c) * area(a, b, d) <= 0 && area(c, d, a) * area(c, d, b) <= 0;
}

/** Whether a straight line from `a` leaves into the polygon's inside. */
function opensInto(a: Node, b: Node): boolean {
  return area(a.previous, a, a.next) >= 0
    ? area(a, b, a.previous) > 0 && area(a, a.next, b) > 0
    : !(area(a, b, a.next) >= 0 && area(a, a.previous, b) >= 0);
}

/** Whether o and h see each other through the inside. */
function clearWay(o: Node, h: Node, rings: readonly Node[]): boolean {
  if (!opensInto(o, h) || !opensInto(h, o)) return false;
  for (const start of rings) for (const node of around(start)) if (cross(o, h, node, node.next)) return false;
  return true;
}

/** Joins a hole to the loop around it by a pair of coinciding edges. Gives a node of the joined loop. */
function bridge(outer: Node, hole: Node, rings: readonly Node[]): Node {
  const outside = [...around(outer)];
  for (const h of [...around(hole)].sort((a, b) => b.x - a.x)) {
    const distance = (o: Node) => (o.x - h.x) ** 2 + (o.y - h.y) ** 2;
    const o = outside.sort((a, b) => distance(a) - distance(b)).find((node) => clearWay(node, h, rings));
    if (!o) continue;
    const o2 = { index: o.index, x: o.x, y: o.y } as Node;
    const h2 = { index: h.index, x: h.x, y: h.y } as Node;
    o2.next = o.next;
    o2.next.previous = o2;
    h2.previous = h.previous;
    h2.previous.next = h2;
    o.next = h;
    h.previous = o;
    h2.next = o2;
    o2.previous = h2;
    return o;
  }
  throw new RangeError('triangulate: no edge connects a hole with the outline');
}

/**
 * Cuts a polygon with holes into triangles by ear clipping (Meisters 1975; holes joined by bridges). Uses every vertex,
 * so that neighbouring surfaces meet without gaps.
 *
 * @param outer Counter-clockwise.
 * @param holes Clockwise, inside `outer`, apart from each other.
 * @returns Vertex indices, three a triangle, counter-clockwise; vertices are numbered through `outer` and then the
 * holes.
 * @throws {RangeError} when the loops cross themselves or each other.
 */
export function triangulate(outer: Loop, holes: readonly Loop[] = []): number[] {
  let start = ring(outer, 0);
  let count = outer.length;
  const rest: Node[] = [];
  for (const hole of holes) {
    rest.push(ring(hole, count));
    count += hole.length;
  }
  let remaining = count + 2 * holes.length;
  while (rest.length > 0) {
    const hole = rest.shift()!;
    start = bridge(start, hole, [start, hole, ...rest]);
  }

  const triangles: number[] = [];
  const reflex = new Set<Node>();
  for (const node of around(start)) if (area(node.previous, node, node.next) <= 0) reflex.add(node);
  const isEar = (node: Node, minimum: number) => {
    const [a, c] = [node.previous, node.next];
    if (!(area(a, node, c) > minimum)) return false;
    for (const p of reflex)
      if (
        p !== a &&
        p !== node &&
        p !== c &&
        !samePlace(p, a) &&
        !samePlace(p, node) &&
        !samePlace(p, c) &&
        within(a, node, c, p)
      )
        return false;
    return true;
  };
  let node = start;
  let idle = 0;
  while (remaining > 3) {
    // Flat ears come last: they have no area, but their vertices must be kept.
    if (isEar(node, idle > remaining ? -1e-12 : 1e-12)) {
      const [a, c] = [node.previous, node.next];
      triangles.push(a.index, node.index, c.index);
      a.next = c;
      c.previous = a;
      reflex.delete(node);
      for (const touched of [a, c]) {
        if (area(touched.previous, touched, touched.next) > 0) reflex.delete(touched);
        else reflex.add(touched);
      }
      remaining--;
      // Every other vertex: it gives rounder triangles than a fan.
      node = c.next;
      idle = 0;
    } else {
      node = node.next;
      if (++idle > 2 * remaining + 2) throw new RangeError('triangulate: the outline crosses itself');
    }
  }
  triangles.push(node.previous.index, node.index, node.next.index);
  return triangles;
}
