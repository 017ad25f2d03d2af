import { wgslModule, type WgslModule } from '@glanz/wgsl';

/**
 * Adds a batch's samples to the film. Samples of a pixel are added one by one in the order of their numbers, into
 * chunks and then into the total: the sum is the same bit for bit however the samples were batched, and keeps its
 * precision over many samples. A NaN, infinite or negative sample counts as black, is counted, and never reaches the
 * film.
 *
 * The squares of the chunks' means are summed too (film_moment.xyz, and the number of samples in w): chunks of 16 Sobol
 * points vary much less than 16 single samples do, and it is their variance that the image has.
 */
export function resolveModule(path: WgslModule, film: WgslModule): WgslModule {
  return wgslModule(
    'renderer/resolve',
    /* wgsl */ `
// Light is not negative. Coverage may be: behind glass it is one less what the path carries, which can be more than one.
fn resolve_sound(v: vec4f) -> bool {
  return all((bitcast<vec4u>(v) & vec4u(0x7f800000u)) != vec4u(0x7f800000u)) && all(v.xyz >= vec3f(0.0));
}

// The path that carries a plane of a sample.
fn resolve_path(sample: u32, pixel: u32, plane: u32) -> u32 {
  let first = sample * batch.pixel_count + pixel;
  //#if CATCHER
  if (plane / FILM_GROUPS == PATH_WITHOUT) { return first + batch.pixel_count * batch.sample_count; }
  //#endif
  return first;
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= batch.pixel_count) { return; }
  let pixel = film_pixels[batch.pixel_offset + id.x];
  for (var s = 0u; s < batch.sample_count; s++) {
    var sound = true;
    for (var plane = 0u; plane < FILM_PLANES; plane++) { sound = sound && resolve_sound(path_plane(resolve_path(s, id.x, plane), plane)); }
    if (!sound) {
      //#if CATCHER
      path_clear(resolve_path(s, id.x, 2u * FILM_GROUPS));
      //#endif
      path_clear(resolve_path(s, id.x, 0u));
      path_set_alpha(resolve_path(s, id.x, 0u), 0.0);
      atomicAdd(&queues.bad_samples, 1u);
    }
  }
  let end = batch.sample_offset + batch.sample_count;
  var moment = film_moment[pixel].xyz;
  // From chunk to chunk; the first and the last may be a part of one.
  for (var first = batch.sample_offset; first < end; first = min((first / FILM_CHUNK + 1u) * FILM_CHUNK, end)) {
    let next = min((first / FILM_CHUNK + 1u) * FILM_CHUNK, end);
    let complete = next % FILM_CHUNK == 0u;
    var mean = vec3f(0.0);
    for (var plane = 0u; plane < FILM_PLANES; plane++) {
      let at = plane * film_pixels_count() + pixel;
      var block = film_block[at];
      for (var sample = first; sample < next; sample++) { block += path_plane(resolve_path(sample - batch.sample_offset, id.x, plane), plane); }
      if (complete) {
        film_total[at] += block;
        mean += film_first_weight(plane) * block.xyz;
        block = vec4f(0.0);
      }
      film_block[at] = block;
    }
    // A film that begins in the middle of a chunk has only a part of that chunk.
    if (complete && next >= batch.first_sample + FILM_CHUNK) {
      mean /= f32(FILM_CHUNK);
      moment += mean * mean;
    }
  }
  let count = f32(end - batch.first_sample);
  film_moment[pixel] = vec4f(moment, count);
  beauty[pixel] = film_compose(pixel, count);
}
`,
    [path, film],
  );
}
