import { bvhTypes } from '@glanz/bvh/wgsl';
import { wgslModule } from '@glanz/wgsl';

/**
 * What others do, to compare with on the same rays and the same tree: a loop over one level, that of the one instance,
 * boxes without a margin for rounding, and the triangle test of Möller and Trumbore 1997, which is not watertight.
 */
export const plainQuery = (query: 'closest' | 'any') => {
  const any = query === 'any';
  return wgslModule(
    `bench/plain-${query}`,
    /* wgsl */ `
fn plain_box(origin: vec3f, inverse: vec3f, low: vec4u, high: vec4u, t_min: f32, t_max: f32) -> f32 {
  let a = (bitcast<vec3f>(low.xyz) - origin) * inverse;
  let b = (bitcast<vec3f>(high.xyz) - origin) * inverse;
  let near = min(a, b);
  let far = max(a, b);
  let enter = max(max(near.x, near.y), max(near.z, t_min));
  return select(3.4028234e38, enter, enter <= min(min(far.x, far.y), min(far.z, t_max)));
}

fn bvh_${query}_hit(origin: vec3f, direction: vec3f, t_min: f32, t_max: f32) -> ${any ? 'bool' : 'BvhHit'} {
  let first_node = bvh_instance(0u).blas_node;
  let inverse = 1.0 / select(direction, vec3f(1e-20), abs(direction) < vec3f(1e-20));
  var hit = BvhHit(t_max, 0.0, 0.0, 0u, BVH_MISS);
  var stack: array<u32, 42>;
  stack[0] = 0xffffffffu;
  var top = 1u;
  var reference = 0u;
  loop {
    while ((reference & 0x80000000u) == 0u) {
      let node = bvh_node(first_node + reference);
      let left = plain_box(origin, inverse, node.left_min, node.left_max, t_min, hit.t);
      let right = plain_box(origin, inverse, node.right_min, node.right_max, t_min, hit.t);
      let left_child = node.left_min.w;
      let right_child = node.left_max.w;
      if (max(left, right) < 3.4028234e38) {
        stack[top] = select(right_child, left_child, right < left);
        top++;
        reference = select(left_child, right_child, right < left);
      } else if (min(left, right) < 3.4028234e38) {
        reference = select(right_child, left_child, left < right);
      } else {
        top--;
        reference = stack[top];
      }
    }
    if (reference == 0xffffffffu) { break; }
    let first = reference & 0x7ffffffu;
    let end = first + ((reference >> 27u) & 15u) + 1u;
    for (var index = first; index < end; index++) {
      let triangle = bvh_triangle(index);
      let e = triangle.v1 - triangle.v0;
      let f = triangle.v2 - triangle.v0;
      let p = cross(direction, f);
      let inverse_determinant = 1.0 / dot(e, p);
      let s = origin - triangle.v0;
      let q = cross(s, e);
      let u = dot(s, p) * inverse_determinant;
      let v = dot(direction, q) * inverse_determinant;
      let t = dot(f, q) * inverse_determinant;
      if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > t_min && t < hit.t) {
        ${any ? 'return true;' : 'hit = BvhHit(t, u, v, index, 0u);'}
      }
    }
    top--;
    reference = stack[top];
  }
  return ${any ? 'false' : 'hit'};
}
`,
    [bvhTypes],
  );
};
