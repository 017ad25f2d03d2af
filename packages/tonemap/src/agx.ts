import { wgslModule } from '@glanz/wgsl';
import { finite, tonemapFinite } from './finite';
import { transform, wgslMatrix, type Matrix3 } from './matrix';
import type { Rgb } from './names';

// Troy Sobotka's AgX, base look, for linear Rec.709: "inset" the primaries towards grey, take log2, put each channel
// through a sigmoid, "outset". The published LUT is made from a closed form, and that form is used here: the usual
// polynomial fits of it miss black and are not monotone at the ends. Matrices by columns.
const INSET: Matrix3 = [
  0.842479062253094, 0.0423282422610123, 0.0423756549057051, 0.0784335999999992, 0.878468636469772, 0.0784336, 0.0792237451477643,
  0.0791661274605434, 0.879142973793104,
];
const OUTSET: Matrix3 = [
  1.19687900512017, -0.0528968517574562, -0.0529716355144438, -0.0980208811401368, 1.15190312990417, -0.0980434501171241, -0.0990297440797205,
  -0.0989611768448433, 1.15107367264116,
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
  const x = Math.min(Math.max((Math.log2(Math.max(value, 1e-10)) - LOWEST) / (BELOW + ABOVE), 0), 1) - PIVOT;
  if (x <= 0) return 0.5 + 2 * x * (1 + TOE * (-x) ** TOE_POWER) ** (-1 / TOE_POWER);
  return 0.5 + 2 * x * (1 + SHOULDER * x ** SHOULDER_POWER) ** (-1 / SHOULDER_POWER);
}

/** CPU twin of {@link tonemapAgx}. */
export function agxToneMap(rgb: Rgb): [number, number, number] {
  const [x, y, z] = transform(INSET, finite(rgb[0]), finite(rgb[1]), finite(rgb[2]));
  const [r, g, b] = transform(OUTSET, sigmoid(x), sigmoid(y), sigmoid(z));
  const decode = (code: number) => Math.min(Math.max(code, 0), 1) ** DISPLAY_POWER;
  return [decode(r), decode(g), decode(b)];
}
