/**
 * Linear ACEScg (primaries AP1, white D60) to linear Rec.709/sRGB (D65), adapted by Bradford's method. Colours outside
 * of the smaller gamut get negative components.
 */
const TO_REC709 = [
  [1.7050509926579, -0.6217921206574, -0.0832588720005],
  [-0.1302564175247, 1.1408047365754, -0.0105483190507],
  [-0.0240033568046, -0.1289689760649, 1.1529723328695],
] as const;

/** The inverse of {@link TO_REC709}. */
const FROM_REC709 = [
  [0.6130974024012, 0.3395231461841, 0.0473794514147],
  [0.0701937224696, 0.9163538790573, 0.0134523984731],
  [0.0206155928822, 0.1095697729381, 0.8698146341796],
] as const;

type Triple = readonly [number, number, number];

const times = (m: readonly [Triple, Triple, Triple], [r, g, b]: Triple): [number, number, number] => [
  m[0][0] * r + m[0][1] * g + m[0][2] * b,
  m[1][0] * r + m[1][1] * g + m[1][2] * b,
  m[2][0] * r + m[2][1] * g + m[2][2] * b,
];

/**
 * A colour of the specification's examples, which are in ACEScg, as the linear Rec.709 colour that this package takes.
 * May lie outside of 0..1.
 */
export function acescgToLinear(color: Triple): [number, number, number] {
  return times(TO_REC709, color);
}

/** The way back. */
export function linearToAcescg(color: Triple): [number, number, number] {
  return times(FROM_REC709, color);
}
