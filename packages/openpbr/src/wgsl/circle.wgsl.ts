import { wgslModule } from '@glanz/wgsl';

/**
 * `openpbr_circle(u)`: (cos 2πu, sin 2πu) for u in [0, 1], to single precision on every device. WGSL's own functions may be
 * off by 2⁻¹¹, which some drivers make use of: sampled directions would then not be those of the density.
 */
export const openpbrCircle = wgslModule(
  'openpbr/circle',
  /* wgsl */ `fn openpbr_circle(u: f32) -> vec2f {
  let quarter = round(4.0 * u);
  let x = (u - 0.25 * quarter) * 6.2831853;
  let x2 = x * x;
  let c = 1.0 + x2 * (-0.5 + x2 * (0.041666667 + x2 * (-0.0013888889 + x2 * 0.000024801587)));
  let s = x * (1.0 + x2 * (-0.16666667 + x2 * (0.0083333333 + x2 * (-0.0001984127 + x2 * 0.0000027557319))));
  let turned = select(vec2f(c, s), vec2f(-s, c), (u32(quarter) & 1u) == 1u);
  return select(turned, -turned, (u32(quarter) & 2u) == 2u);
}`,
);
