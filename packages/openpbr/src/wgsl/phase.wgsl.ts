import { wgslModule } from '@glanz/wgsl';
import { openpbrCircle } from './circle.wgsl';

/**
 * Henyey and Greenstein's phase function, 1941, in any frame; directions are unit and point away from the place of
 * scattering, so g > 0 prefers `wi` = -`wo`. Sampling is exact: the weight is 1.
 *
 * ```wgsl
 * fn openpbr_phase_eval(g: f32, wo: vec3f, wi: vec3f) -> f32   // value and density, per solid angle
 * fn openpbr_phase_sample(g: f32, wo: vec3f, u: vec2f) -> vec3f // u uniform in [0, 1)²
 * ```
 */
export const openpbrPhase = wgslModule(
  'openpbr/phase',
  /* wgsl */ `fn openpbr_phase_eval(g: f32, wo: vec3f, wi: vec3f) -> f32 {
  // (1 - g)² + 2 g (1 - cos θ), with 1 - cos θ from the difference, exact for narrow lobes.
  let apart = wo + wi;
  let near = 1.0 - g;
  let d = near * near + g * dot(apart, apart);
  return 0.079577472 * (1.0 - g * g) / (d * sqrt(d));
}

fn openpbr_phase_sample(g: f32, wo: vec3f, u: vec2f) -> vec3f {
  // 1 - cos θ, without the division by g that fails near 0.
  let near = 1.0 - g;
  let t = near + 2.0 * g * (1.0 - u.y);
  let away = min(near * near * 2.0 * u.y * (1.0 + g * (1.0 - u.y)) / (t * t), 2.0);
  let s = sqrt(away * (2.0 - away));
  // Branch-free frame (Duff et al. 2017).
  let side = select(-1.0, 1.0, wo.z >= 0.0);
  let a = -1.0 / (side + wo.z);
  let b = wo.x * wo.y * a;
  let around = s * openpbr_circle(u.x);
  return around.x * vec3f(1.0 + side * wo.x * wo.x * a, side * b, -side * wo.x) + around.y * vec3f(b, side + wo.y * wo.y * a, -wo.y) + (away - 1.0) * wo;
}`,
  [openpbrCircle],
);
