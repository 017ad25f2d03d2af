import { wgslModule } from '@glanz/wgsl';

/**
 * Interpolated and mapped normals of glass may send a mirrored ray into the surface or a refracted one back out of it. Such
 * rays end, and glass has no other light to give: thin walls with smooth normals go black, the more the better the glass. So
 * the normal is bent, as little as will do, until both rays leave on their side (Keller et al., "The Iray Light Transport
 * Simulation and Rendering System", 2017, for mirrors; the same for refraction). It hangs on the view alone, so light
 * samples and BSDF samples see the same surface.
 *
 * `fn normal_bend(n: vec3f, g: vec3f, wo: vec3f, eta: f32) -> vec3f`: `g` is the geometric normal on the viewer's side; `eta`
 * the index beyond over that on the viewer's side, 1 where light goes straight on.
 *
 * `fn normal_raise(n: vec3f, g: vec3f, wo: vec3f, least: f32) -> vec3f`: the part of it for mirrors; the cosine between the
 * mirrored ray and `g` becomes at least about `least`.
 */
export const shadingNormal = /* @__PURE__ */ wgslModule(
  'renderer/shading-normal',
  /* wgsl */ `
fn normal_raise(n: vec3f, g: vec3f, wo: vec3f, least: f32) -> vec3f {
  let mirrored = reflect(-wo, n);
  let up = dot(mirrored, g);
  if (up >= least) { return n; }
  return normalize(wo + normalize(mirrored + g * (least - up)));
}

fn normal_bend(n: vec3f, g: vec3f, wo: vec3f, eta: f32) -> vec3f {
  var bent = normal_raise(n, g, wo, 0.02);
  let c = dot(wo, bent);
  let k = 1.0 - (1.0 - c * c) / (eta * eta);
  if (k <= 0.0 || abs(eta - 1.0) < 1e-3) { return bent; }
  let refracted = (c / eta - sqrt(k)) * bent - wo / eta;
  let rise = dot(refracted, g);
  if (rise > -0.02) {
    let h = normalize(wo + eta * normalize(refracted - g * (rise + 0.02)));
    bent = select(h, -h, dot(h, wo) < 0.0);
  }
  return bent;
}
`,
);
