import { wgslModule } from '@glanz/wgsl';
import { frameStruct } from './layout';

/** Streams beyond this are for vertices whose neighbours in the picture have little in common. */
export const SCREEN_NOISE_STREAMS = 2;

/**
 * Digital shifts from pixel to pixel that give the error of a picture a blue spectrum, at every power of two of samples.
 *
 * Pixels are numbered along a Z curve, whose levels are shuffled anew for each pair of numbers (as in Ahmed and Wonka 2020,
 * "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels"). They cut one Sobol
 * sequence into pieces, a pixel each, so the number of samples must be known beforehand. Here sample s of pixel m is
 * A s ⊕ B m over the field of two elements, so that the first 2^a samples of each block of 2^k × 2^k pixels together make a
 * (0, a + 2k, 2)-net, for every a and k: no elementary interval has a point too many or too few, whatever the number of
 * samples; and those of each pixel make one by themselves.
 *
 * Why: bits of s are the coefficients of poles of a rational function at z = 0, those of m at the two roots of z² + z + 1, a
 * digit of two bits for each order. x is its expansion at infinity, y that at z = 1. A function with poles of order a and k
 * that vanishes to the orders r and a + 2k − r has more zeros than poles, so it is 0, and different (s, m) differ in these
 * digits (the construction of Niederreiter and Özbudak 2002 on the projective line). The shifts are its expansions
 * for m, with the two bits of digit j as an element c of the field of four elements, α being a root: Σ c_j / (z + α)^j plus
 * its conjugate is Tr(α^i Σ C(i, j) c_j) at infinity and, with α^(2j) c_j for c_j, Tr(α^(i + 1) Σ C(i + j, i) c_j) at 1.
 *
 * - `fn screen_noise_begin(pixel: u32, stream: u32)` sets `screen_noise_on` and `screen_noise_place`, the number of the pixel
 *   with its bits in reverse.
 * - `fn screen_noise_2(place: u32) -> vec2u`: the shifts of a pair, first digit in bit 0; `place` likewise in reverse.
 *
 * Wants `random_pascal` and `frame.size`.
 */
export const screenNoise = wgslModule(
  'renderer/screen-noise',
  /* wgsl */ `
var<private> screen_noise_on: bool;
var<private> screen_noise_place: u32;

// The bits in every other place, from bit 0 on.
fn screen_noise_spread(bits: u32) -> u32 {
  var x = bits & 0xffffu;
  x = (x | (x << 8u)) & 0x00ff00ffu;
  x = (x | (x << 4u)) & 0x0f0f0f0fu;
  x = (x | (x << 2u)) & 0x33333333u;
  return (x | (x << 1u)) & 0x55555555u;
}

fn screen_noise_gather(bits: u32) -> u32 {
  var x = bits & 0x55555555u;
  x = (x | (x >> 1u)) & 0x33333333u;
  x = (x | (x >> 2u)) & 0x0f0f0f0fu;
  x = (x | (x >> 4u)) & 0x00ff00ffu;
  return (x | (x >> 8u)) & 0xffffu;
}

fn screen_noise_begin(pixel: u32, stream: u32) {
  screen_noise_on = stream <= ${SCREEN_NOISE_STREAMS}u;
  if (screen_noise_on) {
    let row = pixel / frame.size.x;
    screen_noise_place = reverseBits(screen_noise_spread(pixel - row * frame.size.x) | (screen_noise_spread(row) << 1u));
  }
}

// Bits whose number is 0, 1, 2 modulo 3.
const SCREEN_NOISE_0 = 0x49249249u;
const SCREEN_NOISE_1 = 0x92492492u;
const SCREEN_NOISE_2 = 0x24924924u;

fn screen_noise_2(place: u32) -> vec2u {
  let number = reverseBits(place);
  // Digit j is bit j of a and, times α, bit j of b; α² = α + 1, Tr(a + α b) = b.
  let a = screen_noise_gather(number);
  let b = screen_noise_gather(number >> 1u);
  let x = (random_pascal(a) & (SCREEN_NOISE_1 | SCREEN_NOISE_2)) ^ (random_pascal(b) & (SCREEN_NOISE_0 | SCREEN_NOISE_1));
  // Times α^(2j).
  let both = a ^ b;
  let a2 = (a & SCREEN_NOISE_0) | (both & SCREEN_NOISE_1) | (b & SCREEN_NOISE_2);
  let b2 = (b & SCREEN_NOISE_0) | (a & SCREEN_NOISE_1) | (both & SCREEN_NOISE_2);
  let y = (random_pascal(a2) & (SCREEN_NOISE_0 | SCREEN_NOISE_1)) ^ (random_pascal(b2) & (SCREEN_NOISE_1 | SCREEN_NOISE_2));
  return vec2u(x, reverseBits(y));
}
`,
  [frameStruct.module],
);
