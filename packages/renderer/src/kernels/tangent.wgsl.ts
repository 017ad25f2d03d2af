import { wgslModule } from '@glanz/wgsl';

/** `fn surface_tangent(n: vec3f) -> vec3f`: some unit vector across. Branch-free (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017). */
export const tangent = /* @__PURE__ */ wgslModule(
  'renderer/tangent',
  /* wgsl */ `
fn surface_tangent(n: vec3f) -> vec3f {
  let s = select(-1.0, 1.0, n.z >= 0.0);
  let a = -1.0 / (s + n.z);
  return vec3f(1.0 + s * n.x * n.x * a, s * n.x * n.y * a, -s * n.x);
}
`,
);
