import { openpbrPhase } from '@glanz/openpbr/wgsl';
import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { HIT_SCATTERED, HIT_WALKING } from '../storage/layout';
import { media } from '../materials/media.wgsl';
import { pathSample } from '../path/path.wgsl';
import random from '../random/random.wesl';

/** Scattering events in one run of the kernel, so that none runs long. */
export const WALK_STEPS = 16;

/**
 * A ray's way through the medium it is in, up to the next surface, and its random walk there. Distances are drawn for
 * one of the three channels, weighed as if for all of them (spectral multiple importance sampling, Wilkie et al. 2014,
 * "Hero Wavelength Spectral Sampling"). Light samples are taken only in interiors without an optical surface: no
 * straight way leads out of the others.
 */
export function volumeModule(traversal: WgslModule, areas: WgslModule): WgslModule {
  return wgslModule(
    'renderer/volume',
    /* wgsl */ `
fn volume_store(index: u32, hit: BvhHit) {
  path_set_hit(index, vec4u(bitcast<u32>(hit.u), bitcast<u32>(hit.v), hit.triangle, hit.instance));
}

fn volume_travel(index: u32, entry: u32) {
  let medium = media_of(entry);
  //#if SCATTERING
  if (any(medium.scattering > vec3f(0.0))) {
    volume_walk(index, entry, medium);
    return;
  }
  //#endif
  let hit = bvh_closest_hit(path_origin(index), path_direction(index), 0.0, 3.4e38);
  //#if AREA_LIGHTS
  area_light_gather(index, path_origin(index), path_direction(index), hit.t, path_throughput(index), medium.extinction, false);
  //#endif
  path_set_throughput(index, path_throughput(index) * (exp(-medium.extinction * hit.t)));
  volume_store(index, hit);
}

//#if SCATTERING
fn volume_walk(index: u32, entry: u32, medium: OpenPbrMedium) {
  random_begin(path_pixel(index), path_sample(index), 0x8000u + queues.depth, frame.seed);
  let open = media_index_matched(entry);
  var origin = path_origin(index);
  var direction = path_direction(index);
  var throughput = path_throughput(index);
  var counters = path_counters(index);
  for (var step = 0u; step < ${WALK_STEPS}u; step++) {
    if ((counters >> 16u) >= frame.max_volume_depth) {
      // From here on what scatters goes straight on, and only absorption counts.
      let hit = bvh_closest_hit(origin, direction, 0.0, 3.4e38);
      //#if AREA_LIGHTS
      area_light_gather(index, origin, direction, hit.t, throughput, medium.extinction - medium.scattering, false);
      //#endif
      path_set_throughput(index, throughput * exp((medium.scattering - medium.extinction) * hit.t));
      volume_store(index, hit);
      break;
    }
    let share = throughput / max(throughput.x + throughput.y + throughput.z, 1e-37);
    let u = random_2();
    let rate = select(select(medium.extinction.z, medium.extinction.y, u.x < share.x + share.y), medium.extinction.x, u.x < share.x);
    let reach = min(-log(1.0 - u.y) / max(rate, 1e-37), 3.4e38);
    let hit = bvh_closest_hit(origin, direction, 0.0, reach);
    //#if AREA_LIGHTS
    area_light_gather(index, origin, direction, min(hit.t, reach), throughput, medium.extinction, true);
    //#endif
    if (hit.instance != 0xffffffffu || reach > 3e38) {
      let passed = exp(-medium.extinction * hit.t);
      path_set_throughput(index, throughput * passed / max(dot(share, passed), 1e-37));
      volume_store(index, hit);
      break;
    }
    let passed = exp(-medium.extinction * reach);
    throughput *= medium.scattering * passed / max(dot(share, medium.extinction * passed), 1e-37);
    origin += direction * reach;
    counters += 0x10000u;
    var code = select(0u, ${HIT_WALKING}u, step + 1u == ${WALK_STEPS}u);
    if (open) {
      code = ${HIT_SCATTERED}u;
    } else {
      // Light samples were not an alternative.
      path_set_pdf(index, 1e30);
      direction = openpbr_phase_sample(medium.anisotropy, -direction, random_2());
      let brightest = max(throughput.x, max(throughput.y, throughput.z));
      if (brightest < 0.0625) {
        let survival = 16.0 * brightest;
        if (!(random_next() < survival)) {
          throughput = vec3f(0.0);
          code = ${HIT_WALKING}u;
        } else {
          throughput /= survival;
        }
      }
    }
    if (code != 0u) {
      path_set_throughput(index, throughput);
      path_set_hit(index, vec4u(0u, 0u, 0u, code));
      break;
    }
  }
  path_set_origin(index, origin);
  path_set_direction(index, direction);
  path_set_counters(index, counters);
}
//#endif
`,
    [
      media,
      traversal,
      gated('AREA_LIGHTS', areas),
      gated('SCATTERING', pathSample),
      gated('SCATTERING', random),
      gated('SCATTERING', openpbrPhase),
    ],
  );
}
