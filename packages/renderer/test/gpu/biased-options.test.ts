import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import type { Scene } from '@glanz/scene';
import { afterEach, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import { biasedFlags } from '../../src/biased-options';
import { resolveOptions } from '../../src/option-checks';
import { samplesOf } from '../full';
import { addQuad, camera, createScene, lambert, meanOf } from '../scenes';

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice({ driver: 'swiftshader' });
});
afterEach(() => expectNoGpuErrors());

async function image(
  scene: Scene,
  options: Partial<PathTracerOptions> & { samples?: number } = {},
): Promise<{ pixels: Float32Array; variance: number }> {
  const tracer = await PathTracer.create(device, scene, {
    width: 12,
    height: 12,
    camera,
    pathsInFlight: 1 << 14,
    maxDepth: 4,
    ...options,
  });
  for await (const _ of tracer.render({ maxSubmitMs: 1000, samples: options.samples ?? 64 }));
  const [pixels, variance] = [await tracer.read('beauty'), await tracer.read('variance')];
  tracer.destroy();
  return { pixels, variance: variance.reduce((sum, v, i) => (i % 4 === 3 ? sum : sum + v), 0) };
}

const largest = (a: Float32Array, b: Float32Array) =>
  a.reduce((max, value, i) => Math.max(max, Math.abs(value - (b[i] as number))), 0);
const mean = (pixels: Float32Array) => meanOf(pixels, 12, 0, 0, 12, 12)[1];

/** A floor in the image, a wall beside it, and a small light above. */
function corner(wall: Scene['materials'][number]): Scene {
  const scene = createScene();
  addQuad(scene, 3, 0, lambert(0.7));
  // Turned to face −x, at x = 1.2, just out of view: columns are the images of x, y, z.
  addQuad(scene, 3, 0, wall, { transform: [0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1.2, 0, 0, 1] });
  addQuad(
    scene,
    0.3,
    2.5,
    { name: 'light', parameters: { base_weight: 0, specular_weight: 0, emission_luminance: 20 } },
    { flip: true, transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.8, 0, 0, 1] },
  );
  return scene;
}
const mirror = {
  name: 'mirror',
  parameters: { base_metalness: 1, base_color: [0.95, 0.95, 0.95], specular_roughness: 0.15 },
} as const;
const black = { name: 'black', parameters: { base_weight: 0, specular_weight: 0 } };

describe('biased options', () => {
  it('leave no text behind when they are off', () => {
    for (const options of [{}, { regularization: 0, caustics: true, maxBounces: {} }]) {
      expect(Object.values(biasedFlags(resolveOptions(options))).every((flag) => !flag)).toBe(true);
    }
  });

  it('a clamp that nothing reaches changes nothing; one near zero leaves direct light', async () => {
    const scene = corner(lambert(0.8));
    const plain = (await image(scene)).pixels;
    expect(largest((await image(scene, { clampIndirect: 1e6 })).pixels, plain)).toBe(0);
    const direct = (await image(scene, { maxDepth: 2 })).pixels;
    expect(mean(plain) / mean(direct)).toBeGreaterThan(1.05);
    expect(largest((await image(scene, { clampIndirect: 1e-9 })).pixels, direct)).toBeLessThan(1e-6);
    const half = mean((await image(scene, { clampIndirect: 0.05 })).pixels);
    expect(half).toBeGreaterThan(mean(direct));
    expect(half).toBeLessThan(mean(plain));
  });

  it('without caustics a mirror throws no light on the floor: as if it were black', async () => {
    const lit = mean((await image(corner(mirror), { samples: samplesOf(256, 2) })).pixels);
    const dark = mean((await image(corner(black), { samples: samplesOf(256, 2) })).pixels);
    const without = mean((await image(corner(mirror), { samples: samplesOf(256, 2), caustics: false })).pixels);
    expect(lit / dark).toBeGreaterThan(1.1);
    // What a rough mirror still gives is below the limit of sharpness: its tails.
    expect(Math.abs(without / dark - 1)).toBeLessThan(0.02);
  });

  it('limits bounces by their kind', async () => {
    const scene = corner(lambert(0.8));
    const plain = (await image(scene)).pixels;
    expect(largest((await image(scene, { maxBounces: { specular: 0, transmission: 0 } })).pixels, plain)).toBe(0);
    const direct = (await image(scene, { maxDepth: 2 })).pixels;
    expect(largest((await image(scene, { maxBounces: { diffuse: 0 } })).pixels, direct)).toBe(0);
    // One diffuse bounce, then direct light: paths of three edges.
    expect(
      largest(
        (await image(scene, { maxBounces: { diffuse: 1 } })).pixels,
        (await image(scene, { maxDepth: 3 })).pixels,
      ),
    ).toBe(0);
    // A mirror shows a lit ceiling, unless specular bounces are forbidden.
    const polished = createScene();
    addQuad(polished, 5, 0, {
      name: 'm',
      parameters: { base_metalness: 1, base_color: [1, 1, 1], specular_roughness: 0.02 },
    });
    addQuad(polished, 9, 5, lambert(0.8), { flip: true });
    polished.lights.push({ type: 'point', name: 'p', color: [1, 1, 1], intensity: 200, position: [6, 0, 4] });
    const shown = (await image(polished)).pixels;
    expect(mean(shown)).toBeGreaterThan(0.1);
    // Of a GGX lobe of slope α, α √(4π p) is where its density is below p: here 0.1 %, which counts as diffuse, and more
    // where the mirror is seen from the side.
    const forbidden = (await image(polished, { maxBounces: { specular: 0 } })).pixels;
    expect(mean(forbidden) / mean(shown)).toBeLessThan(0.004);
    // Paths of four edges that meet the mirror twice end at the ceiling, which does not shine.
    expect(largest((await image(polished, { maxBounces: { specular: 1 } })).pixels, shown)).toBe(0);
  });

  it('regularisation calms caustics and keeps nearly all of their light', async () => {
    const truth = await image(corner(mirror), { samples: samplesOf(512, 2) });
    const soft = await image(corner(mirror), { samples: samplesOf(512, 2), regularization: 0.5 });
    expect(truth.variance / soft.variance).toBeGreaterThan(2);
    // The density of a bounce off the floor is cos θ/π, and the spread of its path √(π/4π cos θ), at most 1: the wall is
    // lit as one of a roughness between √(0.5/2) and √0.5, without regularization.
    const rough = async (specular_roughness: number) =>
      image(corner({ name: 'rough', parameters: { ...mirror.parameters, specular_roughness } }), {
        samples: samplesOf(512, 2),
      });
    const [narrow, wide] = [await rough(0.5), await rough(Math.SQRT1_2)];
    // Relative standard errors of these means over eight seeds: 0.04 %, 0.07 % and 0.05 %; four of each difference's.
    expect(mean(soft.pixels) / mean(narrow.pixels)).toBeLessThan(1 + 0.0032);
    expect(mean(soft.pixels) / mean(wide.pixels)).toBeGreaterThan(1 - 0.0026);
    // The light of the mirror itself, whose standard error is 0.65 %, and whose single scattering loses less.
    expect(mean(soft.pixels) / mean(truth.pixels)).toBeLessThan(1 + 4 * 0.0065);
    // What the camera sees directly stays sharp: the first surface is not softened.
    const direct = (await image(corner(mirror), { maxDepth: 2 })).pixels;
    expect(largest((await image(corner(mirror), { maxDepth: 2, regularization: 0.5 })).pixels, direct)).toBe(0);
  });

  it.each([
    { clampIndirect: 0 },
    { clampIndirect: Number.NaN },
    { clampIndirect: Infinity },
    { regularization: 2 },
    { maxBounces: { diffuse: -1 } },
    { maxBounces: { volume: 1.5 } },
    { maxBounces: { glossy: 1 } as object },
  ])('refuses %j', async (options) => {
    await expect(PathTracer.create(device, corner(black), { width: 4, height: 4, ...options })).rejects.toMatchObject({
      code: 'renderer/option',
    });
  });
});
