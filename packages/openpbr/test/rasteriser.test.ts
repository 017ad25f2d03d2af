import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { describe, expect, it } from 'vitest';
import { createBall } from '../../../apps/docs/examples/rasteriser';
import { fresnelDielectric, ggx, ggxAlpha, halfVector } from '../src/cpu/index';
import type { OpenPbrVector } from '../src/parameters/index';

const SIZE = 33;

/** Draws the documentation's ball and reads it back: linear RGBA rows, the upper one first. */
async function drawn(look: Parameters<Awaited<ReturnType<typeof createBall>>['draw']>[1]): Promise<Float32Array> {
  const device = await testDevice();
  const ball = await createBall(device, 'rgba32float');
  const target = device.createTexture({
    size: [SIZE, SIZE],
    format: 'rgba32float',
    usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC,
  });
  const stride = Math.ceil((SIZE * 16) / 256) * 256;
  const staging = device.createBuffer({
    size: stride * SIZE,
    usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST,
  });
  ball.draw(target.createView(), look);
  const encoder = device.createCommandEncoder();
  encoder.copyTextureToBuffer({ texture: target }, { buffer: staging, bytesPerRow: stride }, [SIZE, SIZE]);
  device.queue.submit([encoder.finish()]);
  await staging.mapAsync(GPUMapMode.READ);
  const rows = new Float32Array(staging.getMappedRange().slice(0));
  const pixels = Float32Array.from(
    { length: SIZE * SIZE * 4 },
    (_, i) => rows[Math.floor(i / (SIZE * 4)) * (stride / 4) + (i % (SIZE * 4))] as number,
  );
  target.destroy();
  staging.destroy();
  return pixels;
}

describe("the documentation's rasteriser", () => {
  it.each([0.2, 0.6])('draws, at roughness %s, what the functions on the CPU say', async (roughness) => {
    const light = [0.48, 0.6, 0.64] as const,
      color = [0.6, 0.1, 0.03] as const,
      ior = 1.5;
    const pixels = await drawn({ light, roughness, color, ior });
    let lit = 0;
    for (let row = 0; row < SIZE; row++) {
      for (let column = 0; column < SIZE; column++) {
        const at = [(2 * column + 1) / SIZE - 1, 1 - (2 * row + 1) / SIZE] as const;
        const rest = 1 - at[0] ** 2 - at[1] ** 2;
        const pixel = pixels.subarray(4 * (row * SIZE + column), 4 * (row * SIZE + column) + 4);
        // On the silhouette, single precision decides.
        if (Math.abs(rest) < 1e-3) continue;
        if (rest < 0) {
          expect(Array.from(pixel)).toEqual([0, 0, 0, 0]);
          continue;
        }
        const n = [at[0], at[1], Math.sqrt(rest)] as const;
        const length = Math.hypot(n[2], n[0]);
        const t = [n[2] / length, 0, -n[0] / length] as const;
        const b = [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]] as const;
        const local = (w: OpenPbrVector): OpenPbrVector =>
          [t, b, n].map((axis) => axis[0] * w[0] + axis[1] * w[1] + axis[2] * w[2]) as unknown as OpenPbrVector;
        const wo = local([0, 0, 1]),
          wi = local(light);
        if (wi[2] < 1e-4) continue;
        lit++;
        const h = halfVector(wo, wi);
        const fresnel = fresnelDielectric(ior, wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2]);
        const [highlight] = ggx(ggxAlpha(roughness, 0), wo, wi, h);
        for (let k = 0; k < 3; k++) {
          const expected = 3 * (fresnel * highlight + ((1 - fresnel) * color[k]! * wi[2]) / Math.PI);
          expect(Math.abs(pixel[k]! - expected)).toBeLessThan(1e-4 * Math.max(1, expected));
        }
      }
    }
    expect(lit).toBeGreaterThan(400);
    await expectNoGpuErrors();
  });

  it('imports two modules of OpenPBR and what they need, no more', async () => {
    const { text } = await createBall(await testDevice(), 'rgba8unorm');
    expect(text.modules.toSorted()).toEqual([
      'app/ball',
      'openpbr/circle',
      'openpbr/fresnel-dielectric',
      'openpbr/ggx',
    ]);
    expect(text.code).not.toContain('OpenPbrParameters');
  });
});
