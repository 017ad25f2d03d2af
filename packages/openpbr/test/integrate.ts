import { gaussLegendre, interfaceAlbedo } from '../scripts/microfacet.mjs';
import {
  coatedBase,
  evalBsdf,
  evalPdfBsdf,
  ggxAlpha,
  ggxBound,
  ggxSample,
  prepareBsdf,
  type BsdfOptions,
  type Slopes,
} from '../src/cpu/index';
import { length3 } from '../src/cpu/vector';
import { resolveParameters, type OpenPbrParameters, type OpenPbrVector } from '../src/parameters/index';

/** A direction by cosine and azimuth. */
export function direction(mu: number, phi = 0.4): OpenPbrVector {
  const s = Math.sqrt(Math.max(0, 1 - mu * mu));
  return [s * Math.cos(phi), s * Math.sin(phi), mu];
}

const cache = new Map<number, { nodes: Float64Array; weights: Float64Array }>();
function rule(count: number) {
  const found = cache.get(count) ?? (gaussLegendre(count) as { nodes: Float64Array; weights: Float64Array });
  cache.set(count, found);
  return found;
}

/**
 * ∫ g(ω_i) dω_i over the upper hemisphere, split by multiple importance: where visible normals are dense, in their
 * measure (ggxSample over a product rule), for the base and for a coat; elsewhere over the hemisphere. Deterministic,
 * good for any roughness.
 */
export function integrateHemisphere(
  p: OpenPbrParameters,
  wo: OpenPbrVector,
  g: (wi: OpenPbrVector) => readonly number[],
  size = 64,
): number[] {
  const base = coatedBase(p);
  const slopes = [ggxAlpha(base.specular_roughness, base.specular_roughness_anisotropy)];
  if (p.specular_haze > 0) slopes.push(prepareBsdf(p, wo).haze.alpha);
  // Retroreflection turns the directions of the facets of the base.
  const returning = p.specular_retroreflectivity > 0 ? slopes.map(([x, y]): Slopes => [x, y]) : [];
  slopes.push(...returning);
  if (p.coat_weight > 0) slopes.push(ggxAlpha(p.coat_roughness, p.coat_roughness_anisotropy));
  // Facets that reflect downwards are no use.
  const bounds = new Map(slopes.map((alpha) => [alpha, ggxBound(alpha, wo)]));
  const turn = (alpha: Slopes, [x, y, z]: OpenPbrVector): OpenPbrVector =>
    returning.includes(alpha) ? [-x, -y, z] : [x, y, z];
  const density = (alpha: Slopes, given: OpenPbrVector): number => {
    const wi = turn(alpha, given);
    const h: [number, number, number] = [wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]];
    const length = length3(...h);
    const [x, y, z] = [h[0] / length, h[1] / length, h[2] / length];
    const t = (x / alpha[0]) ** 2 + (y / alpha[1]) ** 2 + z * z;
    return (
      1 /
      (2 *
        Math.PI *
        alpha[0] *
        alpha[1] *
        t *
        t *
        ((bounds.get(alpha) as number) * wo[2] + length3(alpha[0] * wo[0], alpha[1] * wo[1], wo[2])))
    );
  };
  const uniform = 1 / (2 * Math.PI);
  const total: number[] = [];
  // The balance heuristic of all samplers: each node's own density cancels.
  const add = (wi: OpenPbrVector, weight: number): void => {
    if (wi[2] <= 0) return;
    const scale = weight / slopes.reduce((sum, alpha) => sum + density(alpha, wi), uniform);
    g(wi).forEach((value, i) => (total[i] = (total[i] ?? 0) + value * scale));
  };
  const { nodes, weights } = rule(size);
  const around = 2 * size;
  for (let k = 0; k < size; k++) {
    for (let i = 0; i < around; i++) {
      const phi = (2 * Math.PI * (i + 0.5)) / around;
      // √ spreads nodes towards grazing.
      const mu = (nodes[k] as number) ** 2;
      const s = Math.sqrt(1 - mu * mu);
      add([s * Math.cos(phi), s * Math.sin(phi), mu], ((weights[k] as number) * 2 * (nodes[k] as number)) / around);
      for (const alpha of slopes) {
        const h = ggxSample(alpha, wo, [(i + 0.5) / around, nodes[k] as number], bounds.get(alpha));
        const c = 2 * (wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2]);
        add(turn(alpha, [c * h[0] - wo[0], c * h[1] - wo[1], c * h[2] - wo[2]]), (weights[k] as number) / around);
      }
    }
  }
  return total;
}

/** Directional albedo and the integral of the density, by quadrature. */
export function furnace(
  p: OpenPbrParameters,
  wo: OpenPbrVector,
  options?: BsdfOptions,
  size?: number,
): { albedo: [number, number, number]; pdf: number } {
  const b = prepareBsdf(p, wo, options);
  const both = (wi: OpenPbrVector): readonly number[] => {
    const { f, pdf } = evalPdfBsdf(b, wo, wi);
    return [f[0], f[1], f[2], pdf];
  };
  const [r, g, bl, pdf] = integrateHemisphere(p, wo, both, size) as [number, number, number, number];
  return { albedo: [r, g, bl], pdf };
}

/**
 * Directional albedo of an opaque dielectric of an index below 1 over Lambert. The facets' part as {@link furnace}; the
 * diffuse part, which knows no azimuth and has an edge at the critical angle, by nodes on either side of that.
 */
export function furnaceBelowOne(p: OpenPbrParameters, wo: OpenPbrVector, size = 40): number {
  const above = furnace({ ...p, base_weight: 0 }, wo, {}, size).albedo[1];
  const [whole, facets] = [prepareBsdf(p, wo), prepareBsdf({ ...p, base_weight: 0 }, wo)];
  const critical = Math.sqrt(1 - p.specular_ior ** 2);
  const { nodes, weights } = rule(256);
  let below = 0;
  const add = (mu: number, weight: number): void => {
    const wi = direction(mu, 2);
    below += 2 * Math.PI * weight * (evalBsdf(whole, wo, wi)[1] - evalBsdf(facets, wo, wi)[1]);
  };
  // Closer towards the edge.
  nodes.forEach((x, i) => {
    const weight = 2 * x * (weights[i] as number);
    add(critical * (1 - x * x), critical * weight);
    add(critical + (1 - critical) * x * x, (1 - critical) * weight);
  });
  return above + below;
}

const mirrors = interfaceAlbedo(160, 160);

/**
 * Directional albedo of white metal, good to 1e-4 however narrow and stretched its highlight: what single scattering
 * reflects by a quadrature of its own, which knows nothing of the tables, and the lobe of multiple scattering, which is
 * smooth, by nodes that follow the dip of masking.
 */
export function whiteMetal(roughness: number, anisotropy: number, wo: OpenPbrVector): number {
  const p = resolveParameters({
    base_metalness: 1,
    base_color: [1, 1, 1],
    specular_roughness: roughness,
    specular_roughness_anisotropy: anisotropy,
  });
  const [all, single] = [prepareBsdf(p, wo), prepareBsdf(p, wo, { multipleScattering: false })];
  const [ax, ay] = ggxAlpha(roughness, anisotropy);
  const { nodes, weights } = rule(40);
  const around = 24;
  let bounced = 0;
  nodes.forEach((t, k) => {
    const root = (t * roughness) / (1 + roughness - t);
    const step = (2 * root * roughness * (1 + roughness)) / (1 + roughness - t) ** 2;
    for (let i = 0; i < around; i++) {
      const wi = direction(root * root, ((i + 0.5) / around) * 2 * Math.PI);
      bounced +=
        (((weights[k] as number) * step * 2 * Math.PI) / around) *
        (evalBsdf(all, wo, wi)[1] - evalBsdf(single, wo, wi)[1]);
    }
  });
  return mirrors([ax, ay], 1.5, wo[2], Math.atan2(wo[1], wo[0])).mirror + bounced;
}

const interfaces = interfaceAlbedo(300, 300);

/**
 * Directional albedo of a white dielectric over Lambert, or of clear glass, good to 2e-4 however narrow and stretched
 * its highlight and from either side: what single scattering by its facets returns by a quadrature of its own, which
 * knows nothing of the tables and sums; and all the rest, which is smooth, as {@link whiteMetal}.
 */
export function whiteDielectric(p: OpenPbrParameters, wo: OpenPbrVector, inside = false): number {
  const [all, facets] = [
    prepareBsdf(p, wo, { inside }),
    prepareBsdf({ ...p, base_weight: 0 }, wo, { inside, multipleScattering: false }),
  ];
  const alpha = ggxAlpha(p.specular_roughness, p.specular_roughness_anisotropy);
  const { nodes, weights } = rule(40);
  const around = 24;
  let rest = 0;
  nodes.forEach((t, k) => {
    for (let i = 0; i < around; i++) {
      const phi = ((i + 0.5) / around) * 2 * Math.PI;
      for (const mu of p.transmission_weight > 0 ? [t * t, -t * t] : [t * t]) {
        const s = Math.sqrt(1 - mu * mu);
        const wi: OpenPbrVector = [s * Math.cos(phi), s * Math.sin(phi), mu];
        rest +=
          ((4 * Math.PI * t * (weights[k] as number)) / around) *
          (evalBsdf(all, wo, wi)[1] - evalBsdf(facets, wo, wi)[1]);
      }
    }
  });
  const { reflect, transmit } = interfaces(
    [...alpha],
    inside ? 1 / p.specular_ior : p.specular_ior,
    wo[2],
    Math.atan2(wo[1], wo[0]),
  );
  return reflect + p.transmission_weight * transmit + rest;
}
