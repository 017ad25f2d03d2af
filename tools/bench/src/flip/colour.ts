// Colour spaces of ꟻLIP, all relative to D65 as the white of linear Rec.709.
type Triple = readonly [number, number, number];

/** Rows: X, Y, Z of linear Rec.709 red, green and blue. */
const TO_XYZ: readonly Triple[] = [
  [10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
  [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
  [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382],
];
const WHITE = TO_XYZ.map(([r, g, b]) => r + g + b) as unknown as Triple;

function invert(m: readonly Triple[]): Triple[] {
  const [[a, b, c], [d, e, f], [g, h, i]] = m as [Triple, Triple, Triple];
  const determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
  return [
    [(e * i - f * h) / determinant, (c * h - b * i) / determinant, (b * f - c * e) / determinant],
    [(f * g - d * i) / determinant, (a * i - c * g) / determinant, (c * d - a * f) / determinant],
    [(d * h - e * g) / determinant, (b * g - a * h) / determinant, (a * e - b * d) / determinant],
  ];
}

const FROM_XYZ = invert(TO_XYZ);
const row = ([a, b, c]: Triple, x: number, y: number, z: number) => a * x + b * y + c * z;

/** sRGB code 0..1 to linear. */
export const srgbToLinear = (s: number) => (s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4);

/** XYZ over that of white. */
export function linearToXyz(r: number, g: number, b: number): [number, number, number] {
  return [
    row(TO_XYZ[0]!, r, g, b) / WHITE[0],
    row(TO_XYZ[1]!, r, g, b) / WHITE[1],
    row(TO_XYZ[2]!, r, g, b) / WHITE[2],
  ];
}

/** The inverse of {@link linearToXyz}. */
export function xyzToLinear(x: number, y: number, z: number): [number, number, number] {
  const [X, Y, Z] = [x * WHITE[0], y * WHITE[1], z * WHITE[2]];
  return [row(FROM_XYZ[0]!, X, Y, Z), row(FROM_XYZ[1]!, X, Y, Z), row(FROM_XYZ[2]!, X, Y, Z)];
}

/** The linear opponent space in which contrast sensitivity was measured: achromatic, red–green, blue–yellow. */
export function linearToYcxcz(r: number, g: number, b: number): [number, number, number] {
  const [x, y, z] = linearToXyz(r, g, b);
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

/** The inverse of {@link linearToYcxcz}. */
export function ycxczToLinear(yy: number, cx: number, cz: number): [number, number, number] {
  const y = (yy + 16) / 116;
  return xyzToLinear(y + cx / 500, y, y - cz / 200);
}

const DELTA = 6 / 29;
const cubeRoot = (t: number) => (t > DELTA ** 3 ? Math.cbrt(t) : t / (3 * DELTA * DELTA) + 4 / 29);

/** CIELAB with Hunt's adjustment: colours count less where it is dark. */
export function linearToHuntLab(r: number, g: number, b: number): [number, number, number] {
  const [x, y, z] = linearToXyz(r, g, b);
  const [fx, fy, fz] = [cubeRoot(x), cubeRoot(y), cubeRoot(z)];
  const L = 116 * fy - 16;
  return [L, 0.01 * L * 500 * (fx - fy), 0.01 * L * 200 * (fy - fz)];
}
