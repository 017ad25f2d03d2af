import { wgslModule } from '@glanz/wgsl';
import { frameStruct } from './layout';

/**
 * `fn filter_offset(u: vec2f) -> vec2f`: a point around a pixel, distributed as the pixel filter (Ernst, Stamminger and
 * Greiner, "Filter Importance Sampling", 2006). Every sample then counts alike and for its own pixel only, which keeps
 * pixels independent of each other and of the order of the work. (0.5, 0.5) is the pixel's centre. The filters are
 * separable and each axis is inverted exactly, so even samples stay even.
 *
 * Without a flag the box; FILTER_GAUSSIAN: standard deviation a third of the radius, cut off at the radius;
 * FILTER_BLACKMAN_HARRIS: the four-term window (Harris 1978) over the radius.
 */
export const filter = wgslModule(
  'renderer/filter',
  /* wgsl */ `
//#if FILTER_WIDE_BOX
fn filter_axis(u: f32) -> f32 { return 2.0 * u - 1.0; }
//#endif

//#if FILTER_GAUSSIAN
// Single-precision inverse of the error function (Giles, "Approximating the erfinv Function", 2010).
fn filter_inverse_erf(x: f32) -> f32 {
  var w = -log((1.0 - x) * (1.0 + x));
  var p: f32;
  if (w < 5.0) {
    w -= 2.5;
    p = 2.81022636e-08;
    p = 3.43273939e-07 + p * w;
    p = -3.5233877e-06 + p * w;
    p = -4.39150654e-06 + p * w;
    p = 0.00021858087 + p * w;
    p = -0.00125372503 + p * w;
    p = -0.00417768164 + p * w;
    p = 0.246640727 + p * w;
    p = 1.50140941 + p * w;
  } else {
    w = sqrt(w) - 3.0;
    p = -0.000200214257;
    p = 0.000100950558 + p * w;
    p = 0.00134934322 + p * w;
    p = -0.00367342844 + p * w;
    p = 0.00573950773 + p * w;
    p = -0.0076224613 + p * w;
    p = 0.00943887047 + p * w;
    p = 1.00167406 + p * w;
    p = 2.83297682 + p * w;
  }
  return p * x;
}

// In units of the radius, for u in [0, 1): erf(3/√2) of the bell lies within three standard deviations.
fn filter_axis(u: f32) -> f32 {
  return 0.47140452079103168 * filter_inverse_erf((2.0 * u - 1.0) * 0.9973002039367398);
}
//#endif

//#if FILTER_BLACKMAN_HARRIS
// The window's integral from 0 to t, as a share of the whole.
fn filter_integral(t: f32) -> f32 {
  let a = 6.283185307179586 * t;
  return t - 0.2166237412190706 * sin(a) + 0.03133855102442226 * sin(2.0 * a) - 0.0017272285577824274 * sin(3.0 * a);
}

// Bisection narrows the step that Newton's method may take: the window is almost flat at its ends.
fn filter_axis(u: f32) -> f32 {
  var low = 0.0;
  var high = 1.0;
  var t = 0.5;
  for (var i = 0u; i < 16u; i++) {
    let error = filter_integral(t) - u;
    if (error > 0.0) { high = t; } else { low = t; }
    let a = 6.283185307179586 * t;
    let slope = 1.0 - 1.3610871080139373 * cos(a) + 0.39381184668989544 * cos(2.0 * a) - 0.0325574912891986 * cos(3.0 * a);
    let next = t - error / max(slope, 1e-6);
    t = select(0.5 * (low + high), next, next > low && next < high);
  }
  return 2.0 * t - 1.0;
}
//#endif

fn filter_offset(u: vec2f) -> vec2f {
  //#if FILTER_BOX
  return u;
  //#else
  return 0.5 + frame.filter_radius * vec2f(filter_axis(u.x), filter_axis(u.y));
  //#endif
}
`,
  [frameStruct.module],
);
