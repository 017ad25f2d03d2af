import { wgslModule } from '@glanz/wgsl/module';

/** The small picture of a moment ago, enlarged, mixed with the large one that is still noisy. */
export const viewerBlend = wgslModule(
  'viewer/blend',
  /* wgsl */ `
// Width and height of the picture; those of the small one. Then the small one's share, 0..1.
@group(0) @binding(0) var<uniform> viewer_blend_sizes: array<vec4f, 2>;
@group(0) @binding(1) var<storage, read> viewer_blend_film: array<vec4f>;
@group(0) @binding(2) var<storage, read> viewer_blend_small: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> viewer_blend_result: array<vec4f>;

fn viewer_blend_texel(p: vec2i) -> vec4f {
  let size = vec2i(viewer_blend_sizes[0].zw);
  let q = clamp(p, vec2i(0), size - 1);
  return viewer_blend_small[q.y * size.x + q.x];
}

@compute @workgroup_size(8, 8) fn viewer_blend(@builtin(global_invocation_id) id: vec3u) {
  let sizes = viewer_blend_sizes[0];
  let size = vec2u(sizes.xy);
  if (id.x >= size.x || id.y >= size.y) { return; }
  let i = id.y * size.x + id.x;
  let p = (vec2f(id.xy) + 0.5) * sizes.zw / sizes.xy - 0.5;
  let corner = floor(p);
  let f = p - corner;
  let c = vec2i(corner);
  let small = mix(
    mix(viewer_blend_texel(c), viewer_blend_texel(c + vec2i(1, 0)), f.x),
    mix(viewer_blend_texel(c + vec2i(0, 1)), viewer_blend_texel(c + vec2i(1, 1)), f.x), f.y);
  viewer_blend_result[i] = mix(viewer_blend_film[i], small, viewer_blend_sizes[1].x);
}`,
);
