import { gaussLegendre } from '../scripts/microfacet.mjs';
import {
  evalPdfBsdf,
  ggxBound,
  ggxDistribution,
  ggxSample,
  prepareBsdf,
  refract,
  refractGgx,
  refractHalf,
  sampleBsdf,
  SPIKE,
  type Bsdf,
  type BsdfOptions,
  type Slopes,
} from '../src/cpu/index';
import { length3 } from '../src/cpu/vector';
import type { OpenPbrParameters, OpenPbrVector } from '../src/parameters/index';

/** Reflected and transmitted parts of uniform light, and the integral of the density over the sphere. */
export interface SphereFurnace {
  readonly reflected: [number, number, number];
  readonly transmitted: [number, number, number];
  readonly pdf: number;
}

const cache = new Map<number, { nodes: Float64Array; weights: Float64Array }>();
function rule(count: number): { nodes: Float64Array; weights: Float64Array } {
  const found = cache.get(count) ?? gaussLegendre(count);
  cache.set(count, found);
  return found;
}

/** A way to choose directions, whose density is known. */
interface Technique {
  readonly at: (u: number, v: number) => OpenPbrVector | undefined;
  readonly density: (wi: OpenPbrVector) => number;
}

/** Steep facets refract upwards, where the density knows nothing of it. */
const lower = (wi: OpenPbrVector | undefined): OpenPbrVector | undefined => (wi && wi[2] < 0 ? wi : undefined);
const flip = ([x, y, z]: OpenPbrVector): OpenPbrVector => [x, y, -z];
function turned(w: OpenPbrVector): OpenPbrVector;
function turned(w: OpenPbrVector | undefined): OpenPbrVector | undefined;
function turned(w: OpenPbrVector | undefined): OpenPbrVector | undefined {
  return w && [-w[0], -w[1], w[2]];
}

function reflection(alpha: Slopes, wo: OpenPbrVector, side: 1 | -1): Technique {
  const bound = ggxBound(alpha, wo);
  const turn = side > 0 ? (w: OpenPbrVector) => w : flip;
  return {
    at: (u, v) => {
      const h = ggxSample(alpha, wo, [u, v], bound);
      const c = 2 * (wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2]);
      return c * h[2] > wo[2] ? turn([c * h[0] - wo[0], c * h[1] - wo[1], c * h[2] - wo[2]]) : undefined;
    },
    density: (wi) => {
      const up = turn(wi);
      const h: [number, number, number] = [wo[0] + up[0], wo[1] + up[1], wo[2] + up[2]];
      const length = length3(...h);
      return up[2] <= 0
        ? 0
        : ggxDistribution(alpha, [h[0] / length, h[1] / length, h[2] / length]) /
            (2 * (bound * wo[2] + length3(alpha[0] * wo[0], alpha[1] * wo[1], wo[2])));
    },
  };
}

/**
 * Integrals over the whole sphere by deterministic quadrature of the balance heuristic: every lobe's own facets, and
 * the sphere evenly.
 */
export function sphereFurnace(
  p: OpenPbrParameters,
  wo: OpenPbrVector,
  options?: BsdfOptions,
  size = 40,
): SphereFurnace {
  const b = prepareBsdf(p, wo, options);
  const { thin, thinAlpha, eta } = b.transmission;
  const techniques: Technique[] = [reflection(b.alpha, wo, 1)];
  if (b.haze.weight > 0) techniques.push(reflection(b.haze.alpha, wo, 1));
  if (b.retroreflectivity > 0)
    techniques.push(
      ...techniques.map((forward) => ({
        at: (u: number, v: number) => turned(forward.at(u, v)),
        density: (wi: OpenPbrVector) => forward.density(turned(wi)),
      })),
    );
  if (p.coat_weight > 0) techniques.push(reflection(b.coat.alpha, wo, 1));
  const refraction = (alpha: Slopes): Technique => ({
    at: (u, v) => lower(refract(eta, wo, ggxSample(alpha, wo, [u, v]))),
    density: (wi) => (wi[2] < 0 ? refractGgx(eta, alpha, wo, wi, refractHalf(eta, wo, wi))[1] : 0),
  });
  techniques.push(thin ? reflection(thinAlpha, wo, -1) : refraction(b.alpha));
  if (b.haze.weight > 0) techniques.push(thin ? reflection(b.haze.alpha, wo, -1) : refraction(b.haze.alpha));
  techniques.push({
    at: (u, v) => {
      // √ spreads nodes towards grazing.
      const mu = Math.abs(2 * v - 1) ** 2;
      const s = Math.sqrt(1 - mu * mu);
      return [s * Math.cos(2 * Math.PI * u), s * Math.sin(2 * Math.PI * u), v < 0.5 ? -mu : mu];
    },
    density: (wi) => 1 / (8 * Math.PI * Math.sqrt(Math.abs(wi[2]))),
  });
  return integrate(b, wo, techniques, size);
}

/**
 * Reflected and transmitted parts by delta lobes, which quadrature cannot see: of samples that choose lobes evenly. A
 * tenth of them finds each lobe that is chosen for 1 in 2,000 or more; where it finds none, the parts are zero.
 */
export function deltaParts(
  p: OpenPbrParameters,
  wo: OpenPbrVector,
  options?: BsdfOptions,
): Pick<SphereFurnace, 'reflected' | 'transmitted'> {
  const b = prepareBsdf(p, wo, options);
  const partsOf = (count: number) => {
    let found = false;
    const parts = {
      reflected: [0, 0, 0] as [number, number, number],
      transmitted: [0, 0, 0] as [number, number, number],
    };
    for (let i = 0; i < count; i++) {
      const s = sampleBsdf(b, wo, [0.5, 0.5, (i + 0.5) / count]);
      if (s.pdf < 1e-9 * SPIKE) continue;
      found = true;
      const part = s.wi[2] > 0 ? parts.reflected : parts.transmitted;
      for (const k of [0, 1, 2] as const) part[k] += s.weight[k] / count;
    }
    return { parts, found };
  };
  const few = partsOf(2000);
  return few.found ? partsOf(20_000).parts : few.parts;
}

function integrate(b: Bsdf, wo: OpenPbrVector, techniques: readonly Technique[], size: number): SphereFurnace {
  const total = [0, 0, 0, 0, 0, 0, 0];
  const { nodes, weights } = rule(size);
  const around = 2 * size;
  for (const technique of techniques) {
    // The even technique has a kink in the middle: a rule for each half.
    const halves = technique === techniques.at(-1) ? [0, 0.5] : [0];
    for (const start of halves) {
      for (let k = 0; k < size; k++) {
        for (let i = 0; i < around; i++) {
          const wi = technique.at((i + 0.5) / around, start + (nodes[k] as number) / halves.length);
          if (!wi || wi[2] === 0) continue;
          const density = techniques.reduce((sum, one) => sum + one.density(wi), 0);
          if (!(density > 0)) continue;
          const weight = (weights[k] as number) / halves.length / around / density;
          const { f, pdf } = evalPdfBsdf(b, wo, wi);
          const at = wi[2] > 0 ? 0 : 3;
          f.forEach((value, channel) => (total[at + channel] = (total[at + channel] as number) + value * weight));
          total[6] = (total[6] as number) + pdf * weight;
        }
      }
    }
  }
  const [r0 = 0, r1 = 0, r2 = 0, t0 = 0, t1 = 0, t2 = 0, pdf = 0] = total;
  return { reflected: [r0, r1, r2], transmitted: [t0, t1, t2], pdf };
}
