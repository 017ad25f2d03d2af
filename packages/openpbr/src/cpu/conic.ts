import type { OpenPbrVector } from '../parameters/index';
import type { Slopes } from './ggx';
import { clamp, length2, length3 } from './vector';

/** Facets a with a² ≤ (a·wo) (a·axis), axis = lean p̂ + upright z. */
export type Conic = readonly [lean: number, upright: number];

/** Facets as they are seen from one direction. */
export interface SeenFacets {
  /** The view's slope along its azimuth, where facets are stretched to a round highlight. */
  readonly flat: number;
  /** Those that mirror the view upwards. */
  readonly upwards: Conic;
  /** Sums over so many facets within both conics; the weights of all that are seen add up to 1. */
  readonly sum: (count: number, one: Conic, other: Conic, add: (weight: number, h: OpenPbrVector) => void) => void;
  /** The same over these: places along and across the view, from 0 to 1 within the conics, and weights. */
  readonly sumOver: (
    nodes: Iterable<readonly [along: number, across: number, weight: number]>,
    one: Conic,
    other: Conic,
    add: (weight: number, h: OpenPbrVector) => void,
  ) => void;
}

const smooth = (x: number): number => x * x * (3 - 2 * x);

/** Steps of the golden ratio, denser at the bounds. */
function* golden(count: number): Generator<[along: number, across: number, weight: number]> {
  for (let i = 0; i < count; i++) {
    const u = (i + 0.5) / count;
    const v = (i * 0.618034 + 0.5) % 1;
    yield [smooth(u), smooth(v), (36 * u * (1 - u) * v * (1 - v)) / count];
  }
}

/** Sums over facets within conics, seen from `wo`; `openpbrInside` says how they are chosen. */
export function seenFacets(alpha: Slopes, wo: OpenPbrVector): SeenFacets {
  const [ax, ay] = alpha;
  const flat = length2(ax * wo[0], ay * wo[1]);
  const towards = flat > 1e-10 ? ([(ax * wo[0]) / flat, (ay * wo[1]) / flat] as const) : ([1, 0] as const);
  // Where facets are stretched to a round highlight the view has this sine and cosine.
  const length = length2(flat, wo[2]);
  const sine = flat / length;
  const cosine = wo[2] / length;
  // Facets are cos χ (sin ψ p + cos ψ z) + sin χ q; of p, what is not along q is `least` long, squared.
  const p = [ax * towards[0], ay * towards[1]] as const;
  const q = [-ax * towards[1], ay * towards[0]] as const;
  const square = q[0] * q[0] + q[1] * q[1];
  const skew = (p[0] * q[0] + p[1] * q[1]) / square;
  const min = (ax * ay) ** 2 / square;

  /** Of the facets within a conic, sin (ψ - ψ of the view), which is even among those that are seen. */
  const range = ([lean, upright]: Conic): readonly [first: number, last: number] => {
    const a = flat * lean - min;
    const b = 0.5 * (flat * upright + wo[2] * lean);
    const c = wo[2] * upright - 1;
    const discriminant = b * b - a * c;
    if (discriminant <= 0) return [1, -1];
    const root = b + (b >= 0 ? 1 : -1) * Math.sqrt(discriminant);
    // At the critical angle a is 0, and the conic open at one end.
    const [x, y] = [clamp(-root / (a >= 0 ? Math.max(a, 1e-30) : a), -1e15, 1e15), clamp(-c / root, -1e15, 1e15)];
    const place = (slope: number): number => (slope * cosine - sine) / length2(slope, 1);
    return [place(a >= 0 ? Math.max(x, y) : Math.min(x, y)), a >= 0 ? cosine : place(Math.max(x, y))];
  };
  /** The square of tan χ at the conic's bounds, about its middle. */
  const reach = ([lean, upright]: Conic, sinPsi: number, cosPsi: number): number =>
    ((sinPsi * flat + cosPsi * wo[2]) * (sinPsi * lean + cosPsi * upright) - min * sinPsi * sinPsi - cosPsi * cosPsi) /
    square;

  const sumOver: SeenFacets['sumOver'] = (nodes, one, other, add) => {
    const [rangeOne, rangeOther] = [range(one), range(other)];
    const first = Math.max(rangeOne[0], rangeOther[0]);
    const last = Math.min(rangeOne[1], rangeOther[1]);
    if (first >= last) return;
    for (const [place, across, amount] of nodes) {
      const s = first + (last - first) * place;
      const rest = Math.sqrt(Math.max(1 - s * s, 0));
      const [sinPsi, cosPsi] = [s * cosine + rest * sine, Math.max(rest * cosine - s * sine, 0)];
      const middle = -skew * sinPsi;
      const width = Math.sqrt(Math.max(Math.min(reach(one, sinPsi, cosPsi), reach(other, sinPsi, cosPsi)), 0));
      const bound = (tangent: number): number => tangent / length2(tangent, 1);
      const left = bound(middle - width);
      const right = bound(middle + width);
      const sinChi = left + (right - left) * across;
      const cosChi = Math.sqrt(Math.max(1 - sinChi * sinChi, 0));
      const weight = ((last - first) / (1 + cosine)) * (right - left) * (2 / Math.PI) * amount * cosChi;
      const facet: OpenPbrVector = [
        cosChi * sinPsi * p[0] + sinChi * q[0],
        cosChi * sinPsi * p[1] + sinChi * q[1],
        cosChi * cosPsi,
      ];
      const size = length3(...facet);
      add(weight, [facet[0] / size, facet[1] / size, facet[2] / size]);
    }
  };
  const sum: SeenFacets['sum'] = (count, ...rest) => sumOver(golden(count), ...rest);
  return { flat, upwards: [0, 2 / wo[2]], sum, sumOver };
}
