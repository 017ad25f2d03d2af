import { gated, wgslModule, type WgslModule } from '@glanz/wgsl';
import { MATERIAL_CULLED, MATERIAL_EMISSIVE, materialStruct } from '../storage/layout';
import { mediaFront } from '../materials/media.wgsl';

/**
 * Back faces that are left out, see `PathTracerOptions.backFaceCulling`. With CULLING_ALL it is the camera's place that
 * decides, so that all rays find the same faces: light samples and paths then agree about what is in their way.
 */
const culling = /* @__PURE__ */ wgslModule(
  'renderer/culling',
  /* wgsl */ `
// Of a ray of the camera's own; 0 for others.
var<private> culling_direction: vec3f;

fn culling_begin(direction: vec3f, seen: bool) { culling_direction = select(vec3f(0.0), direction, seen); }

fn culling_accept(hit: BvhHit) -> bool {
  let flags = materials[instances[hit.instance].material].flags;
  if ((flags & ${MATERIAL_CULLED}u) == 0u) { return true; }
  var view = culling_direction;
  //#if CULLING_ALL
  // What glows is found by light samples too, which do not ask for its side.
  if ((flags & ${MATERIAL_EMISSIVE}u) == 0u) {
    //#if CAMERA_ORTHOGRAPHIC
    view = frame.camera_forward;
    //#else
    let corner = vec4f(triangles[3u * hit.triangle].xyz, 1.0);
    view = vec3f(dot(instances[hit.instance].to_world_0, corner), dot(instances[hit.instance].to_world_1, corner), dot(instances[hit.instance].to_world_2, corner)) - frame.camera_origin;
    //#endif
  }
  //#endif
  return dot(media_normal(hit), view) <= 0.0;
}
`,
  [mediaFront, materialStruct.module],
);

/**
 * `fn bvh_accept(hit: BvhHit) -> bool`: whether a candidate counts, with CULLING by the side that it shows, with
 * OPACITY by chance.
 *
 * @param opacity With `opacity_accept`.
 */
export const accept = (opacity: WgslModule): WgslModule =>
  wgslModule(
    'renderer/accept',
    /* wgsl */ `
fn bvh_accept(hit: BvhHit) -> bool {
  //#if CULLING
  if (!culling_accept(hit)) { return false; }
  //#endif
  //#if OPACITY
  return opacity_accept(hit);
  //#else
  return true;
  //#endif
}
`,
    [gated('CULLING', culling), gated('OPACITY', opacity)],
  );
