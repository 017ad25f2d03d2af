import { wgslModule } from '@glanz/wgsl/module';
import { finite, mapRgb, saturate, tonemapFinite } from './finite';
import { transform, wgslMatrix, type Matrix3 } from './matrix';
import type { Rgb } from './names';

// Troy Sobotka's AgX, base look, for linear Rec.709: "inset" the primaries towards grey, take log2, put each channel
// through a sigmoid, "outset". The published LUT is made from a closed form, and that form is used here: the usual
// polynomial fits of it miss black and are not monotone at the ends. Matrices by columns.
const INSET: Matrix3 = [
  0.842479062, 0.042328242, 0.042375655, 0.0784336, 0.878468636, 0.0784336, 0.079223745, 0.079166127, 0.879142974,
];
const OUTSET: Matrix3 = [
  1.196879005, -0.052896852, -0.052971636, -0.098020881, 1.15190313, -0.09804345, -0.099029744, -0.098961177,
  1.151073673,
];
/** Stops below and above middle grey (0.18) that the curve covers. */
const BELOW = 10;
const ABOVE = 6.5;
const LOWEST = Math.log2(0.18) - BELOW;
/** Middle grey on the normalised log axis; the sigmoid brings it to 0.5 with slope 2. */
const PIVOT = BELOW / (BELOW + ABOVE);
const TOE_POWER = 3;
const SHOULDER_POWER = 3.25;
/** Such that the curve of slope 2 through (pivot, 0.5) ends at exactly 0 and 1. */
const bend = (length: number, power: number) => ((4 * length) ** power - 1) / length ** power;
const TOE = bend(PIVOT, TOE_POWER);
const SHOULDER = bend(1 - PIVOT, SHOULDER_POWER);
/** AgX's codes are meant for a display of pure power 2.2. */
const DISPLAY_POWER = 2.2;

/**
 * WGSL `fn tonemap_agx(linear: vec3f) -> vec3f`: AgX by Troy Sobotka (github.com/sobotka/AgX), base look. The codes of
 * AgX are decoded with the power 2.2 they were made for, so the result is linear like that of the other transforms.
 */
export const tonemapAgx = wgslModule(
  'tonemap/agx',
  /* wgsl */ `fn tonemap_agx(linear: vec3f) -> vec3f {
  let inset = ${wgslMatrix(INSET)} * tonemap_finite(linear);
  let x = clamp((log2(max(inset, vec3f(1e-10))) - ${LOWEST}) * ${1 / (BELOW + ABOVE)}, vec3f(0.0), vec3f(1.0)) - ${PIVOT};
  let a = abs(x);
  let toe = pow(1.0 + ${TOE} * a * a * a, vec3f(${-1 / TOE_POWER}));
  let shoulder = pow(1.0 + ${SHOULDER} * pow(a, vec3f(${SHOULDER_POWER})), vec3f(${-1 / SHOULDER_POWER}));
  let code = 0.5 + 2.0 * x * select(toe, shoulder, x > vec3f(0.0));
  return pow(clamp(${wgslMatrix(OUTSET)} * code, vec3f(0.0), vec3f(1.0)), vec3f(${DISPLAY_POWER}));
}`,
  [tonemapFinite],
);

function sigmoid(value: number): number {
  const x = saturate((Math.log2(Math.max(value, 1e-10)) - LOWEST) / (BELOW + ABOVE)) - PIVOT;
  if (x <= 0) return 0.5 + 2 * x * (1 + TOE * (-x) ** TOE_POWER) ** (-1 / TOE_POWER);
  return 0.5 + 2 * x * (1 + SHOULDER * x ** SHOULDER_POWER) ** (-1 / SHOULDER_POWER);
}

/** CPU twin of {@link tonemapAgx}. */
export function agxToneMap(rgb: Rgb): [number, number, number] {
  return mapRgb(
    transform(OUTSET, mapRgb(transform(INSET, finite(rgb)), sigmoid)),
    (code) => saturate(code) ** DISPLAY_POWER,
  );
}
