import { compose, wgslModule } from '@glanz/wgsl';
import { expectNoGpuErrors, runCompute, testDevice } from '@glanz/gpu';
import type { Environment, Material, Scene } from '@glanz/scene';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { PathTracer, type PathTracerOptions } from '../../src/index';
import dispersion from '../../src/integrator/dispersion.wesl';
import randomNumbers from '../../src/random/random.wesl';
import { addSphere, camera, createScene, meanOf, middle } from '../scenes';

type Vector = readonly [number, number, number];

let device: GPUDevice;
beforeAll(async () => {
  device = await testDevice();
});
afterAll(() => expectNoGpuErrors());

const FULL = process.env['GLANZ_FULL'] !== undefined;
const SIZE = 8;
/** Sees glass everywhere. */
const inner = middle(0.5);
const SPECTRUM = Array.from({ length: 401 }, (_, i) => 380 + i);

/**
 * CIE 1931 in Wyman, Sloan and Shirley's fit ("Simple Analytic Approximations to the CIE XYZ Color Matching Functions",
 * JCGT 2013), to linear sRGB, positive parts, each with the integral 1.
 */
function matchingCurves(): number[][] {
  const lobe = (x: number, m: number, s1: number, s2: number) => Math.exp(-0.5 * ((x - m) * (x < m ? s1 : s2)) ** 2);
  const xyz = SPECTRUM.map(
    (l) =>
      [
        0.362 * lobe(l, 442, 0.0624, 0.0374) +
          1.056 * lobe(l, 599.8, 0.0264, 0.0323) -
          0.065 * lobe(l, 501.1, 0.049, 0.0382),
        0.821 * lobe(l, 568.8, 0.0213, 0.0247) + 0.286 * lobe(l, 530.9, 0.0613, 0.0322),
        1.217 * lobe(l, 437, 0.0845, 0.0278) + 0.681 * lobe(l, 459, 0.0385, 0.0725),
      ] as const,
  );
  const matrix = [
    [3.2404542, -1.5371385, -0.4985314],
    [-0.969266, 1.8760108, 0.041556],
    [0.0556434, -0.2040259, 1.0572252],
  ] as const;
  return matrix.map((row) => {
    const curve = xyz.map((v) => Math.max(0, row[0] * v[0] + row[1] * v[1] + row[2] * v[2]));
    const sum = curve.reduce((a, b) => a + b);
    return curve.map((value) => value / sum);
  });
}

/** The receptors as documented, per nm at the wavelengths of the spectrum. */
function receptors(): number[][] {
  const logistic = (m: number, s: number) => {
    const curve = SPECTRUM.map((l) => 1 / Math.cosh((l - m) / (2 * s)) ** 2);
    const sum = curve.reduce((a, b) => a + b);
    return curve.map((value) => value / sum);
  };
  const violet = logistic(439, 7);
  return [
    logistic(607.3, 16.6).map((value, i) => 0.958 * value + 0.042 * violet[i]!),
    logistic(539.5, 18.3),
    logistic(451.8, 13.8),
  ];
}

const PAIRS = 16384;

/** Wavelengths drawn, and what is carried on. */
async function draw(throughput: Vector): Promise<{ wavelength: number; carried: Vector }[]> {
  const host = wgslModule(
    'test/host',
    `struct TestFrame { seed: u32 }
var<private> frame: TestFrame;
@group(0) @binding(0) var<storage, read> throughput: array<f32>;
@group(0) @binding(1) var<storage, read_write> result: array<vec4f>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  let drawn = dispersion_sample(3u, id.x, vec3f(throughput[0], throughput[1], throughput[2]));
  result[id.x] = vec4f(drawn.throughput, drawn.wavelength);
}`,
    [dispersion, randomNumbers],
  );
  const numbers = new Float32Array(
    await runCompute(device, compose([host], { flags: { SOBOL: true, SCREEN_NOISE: false } }).code, {
      inputs: [new Float32Array(throughput)],
      outputBytes: PAIRS * 16,
      workgroups: PAIRS / 64,
    }),
  );
  return Array.from({ length: PAIRS }, (_, i) => ({
    carried: [numbers[4 * i]!, numbers[4 * i + 1]!, numbers[4 * i + 2]!],
    wavelength: numbers[4 * i + 3]!,
  }));
}

describe('wavelengths', () => {
  it('are drawn as the receptors answer, and the path carries on average what it did, never more in sum', async () => {
    for (const throughput of [
      [1, 1, 1],
      [0.2, 0.9, 0.4],
      [0, 0, 2],
      [0.5, 0, 0.1],
    ] as const) {
      const total = throughput[0] + throughput[1] + throughput[2];
      const drawn = await draw(throughput);
      const wavelengths = drawn.map(({ wavelength }) => wavelength);
      expect(Math.min(...wavelengths)).toBeGreaterThanOrEqual(380);
      expect(Math.max(...wavelengths)).toBeLessThanOrEqual(780);
      const errors = drawn.map(({ carried: [r, g, b] }) => Math.abs(r + g + b - total));
      expect(Math.max(...errors)).toBeLessThan(5e-5);
      // Sobol points integrate these smooth functions to far better than 1/√N.
      for (const k of [0, 1, 2] as const)
        expect(drawn.reduce((sum, { carried }) => sum + carried[k], 0) / PAIRS).toBeCloseTo(throughput[k], 2);
    }
  });

  it('the receptors are close to the matching curves of sRGB', async () => {
    const drawn = await draw([1, 1, 1]);
    const curves = matchingCurves();
    for (const k of [0, 1, 2] as const) {
      const seen = new Float64Array(81);
      const expectedBins = new Float64Array(81);
      for (const { wavelength, carried } of drawn) seen[Math.floor((wavelength - 380) / 5)]! += carried[k] / PAIRS;
      curves[k]!.forEach((value, i) => (expectedBins[Math.floor(i / 5)]! += value));
      // Half the sum of differences: the share of the answer that lies elsewhere.
      expect(0.5 * seen.reduce((sum, value, i) => sum + Math.abs(value - expectedBins[i]!), 0)).toBeLessThan(0.08);
      const mean = (values: Float64Array) => values.reduce((sum, value, i) => sum + value * (382.5 + 5 * i), 0);
      expect(Math.abs(mean(seen) - mean(expectedBins))).toBeLessThan(2);
    }
  });
});

async function image(scene: Scene, samples: number, options: Partial<PathTracerOptions> = {}): Promise<Float32Array> {
  const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera: inner, ...options });
  try {
    for await (const progress of tracer.render({ samples })) void progress;
    return await tracer.read('beauty');
  } finally {
    tracer.destroy();
  }
}

const glass = (parameters: Material['parameters']): Material => ({
  name: 'glass',
  parameters: { transmission_weight: 1, specular_roughness: 0, specular_ior: 1.5, ...parameters },
});

/** Cauchy's law through n at 587.6 nm, from the definition of the Abbe number. */
function cauchy(n: number, abbe: number, wavelength: number): number {
  const b = (n - 1) / abbe / (486.1 ** -2 - 656.3 ** -2);
  return n + b * (wavelength ** -2 - 587.6 ** -2);
}

/** Environment whose radiance goes up with the azimuth around −z. */
function ramp(): Environment {
  const [width, height] = [512, 8];
  const data = new Float32Array(width * height * 3);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      data.fill(
        Math.max(0, 10 * ((x + 0.5) / width - 0.24)) * Number(x < width / 2),
        3 * (y * width + x),
        3 * (y * width + x) + 3,
      );
  return { type: 'latlong', width, height, data };
}

describe('dispersion', () => {
  it('spreads light by a prism as Snell and Cauchy say', async () => {
    const [n, abbe, apex] = [1.5, 6, Math.PI / 6];
    const scene = { ...createScene(), environment: ramp() };
    // A wedge: its front square to the view, its back turned by the apex angle, thicker to the right.
    const t = Math.tan(apex);
    scene.meshes.push({
      name: 'wedge',
      positions: new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 1, -1, -2 * t, 1, 1, -2 * t]),
      indices: new Uint32Array([0, 1, 2, 0, 2, 3, 0, 3, 5, 0, 5, 4, 1, 4, 5, 1, 5, 2, 0, 4, 1, 3, 2, 5]),
    });
    scene.materials.push(
      glass({ specular_ior: n, transmission_dispersion_scale: 1, transmission_dispersion_abbe_number: abbe }),
    );
    scene.instances.push({
      name: 'wedge',
      mesh: 0,
      material: 0,
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
    });
    const seen = meanOf(
      await image(scene, 1024, { maxDepth: 3, camera: { ...camera, yfov: 1e-4 }, multipleScattering: false }),
      SIZE,
      0,
      0,
      SIZE,
      SIZE,
    );
    const fresnel = (eta: number, cosine: number) => {
      const g = Math.sqrt(eta * eta - 1 + cosine * cosine);
      return (
        0.5 *
        ((g - cosine) / (g + cosine)) ** 2 *
        (1 + ((cosine * (g + cosine) - 1) / (cosine * (g - cosine) + 1)) ** 2)
      );
    };
    // The ray leaves in the plane y = 0, towards the thick side: to the right of −z.
    const arriving = SPECTRUM.map((wavelength) => {
      const index = cauchy(n, abbe, wavelength);
      const out = Math.asin(index * Math.sin(apex));
      const turn = out - apex;
      const azimuth = Math.atan2(-Math.cos(turn), Math.sin(turn)) / (2 * Math.PI) + 0.5;
      return Math.max(0, 10 * (azimuth - 0.24)) * (1 - fresnel(index, 1)) * (1 - fresnel(index, Math.cos(out)));
    });
    receptors().forEach((receptor, k) => {
      const expected = receptor.reduce((sum, value, i) => sum + value * arriving[i]!, 0);
      expect(Math.abs(seen[k]! / expected - 1)).toBeLessThan(0.01);
    });
    // Blue is bent more than red by far more than the tolerance.
    expect(Math.abs(seen[2] / seen[0] - 1)).toBeGreaterThan(0.05);
  });

  // Forty images; without GLANZ_FULL the prism says whether colours are bent as they should be.
  it.runIf(FULL)(
    'is the sum of images in many wavelengths',
    async () => {
      const scene = (parameters: Material['parameters']): Scene => {
        const made = { ...createScene(), environment: ramp() };
        addSphere(made, 0.9, [0, 0, 0], glass(parameters), 64);
        return made;
      };
      const [n, abbe] = [1.6, 8];
      const region = [0, 0, SIZE, SIZE] as const;
      const options = { maxDepth: 6 };
      const dispersed: Vector[] = [];
      for (let seed = 0; seed < 6; seed++)
        dispersed.push(
          meanOf(
            await image(
              scene({ specular_ior: n, transmission_dispersion_scale: 1, transmission_dispersion_abbe_number: abbe }),
              256,
              { ...options, seed },
            ),
            SIZE,
            ...region,
          ),
        );
      const curves = receptors();
      const sum = [0, 0, 0];
      const squares = [0, 0, 0];
      // Every twentieth wavelength stands for those around it; two seeds each tell how noisy it is.
      for (let i = 10; i < 401; i += 20) {
        const weights = curves.map((curve) => curve.slice(i - 10, i + 10).reduce((a, b) => a + b));
        if (Math.max(...weights) < 1e-3) continue;
        const pair: Vector[] = [];
        for (const seed of [1, 2])
          pair.push(
            meanOf(
              await image(scene({ specular_ior: cauchy(n, abbe, 380 + i) }), 64, { ...options, seed: 100 * seed + i }),
              SIZE,
              ...region,
            ),
          );
        for (const k of [0, 1, 2] as const) {
          sum[k]! += (weights[k]! * (pair[0]![k] + pair[1]![k])) / 2;
          squares[k]! += ((weights[k]! * (pair[0]![k] - pair[1]![k])) / 2) ** 2;
        }
      }
      for (const k of [0, 1, 2] as const) {
        const mean = dispersed.reduce((a, v) => a + v[k], 0) / dispersed.length;
        const variance =
          dispersed.reduce((a, v) => a + (v[k] - mean) ** 2, 0) / (dispersed.length - 1) / dispersed.length;
        // Four standard errors of both, and 0.2 % for the steps of 20 nm.
        expect(Math.abs(mean - sum[k]!)).toBeLessThan(4 * Math.sqrt(variance + squares[k]!) + 0.002 * sum[k]!);
      }
      // The same without dispersion is another image: the comparison can fail.
      const plain = meanOf(await image(scene({ specular_ior: n }), 512, options), SIZE, ...region);
      expect(Math.abs(plain[2] - sum[2]!)).toBeGreaterThan(0.01 * sum[2]!);
    },
    120_000,
  );

  it('leaves white light white', async () => {
    const scene: Scene = { ...createScene(), environment: { type: 'constant', radiance: [1, 1, 1] } };
    addSphere(
      scene,
      0.8,
      [0, 0, 0],
      glass({ transmission_dispersion_scale: 1, transmission_dispersion_abbe_number: 10, specular_roughness: 0.2 }),
      64,
    );
    const seen = meanOf(await image(scene, 512, { maxDepth: 48 }), SIZE, 0, 0, SIZE, SIZE);
    for (const value of seen) expect(Math.abs(value - 1)).toBeLessThan(0.01);
  });

  it('comes with an edit, and goes', async () => {
    const scene: Scene = { ...createScene(), environment: ramp() };
    addSphere(scene, 0.9, [0, 0, 0], glass({}), 32);
    const tracer = await PathTracer.create(device, scene, { width: SIZE, height: SIZE, camera: inner });
    const colour = async () => {
      for await (const progress of tracer.render({ samples: 256 })) void progress;
      const [r, , b] = meanOf(await tracer.read('beauty'), SIZE, 0, 0, SIZE, SIZE);
      return Math.abs(r / b - 1);
    };
    expect(await colour()).toBeLessThan(1e-5);
    await tracer.setMaterial('glass', { transmission_dispersion_scale: 1, transmission_dispersion_abbe_number: 5 });
    expect(await colour()).toBeGreaterThan(1e-3);
    await tracer.setMaterial('glass', { transmission_dispersion_scale: 0 });
    expect(await colour()).toBeLessThan(1e-5);
    tracer.destroy();
  });
});
