import { wgslModule, type WgslModule } from '@glanz/wgsl';
import { BACKGROUND_TRANSPARENT } from '../storage/layout';
import pathSample from '../path/path_sample.wesl';
import random from '../random/random.wesl';

/** What all vertices of a path have in common, on surfaces and between them. The host declares `frame` and `Shadow`. */
export function shadeCommon(path: WgslModule): WgslModule {
  return wgslModule(
    'renderer/shade-common',
    /* wgsl */ `
struct ShadeResult {
  goes_on: bool,
  asks: bool,
  shadow: Shadow,
}

// Whether a path that leaves the scene shows what is behind a transparent image: one that came here straight from the
// camera, or through glass and nothing else. Such paths still have the alpha of 2 that they began with.
fn shade_sees_background(index: u32, depth: u32) -> bool {
  if ((frame.background & ${BACKGROUND_TRANSPARENT}u) == 0u) { return false; }
  //#if OPENPBR_TRANSMISSION
  return path_alpha(index) > 1.0;
  //#else
  return depth == 0u;
  //#endif
}

fn shade_random(index: u32, iteration: u32) {
  random_begin(path_pixel(index), path_sample(index), iteration + 1u, frame.seed);
}

// Russian roulette from the third scattering on, for paths that carry less than a sixteenth of what they began with:
// earlier, the noise it adds outweighs the rays it saves. Zero: the path ends.
fn shade_roulette(carried: vec3f, depth: u32) -> vec3f {
  let brightest = max(carried.x, max(carried.y, carried.z));
  if (!(brightest > 0.0)) { return vec3f(0.0); }
  if (depth < 2u || brightest >= 0.0625) { return carried; }
  let survival = 16.0 * brightest;
  return select(vec3f(0.0), carried / survival, random_next() < survival);
}
`,
    [path, pathSample, random],
  );
}
