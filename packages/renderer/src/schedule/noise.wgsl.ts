import { wgslModule, type WgslModule } from '@glanz/wgsl';

/** Sides of the tiles in which noise is measured, pixels: a workgroup has a thread for each. */
export const TILE = 8;

/**
 * Sums over each tile: the variance of its pixels' means and the squares of the means, both averaged over the colours,
 * and the number of pixels. A workgroup a tile; added up in a fixed order.
 */
export function noiseModule(film: WgslModule): WgslModule {
  return wgslModule(
    'renderer/noise',
    /* wgsl */ `
var<workgroup> noise_sums: array<vec3f, ${TILE * TILE}>;

fn noise_pixel(at: vec2u) -> vec3f {
  if (any(at >= frame.size)) { return vec3f(0.0); }
  let pixel = at.y * frame.size.x + at.x;
  let moment = film_moment[pixel];
  let chunks = floor(moment.w / f32(FILM_CHUNK));
  var mean = vec3f(0.0);
  for (var plane = 0u; plane < FILM_PLANES; plane++) { mean += film_first_weight(plane) * film_total[plane * film_pixels_count() + pixel].xyz; }
  mean /= max(chunks, 1.0) * f32(FILM_CHUNK);
  let variance = max(moment.xyz - chunks * mean * mean, vec3f(0.0)) / max(chunks * (chunks - 1.0), 1.0);
  return vec3f(dot(variance, vec3f(1.0 / 3.0)), dot(mean * mean, vec3f(1.0 / 3.0)), 1.0);
}

@compute @workgroup_size(${TILE}, ${TILE})
fn main(@builtin(workgroup_id) tile: vec3u, @builtin(local_invocation_id) at: vec3u, @builtin(local_invocation_index) lane: u32, @builtin(num_workgroups) tiles: vec3u) {
  noise_sums[lane] = noise_pixel(tile.xy * ${TILE}u + at.xy);
  for (var step = ${(TILE * TILE) / 2}u; step > 0u; step /= 2u) {
    workgroupBarrier();
    if (lane < step) { noise_sums[lane] += noise_sums[lane + step]; }
  }
  if (lane == 0u) { film_noise[tile.y * tiles.x + tile.x] = vec4f(noise_sums[0], 0.0); }
}
`,
    [film],
  );
}
