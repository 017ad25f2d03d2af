import { acescgToLinear } from './acescg';

type Triple = readonly [number, number, number];

const power = (exponent: number) => (c: number) => Math.max(c, 0) ** exponent;
const srgb = (c: number) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
const rec709 = (c: number) => Math.max(c, 0) ** 2.4;

const displayP3 = ([r, g, b]: Triple): Triple => [
  1.2249401763 * r - 0.2249401763 * g,
  -0.0420569547 * r + 1.0420569547 * g,
  -0.0196375546 * r - 0.0786360456 * g + 1.0982736001 * b,
];
const adobeRgb = ([r, g, b]: Triple): Triple => [
  1.398355744 * r - 0.398355744 * g,
  g,
  -0.0429289893 * g + 1.0429289893 * b,
];

interface Space {
  readonly curve?: (code: number) => number;
  readonly primaries?: (color: Triple) => Triple;
  /** What the texels of an image in this space are, where that can be said. */
  readonly texture?: 'srgb' | 'linear';
}

/** MaterialX's colour spaces by name. */
const SPACES: Readonly<Record<string, Space>> = {
  lin_rec709: { texture: 'linear' },
  lin_srgb: { texture: 'linear' },
  lin_rec709_scene: { texture: 'linear' },
  raw: { texture: 'linear' },
  none: { texture: 'linear' },
  data: { texture: 'linear' },
  srgb_texture: { curve: srgb, texture: 'srgb' },
  srgb_rec709_scene: { curve: srgb, texture: 'srgb' },
  srgb_tx: { curve: srgb, texture: 'srgb' },
  sRGB: { curve: srgb, texture: 'srgb' },
  g18_rec709: { curve: power(1.8) },
  g22_rec709: { curve: power(2.2) },
  rec709_display: { curve: rec709 },
  acescg: { primaries: acescgToLinear },
  lin_ap1: { primaries: acescgToLinear },
  lin_ap1_scene: { primaries: acescgToLinear },
  g22_ap1: { curve: power(2.2), primaries: acescgToLinear },
  lin_displayp3: { primaries: displayP3 },
  lin_p3d65: { primaries: displayP3 },
  srgb_displayp3: { curve: srgb, primaries: displayP3 },
  lin_adobergb: { primaries: adobeRgb },
  adobergb: { curve: power(563 / 256), primaries: adobeRgb },
};

/** A colour in one of MaterialX's colour spaces as linear Rec.709; undefined for a space that is not known. */
export function toLinear(color: Triple, space: string): Triple | undefined {
  if (!Object.hasOwn(SPACES, space)) return undefined;
  const { curve, primaries } = SPACES[space] as Space;
  const linear = curve ? (color.map(curve) as unknown as Triple) : color;
  return primaries ? primaries(linear) : linear;
}

/**
 * How the texels of an image in a colour space are encoded; undefined where it is neither sRGB nor linear with Rec.709
 * primaries.
 */
export function textureEncoding(space: string): 'srgb' | 'linear' | undefined {
  return Object.hasOwn(SPACES, space) ? (SPACES[space] as Space).texture : undefined;
}
