import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { FILM_CHUNK } from '../schedule/sample-range';
import { MAX_LIGHT_GROUPS } from '../storage/resources';

/**
 * The film's planes put together: `fn film_weight(plane: u32) -> vec3f` and
 * `fn film_compose(pixel: u32, count: f32) -> vec4f`, the mean over `count` samples as the light groups are set.
 */
export function filmModule(planes: number, catcher: boolean): WgslModule {
  const groups = catcher ? planes / 4 : planes;
  return wgslModule(
    'renderer/film',
    /* wgsl */ `
const FILM_PLANES = ${planes}u;
const FILM_CHUNK = ${FILM_CHUNK}u;
const FILM_GROUPS = ${groups}u;

fn film_pixels_count() -> u32 { return arrayLength(&beauty); }

fn film_weight(plane: u32) -> vec3f {
  //#if LIGHT_GROUPS
  return light_groups[plane % FILM_GROUPS].xyz;
  //#else
  return vec3f(1.0);
  //#endif
}

// As the groups were set when the film was begun: what the variance is of. Catchers count as what they are with the objects.
fn film_first_weight(plane: u32) -> vec3f {
  //#if LIGHT_GROUPS
  if (plane >= 2u * FILM_GROUPS) { return vec3f(0.0); }
  return light_groups[${MAX_LIGHT_GROUPS}u + plane % FILM_GROUPS].xyz;
  //#else
  return select(vec3f(1.0), vec3f(0.0), plane >= 2u * FILM_GROUPS);
  //#endif
}

// Mean of the planes of one kind, "first" to "first" + groups.
fn film_sum(pixel: u32, first: u32, count: f32) -> vec4f {
  var sum = vec4f(0.0);
  for (var plane = first; plane < first + FILM_GROUPS; plane++) {
    let at = plane * film_pixels_count() + pixel;
    sum += vec4f(film_weight(plane), 1.0) * (film_total[at] + film_block[at]);
  }
  return sum / count;
}

fn film_compose(pixel: u32, count: f32) -> vec4f {
  //#if CATCHER
  let object = film_sum(pixel, 0u, count);
  let caught = film_sum(pixel, FILM_GROUPS, count);
  if (caught.w <= 0.0) { return object; }
  let bare = film_sum(pixel, 2u * FILM_GROUPS, count).xyz;
  let behind = film_sum(pixel, 3u * FILM_GROUPS, count).xyz;
  // What the objects take from the catcher dims what is behind; what they add is added.
  let kept = min(caught.xyz, bare);
  let added = max(caught.xyz - bare, vec3f(0.0));
  if (any(behind > vec3f(0.0))) {
    let ratio = select(kept / max(bare, vec3f(1e-30)), vec3f(1.0), bare <= vec3f(0.0));
    return vec4f(object.xyz + added + behind * ratio, object.w + caught.w);
  }
  let luminance = vec3f(0.2126, 0.7152, 0.0722);
  let light = dot(bare, luminance);
  let shadow = select(0.0, 1.0 - dot(kept, luminance) / light, light > 0.0);
  return vec4f(object.xyz + added, object.w + caught.w * shadow);
  //#else
  return film_sum(pixel, 0u, count);
  //#endif
}
`,
  );
}

/** Puts the beauty together again from what the film holds, without a sample. */
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
