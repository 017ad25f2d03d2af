import { wgslModule } from '@glanz/wgsl';

/**
 * Random numbers named by pixel, sample and purpose, so a sample's numbers do not depend on the size of the batch it was
 * computed in. Two samplers:
 *
 * - SOBOL: pairs of the first two Sobol dimensions, shuffled and Owen-scrambled anew for each pixel and purpose (Burley 2020,
 *   "Practical Hash-based Owen Scrambling"; the hash of Vegdahl 2021, "Building a Better LK Hash"). The samples of a pixel
 *   spread evenly in each pair, which takes noise away; each number by itself is uniform, so nothing is biased.
 * - otherwise independent numbers: seeded by pcg4d, continued by PCG-RXS-M-XS (Jarzynski and Olano 2020, "Hash Functions for
 *   GPU Rendering").
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

fn random_begin(pixel: u32, sample: u32, stream: u32, seed: u32) {
  random_key = vec3u(pixel, stream, seed);
  random_sample = sample;
  random_dimension = 0u;
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

fn random_2() -> vec2f {
  let seeds = random_pcg4d(vec4u(random_key, random_dimension));
  random_dimension++;
  let index = reverseBits(random_scramble(reverseBits(random_sample), seeds.x));
  // The second dimension's matrix is Pascal's triangle modulo 2: five steps for all 32 bits (reversed).
  var second = index;
  second ^= second >> 16u;
  second ^= (second & 0xff00ff00u) >> 8u;
  second ^= (second & 0xf0f0f0f0u) >> 4u;
  second ^= (second & 0xccccccccu) >> 2u;
  second ^= (second & 0xaaaaaaaau) >> 1u;
  return vec2f(random_unit(reverseBits(random_scramble(index, seeds.y))), random_unit(reverseBits(random_scramble(second, seeds.z))));
}

fn random_next() -> f32 {
  let seeds = random_pcg4d(vec4u(random_key, random_dimension));
  random_dimension++;
  let index = reverseBits(random_scramble(reverseBits(random_sample), seeds.x));
  return random_unit(reverseBits(random_scramble(index, seeds.y)));
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
);
