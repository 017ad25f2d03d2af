import { openpbrFresnelDielectric, openpbrGgx } from '@glanz/openpbr/wgsl';
import { compose, createShaderModule, wgslModule } from '@glanz/wgsl';

// #region shader
const ball = wgslModule(
  'app/ball',
  /* wgsl */ `
struct Look { light: vec3f, roughness: f32, color: vec3f, ior: f32 }
@group(0) @binding(0) var<uniform> look: Look;

struct Vertex { @builtin(position) position: vec4f, @location(0) at: vec2f }

// One triangle that covers the target.
@vertex fn corner(@builtin(vertex_index) index: u32) -> Vertex {
  let at = vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
  return Vertex(vec4f(at, 0.0, 1.0), at);
}

@fragment fn shade(v: Vertex) -> @location(0) vec4f {
  let z = sqrt(max(1.0 - dot(v.at, v.at), 0.0));
  if (z == 0.0) { return vec4f(0.0); }
  // OpenPBR's functions expect the shading frame: +z is the normal.
  let normal = vec3f(v.at, z);
  let tangent = normalize(vec3f(normal.z, 0.0, -normal.x));
  let frame = mat3x3f(tangent, cross(normal, tangent), normal);
  let wo = vec3f(0.0, 0.0, 1.0) * frame;
  let wi = look.light * frame;
  if (wi.z <= 0.0) { return vec4f(0.0, 0.0, 0.0, 1.0); }
  let h = normalize(wo + wi);
  let reflected = openpbr_fresnel_dielectric(look.ior, dot(wo, h));
  let alpha = openpbr_alpha(look.roughness, 0.0);
  let highlight = reflected * openpbr_ggx(alpha, wo, wi, h, 1.0).x;
  let body = (1.0 - reflected) * look.color * wi.z / 3.14159265;
  return vec4f(3.0 * (highlight + body), 1.0);
}`,
  [openpbrGgx, openpbrFresnelDielectric],
);
// #endregion shader

/**
 * Uniforms of the sphere: a unit vector to the light, roughness, linear colour
 * and index of refraction.
 */
export interface BallLook {
  readonly light: readonly [number, number, number];
  readonly roughness: number;
  readonly color: readonly [number, number, number];
  readonly ior: number;
}

// #region pipeline
export async function createBall(device: GPUDevice, format: GPUTextureFormat) {
  const text = compose([ball], { flags: { OPENPBR_ANISOTROPY: false } });
  const module = await createShaderModule(device, text, 'ball');
  const pipeline = await device.createRenderPipelineAsync({
    layout: 'auto',
    vertex: { module },
    fragment: { module, targets: [{ format }] },
  });
  const uniforms = device.createBuffer({
    size: 32,
    usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST,
  });
  const bindGroup = device.createBindGroup({
    layout: pipeline.getBindGroupLayout(0),
    entries: [{ binding: 0, resource: { buffer: uniforms } }],
  });
  return {
    text,
    draw(view: GPUTextureView, { light, roughness, color, ior }: BallLook) {
      device.queue.writeBuffer(
        uniforms,
        0,
        Float32Array.of(...light, roughness, ...color, ior),
      );
      const encoder = device.createCommandEncoder();
      const pass = encoder.beginRenderPass({
        colorAttachments: [{ view, loadOp: 'clear', storeOp: 'store' }],
      });
      pass.setPipeline(pipeline);
      pass.setBindGroup(0, bindGroup);
      pass.draw(3);
      pass.end();
      device.queue.submit([encoder.finish()]);
    },
  };
}
// #endregion pipeline
