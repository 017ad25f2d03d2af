import { wgslModule } from '@glanz/wgsl';

/**
 * Counter-based random numbers: a stream is named by pixel, sample and purpose, so a sample's numbers do not depend on
 * the size of the batch it was computed in. Seeded by pcg4d, continued by PCG-RXS-M-XS (Jarzynski and Olano, "Hash
 * Functions for GPU Rendering", JCGT 2020).
 */
export const random = wgslModule(
  'renderer/random',
  /* wgsl */ `
var<private> random_state: u32;

fn random_pcg4d(seed: vec4u) -> vec4u {
  var v = seed * 1664525u + 1013904223u;
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  v ^= v >> vec4u(16u);
  v.x += v.y * v.w; v.y += v.z * v.x; v.z += v.x * v.y; v.w += v.y * v.z;
  return v;
}

fn random_begin(pixel: u32, sample: u32, stream: u32, seed: u32) {
  random_state = random_pcg4d(vec4u(pixel, sample, stream, seed)).w;
}

// In [0, 1), 24 bits.
fn random_next() -> f32 {
  let state = random_state;
  random_state = state * 747796405u + 2891336453u;
  let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return f32(((word >> 22u) ^ word) >> 8u) * 5.9604644775390625e-8;
}

fn random_2() -> vec2f {
  let x = random_next();
  return vec2f(x, random_next());
}

fn random_3() -> vec3f {
  let xy = random_2();
  return vec3f(xy, random_next());
}
`,
);
