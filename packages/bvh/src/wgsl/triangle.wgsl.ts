import { wgslModule } from '@glanz/wgsl/module';

/**
 * The ray-triangle test. Vertices are taken relative to the ray's origin into a frame whose third axis is the ray, and the
 * ray hits where the origin lies on the same side of the three edges (Woop, Benthin and Wald 2013, "Watertight
 * Ray/Triangle Intersection", with an orthonormal frame in place of the axis permutation and shear). Two triangles that
 * share an edge see the same two points, so a ray can slip between them by the rounding of the edge function, whether or
 * not the compiler fuses multiplications and additions; and by that of the points, which puts it into the neighbour
 * whose box it passes by. A tolerance as large as both closes the gap: the triangle in whose box the ray is takes the hit.
 */
export const bvhTriangleTest = wgslModule(
  'bvh/triangle',
  /* wgsl */ `
struct BvhRay {
  origin: vec3f,
  direction: vec3f,
  // Reciprocal of the direction, finite.
  inverse: vec3f,
  // Where the inverse is not negative.
  forward: vec3<bool>,
  // A plane at x, across an axis, is met at x * inverse + near at the earliest and at x * inverse + far at the latest: the
  // product of origin and inverse may be off by half an ulp, and by another where the sum is not fused.
  near: vec3f,
  far: vec3f,
}

fn bvh_ray(origin: vec3f, direction: vec3f) -> BvhRay {
  let inverse = 1.0 / select(direction, vec3f(1e-20), abs(direction) < vec3f(1e-20));
  let start = origin * inverse;
  let margin = abs(start) * 2.3841858e-7;
  return BvhRay(origin, direction, inverse, inverse >= vec3f(0.0), -start - margin, margin - start);
}

// Two unit vectors perpendicular to the ray's direction, and the direction over its squared length.
struct BvhFrame {
  x: vec3f,
  y: vec3f,
  z: vec3f,
}

fn bvh_frame(direction: vec3f) -> BvhFrame {
  // Scaled by powers of two that cancel, as squares of very small or large directions leave the range of f32.
  let scale = 1.0 / max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
  let d = direction * scale;
  let squared = dot(d, d);
  let n = d * inverseSqrt(squared);
  // Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
  let s = select(-1.0, 1.0, n.z >= 0.0);
  let a = -1.0 / (s + n.z);
  let b = n.x * n.y * a;
  return BvhFrame(vec3f(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3f(b, s + n.y * n.y * a, -n.y), d * (scale / squared));
}

// t, u, v; t < 0 if there is no hit. v0's weight is 1 - u - v.
fn bvh_intersect_triangle(origin: vec3f, frame: BvhFrame, triangle: BvhTriangle) -> vec3f {
  let p0 = triangle.v0 - origin;
  let p1 = triangle.v1 - origin;
  let p2 = triangle.v2 - origin;
  let a = vec2f(dot(frame.x, p0), dot(frame.y, p0));
  let b = vec2f(dot(frame.x, p1), dot(frame.y, p1));
  let c = vec2f(dot(frame.x, p2), dot(frame.y, p2));
  let u = a.x * c.y - a.y * c.x;
  let v = b.x * a.y - b.y * a.x;
  let w = c.x * b.y - c.y * b.x;
  let largest = max(max(max(abs(a.x), abs(a.y)), max(abs(b.x), abs(b.y))), max(abs(c.x), abs(c.y)));
  let far = max(abs(p0), max(abs(p1), abs(p2)));
  // Half an ulp each for two products and their difference; and what the two vertices are off, by the rounding of the
  // frame and of three products and their sums, which is a share of their distance. A neighbour whose box the ray
  // passes by may be the one that it would meet otherwise.
  let tolerance = largest * (largest * 1.7881393e-7 + max(far.x, max(far.y, far.z)) * 9.5367432e-7);
  let low = min(u, min(v, w));
  let high = max(u, max(v, w));
  let determinant = u + v + w;
  if ((low < -tolerance && high > tolerance) || determinant == 0.0) { return vec3f(-1.0, 0.0, 0.0); }
  let inverse = 1.0 / determinant;
  let near = clamp(vec2f(u, v) * inverse, vec2f(0.0), vec2f(1.0));
  // Beyond an edge by the tolerance, which on thin triangles is much of a weight: what was cut off must not move t.
  let first = max(1.0 - near.x - near.y, 0.0);
  let weights = near / (first + near.x + near.y);
  let t = (1.0 - weights.x - weights.y) * dot(frame.z, p0) + weights.x * dot(frame.z, p1) + weights.y * dot(frame.z, p2);
  return vec3f(t, weights);
}
`,
);
