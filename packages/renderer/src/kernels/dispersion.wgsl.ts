import { wgslModule } from '@glanz/wgsl';
import random from './random.wesl';

/**
 * Dispersion: a path that meets a surface whose index of refraction varies with the wavelength draws one wavelength and
 * keeps it. Red, green and blue are what three receptors see of a spectrum, and a picture in one wavelength counts for each
 * as much as its receptor answers to it. The wavelength is drawn as the receptors answer, each as often as its colour is
 * left in the path ("hero wavelength", Wilkie et al. 2014; the balance heuristic over the three), so the sum of the
 * channels stays what it was: no path gets brighter, and on average white stays white.
 *
 * The receptors: the positive parts of sRGB's colour matching curves (CIE 1931, 2°), each fitted by a logistic density, red
 * by two; negative parts would put negative light into the film. Between 380 and 780 nm; each integrates to 1.
 */
export const dispersion = /* @__PURE__ */ wgslModule(
  'renderer/dispersion',
  /* wgsl */ `
// Middle and width of a lobe in nm, the distribution up to 380 nm, and between there and 780 nm.
const DISPERSION_RED = vec4f(607.3, 16.6, 1.130589e-6, 0.99996855);
const DISPERSION_VIOLET = vec4f(439.0, 7.0, 2.184857e-4, 0.99978151);
const DISPERSION_GREEN = vec4f(539.5, 18.3, 1.639399e-4, 0.99983410);
const DISPERSION_BLUE = vec4f(451.8, 13.8, 5.470506e-3, 0.99452949);
// Part of red's answer that is violet.
const DISPERSION_VIOLET_SHARE = 0.042;

fn dispersion_lobe(lobe: vec4f, wavelength: f32) -> f32 {
  let e = exp(-abs(wavelength - lobe.x) / lobe.y);
  return e / (lobe.y * lobe.w * (1.0 + e) * (1.0 + e));
}

// How much each receptor answers to a wavelength, per nm.
fn dispersion_response(wavelength: f32) -> vec3f {
  let red = mix(dispersion_lobe(DISPERSION_RED, wavelength), dispersion_lobe(DISPERSION_VIOLET, wavelength), DISPERSION_VIOLET_SHARE);
  return vec3f(red, dispersion_lobe(DISPERSION_GREEN, wavelength), dispersion_lobe(DISPERSION_BLUE, wavelength));
}

struct DispersionSample {
  // Nanometres.
  wavelength: f32,
  // What the path carries from here on.
  throughput: vec3f,
}

fn dispersion_sample(pixel: u32, sample: u32, throughput: vec3f) -> DispersionSample {
  random_begin(pixel, sample, 0xffffffffu, frame.seed);
  let share = throughput / max(throughput.x + throughput.y + throughput.z, 1e-37);
  var u = random_next();
  var lobe = DISPERSION_BLUE;
  if (u < share.x) {
    u /= share.x;
    lobe = DISPERSION_RED;
    if (u < DISPERSION_VIOLET_SHARE) {
      u /= DISPERSION_VIOLET_SHARE;
      lobe = DISPERSION_VIOLET;
    } else {
      u = (u - DISPERSION_VIOLET_SHARE) / (1.0 - DISPERSION_VIOLET_SHARE);
    }
  } else if (u < share.x + share.y) {
    u = (u - share.x) / share.y;
    lobe = DISPERSION_GREEN;
  } else {
    u = (u - share.x - share.y) / max(share.z, 1e-37);
  }
  let at = clamp(lobe.z + clamp(u, 0.0, 1.0) * lobe.w, 1e-7, 0.9999999);
  let wavelength = clamp(lobe.x + lobe.y * log(at / (1.0 - at)), 380.0, 780.0);
  let response = dispersion_response(wavelength);
  return DispersionSample(wavelength, throughput * response / max(dot(share, response), 1e-37));
}
`,
  [random],
);
