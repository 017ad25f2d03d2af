import { wgslModule } from '@glanz/wgsl';

/**
 * Adds a batch's samples to the film. Samples of a pixel are added one by one in the order of their numbers, into blocks
 * of 64 and then into the total: the sum is the same bit for bit however the samples were batched, and keeps its
 * precision over many samples. A NaN or infinite sample is dropped, counted, and never reaches the film.
 */
export const resolve = wgslModule(
  'renderer/resolve',
  /* wgsl */ `
fn resolve_finite(v: vec4f) -> bool {
  return all((bitcast<vec4u>(v) & vec4u(0x7f800000u)) != vec4u(0x7f800000u));
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= batch.pixel_count) { return; }
  let pixel = batch.pixel_offset + id.x;
  var block = film_block[pixel];
  var total = film_total[pixel];
  for (var s = 0u; s < batch.sample_count; s++) {
    let index = s * batch.pixel_count + id.x;
    let value = vec4f(paths[index].radiance, paths[index].alpha);
    if (resolve_finite(value)) { block += value; } else { atomicAdd(&queues.bad_samples, 1u); }
    if (((batch.sample_offset + s) & 63u) == 63u) {
      total += block;
      block = vec4f(0.0);
    }
  }
  film_block[pixel] = block;
  film_total[pixel] = total;
  beauty[pixel] = (total + block) / f32(batch.sample_offset + batch.sample_count);
}
`,
);
