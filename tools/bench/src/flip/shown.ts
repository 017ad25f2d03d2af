/** A linear value as sRGB shows it without a tone map, 0 to 1. */
export function shownValue(linear: number): number {
  const v = Math.min(Math.max(linear, 0), 1);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
}

/** Linear RGBA as sRGB shows it, in 8 bits: RGB from 0 to 255. */
export function shownBytes(rgba: Float32Array): Uint8Array {
  const out = new Uint8Array((rgba.length / 4) * 3);
  for (let i = 0; i < out.length; i++) out[i] = Math.round(255 * shownValue(rgba[4 * Math.floor(i / 3) + (i % 3)]!));
  return out;
}

/** The same from 0 to 1, as images are compared. */
export const shownImage = (rgba: Float32Array): Float32Array =>
  Float32Array.from(shownBytes(rgba), (value) => value / 255);
