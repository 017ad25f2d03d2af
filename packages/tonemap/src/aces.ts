import { wgslModule } from '@glanz/wgsl/module';
import { finite, mapRgb, saturate, tonemapFinite } from './finite';
import { transform, wgslMatrix, type Matrix3 } from './matrix';
import type { Rgb } from './names';

// Stephen Hill's fit of the ACES 1.0 reference rendering transform and the sRGB output transform, published in the
// BakingLab sample of Pettineo and Neubelt (2016). Input: Rec.709 → XYZ → D65 to D60 → AP1 → RRT saturation, as one
// matrix; output: ODT saturation → XYZ → D60 to D65 → Rec.709. The matrices are stored by columns.
const INPUT: Matrix3 = [0.59719, 0.076, 0.0284, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777];
const OUTPUT: Matrix3 = [1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602];

/**
 * WGSL `fn tonemap_aces(linear: vec3f) -> vec3f`: ACES filmic look, RRT and sRGB ODT as fitted by Stephen Hill, with
 * its input and output matrices. No exposure bias is added: as in ACES itself, 18 % grey maps to about 0.1.
 */
export const tonemapAces = wgslModule(
  'tonemap/aces',
  /* wgsl */ `fn tonemap_aces(linear: vec3f) -> vec3f {
  let v = ${wgslMatrix(INPUT)} * tonemap_finite(linear);
  let fit = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.432951) + 0.238081);
  return clamp(${wgslMatrix(OUTPUT)} * fit, vec3f(0.0), vec3f(1.0));
}`,
  [tonemapFinite],
);

const fit = (v: number) => (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.432951) + 0.238081);

/** CPU twin of {@link tonemapAces}. */
export function acesToneMap(rgb: Rgb): [number, number, number] {
  return mapRgb(transform(OUTPUT, mapRgb(transform(INPUT, finite(rgb)), fit)), saturate);
}
