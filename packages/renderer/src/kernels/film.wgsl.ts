import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { MAX_LIGHT_GROUPS } from './resources';

/** Samples that are added up before they join the total. */
export const FILM_CHUNK = 16;

/**
 * The film's planes put together: `fn film_weight(plane: u32) -> vec3f` and
 * `fn film_compose(pixel: u32, count: f32) -> vec4f`, the mean over `count` samples as the light groups are set.
 */
export function filmModule(planes: number): WgslModule {
  return wgslModule(
    'renderer/film',
    /* wgsl */ `
const FILM_PLANES = ${planes}u;
const FILM_CHUNK = ${FILM_CHUNK}u;

fn film_pixels_count() -> u32 { return arrayLength(&beauty); }

fn film_weight(plane: u32) -> vec3f {
  //#if LIGHT_GROUPS
  return light_groups[plane].xyz;
  //#else
  return vec3f(1.0);
  //#endif
}

// As the groups were set when the film was begun: what the variance is of.
fn film_first_weight(plane: u32) -> vec3f {
  //#if LIGHT_GROUPS
  return light_groups[${MAX_LIGHT_GROUPS}u + plane].xyz;
  //#else
  return vec3f(1.0);
  //#endif
}

fn film_compose(pixel: u32, count: f32) -> vec4f {
  var sum = vec4f(0.0);
  for (var plane = 0u; plane < FILM_PLANES; plane++) {
    let at = plane * film_pixels_count() + pixel;
    sum += vec4f(film_weight(plane), 1.0) * (film_total[at] + film_block[at]);
  }
  return sum / count;
}
`,
  );
}

/** Puts the beauty together anew from what the film holds, without a sample. */
export function relightModule(film: WgslModule): WgslModule {
  return wgslModule(
    'renderer/relight',
    /* wgsl */ `
@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= batch.pixel_count) { return; }
  let pixel = batch.pixel_offset + id.x;
  let count = film_moment[pixel].w;
  if (count > 0.0) { beauty[pixel] = film_compose(pixel, count); }
}
`,
    [film],
  );
}
