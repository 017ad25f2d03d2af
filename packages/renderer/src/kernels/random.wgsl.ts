import { gated, wgslModule } from '@glanz/wgsl';
import { screenNoise } from './screen-noise.wgsl';

/**
 * Random numbers named by pixel, sample and purpose, so a sample's numbers do not depend on the size of the batch it was
 * computed in. Three samplers:
 *
 * - SOBOL: pairs of two digital sequences that make a (0, 2)-sequence, shuffled and Owen-scrambled anew for each pixel and
 *   purpose (Burley 2020, "Practical Hash-based Owen Scrambling"; the hash of Vegdahl 2021, "Building a Better LK Hash"). The
 *   samples of a pixel spread evenly in each pair, which takes noise away; each number by itself is uniform, so nothing is
 *   biased. The second sequence is the symmetric Pascal matrix modulo 2, C(i + j, i), the lower triangular times the upper one,
 *   which is Sobol's: scrambled, they cannot be told apart.
 * - SOBOL and SCREEN_NOISE: the same, shuffled and scrambled alike for all pixels, and shifted from one to the next so that
 *   the samples of neighbouring pixels spread evenly too, see `screenNoise`.
 * - otherwise independent numbers: seeded by pcg4d, continued by PCG-RXS-M-XS (Jarzynski and Olano 2020, "Hash Functions for
 *   GPU Rendering").
 *
 * `fn random_begin(pixel, sample, stream, seed)` comes first; `fn random_next() -> f32`, `fn random_2() -> vec2f` and
 * `fn random_3() -> vec3f` give numbers in [0, 1), `fn random_fresh() -> f32` one that is spread in no way, for what is left
 * of another number after it has decided between thousands.
 */
export const random = wgslModule(
  'renderer/random',
  /* wgsl */ `
fn random_pcg4d(seed: vec4u) -> vec4u {
  var v = seed * 1664525u + 1013904223u;
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  v ^= v >> vec4u(16u);
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  return v;
}

// In [0, 1), 24 bits.
fn random_unit(bits: u32) -> f32 { return f32(bits >> 8u) * 5.9604644775390625e-8; }

//#if SOBOL
var<private> random_key: vec3u;
var<private> random_sample: u32;
var<private> random_dimension: u32;
// Numbers out of turn: those in turn keep their dimensions.
var<private> random_extra: u32;
//#if SCREEN_NOISE
var<private> random_pixel: u32;
//#endif

fn random_begin(pixel: u32, sample: u32, stream: u32, seed: u32) {
  random_key = vec3u(pixel, stream, seed);
  random_sample = sample;
  random_dimension = 0u;
  random_extra = 0x80000000u;
  //#if SCREEN_NOISE
  random_pixel = pixel;
  screen_noise_begin(pixel, stream);
  if (screen_noise_on) { random_key.x = 0xffffffffu; }
  //#endif
}

// Owen scrambling of a number whose bits are in reverse.
fn random_scramble(reversed: u32, seed: u32) -> u32 {
  var x = reversed;
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16u) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// The lower triangular Pascal matrix modulo 2: bit i of the result is the sum of the bits whose number is part of i.
fn random_pascal(bits: u32) -> u32 {
  var x = bits;
  x ^= x << 16u;
  x ^= (x & 0x00ff00ffu) << 8u;
  x ^= (x & 0x0f0f0f0fu) << 4u;
  x ^= (x & 0x33333333u) << 2u;
  x ^= (x & 0x55555555u) << 1u;
  return x;
}

fn random_2() -> vec2f {
  let seeds = random_pcg4d(vec4u(random_key, random_dimension));
  random_dimension++;
  var first = reverseBits(random_scramble(reverseBits(random_sample), seeds.x));
  // C(i + j, i) is odd where i and j have no bit in common: where j is part of what i lacks.
  var second = reverseBits(random_pascal(first));
  //#if SCREEN_NOISE
  if (screen_noise_on) {
    let shift = screen_noise_2(random_scramble(screen_noise_place, seeds.w));
    first ^= shift.x;
    second ^= shift.y;
  }
  //#endif
  return vec2f(random_unit(reverseBits(random_scramble(first, seeds.y))), random_unit(reverseBits(random_scramble(second, seeds.z))));
}

fn random_next() -> f32 {
  let seeds = random_pcg4d(vec4u(random_key, random_dimension));
  random_dimension++;
  var index = reverseBits(random_scramble(reverseBits(random_sample), seeds.x));
  //#if SCREEN_NOISE
  if (screen_noise_on) { index ^= random_pascal(reverseBits(random_scramble(screen_noise_place, seeds.w))); }
  //#endif
  return random_unit(reverseBits(random_scramble(index, seeds.y)));
}

fn random_fresh() -> f32 {
  var key = random_key;
  //#if SCREEN_NOISE
  key.x = random_pixel;
  //#endif
  let hash = random_pcg4d(vec4u(key, random_extra));
  random_extra++;
  return random_unit(random_pcg4d(hash ^ vec4u(random_sample, 0u, 0u, 0u)).x);
}
//#else
var<private> random_state: u32;

fn random_begin(pixel: u32, sample: u32, stream: u32, seed: u32) {
  random_state = random_pcg4d(vec4u(pixel, sample, stream, seed)).w;
}

fn random_next() -> f32 {
  let state = random_state;
  random_state = state * 747796405u + 2891336453u;
  let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return random_unit((word >> 22u) ^ word);
}

fn random_fresh() -> f32 { return random_next(); }

fn random_2() -> vec2f {
  let x = random_next();
  return vec2f(x, random_next());
}
//#endif

fn random_3() -> vec3f {
  let xy = random_2();
  return vec3f(xy, random_next());
}
`,
  [gated('SCREEN_NOISE', screenNoise)],
);
