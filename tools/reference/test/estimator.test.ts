import { createScene, type Environment, type Material, type Mesh, type Scene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { lookAt } from '../src/camera';
import { estimate, uniforms } from '../src/estimator/estimate';
import { imageMean } from '../src/estimator/glass-reference';
import {
  cauchyIndex,
  drawWavelength,
  paneReflectance,
  receptors,
  RED_END,
  smoothInterface,
  VIOLET_END,
} from '../src/estimator/optics';
import { box, brilliant, lathe, polygon } from '../src/estimator/shapes';
import { nearestHit, trianglesOf, type Triangle } from '../src/estimator/triangles';
import { icosphere } from '../src/furnace';

type Vector = readonly [number, number, number];

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

function add(scene: Scene, mesh: Mesh, parameters: Material['parameters'], dielectric_priority = 0): void {
  scene.instances.push({
    name: mesh.name,
    mesh: scene.meshes.push(mesh) - 1,
    material: scene.materials.push({ name: mesh.name, parameters, dielectric_priority }) - 1,
    transform: IDENTITY,
  });
}

const clear = (specular_ior: number, absorption: Vector = [0, 0, 0], more: Material['parameters'] = {}) => ({
  transmission_weight: 1,
  specular_roughness: 0,
  specular_ior,
  transmission_depth: 0.5,
  transmission_color: absorption.map((a) => Math.exp(-0.5 * a)) as unknown as Vector,
  ...more,
});

/** A wall that emits radiance 1 at z = −3, seen along a ray that leaves the z axis by the angle at the origin. */
function wall(angle: number): Scene {
  const scene = createScene();
  add(
    scene,
    polygon('wall', [
      [-30, -30, -3],
      [30, -30, -3],
      [30, 30, -3],
      [-30, 30, -3],
    ]),
    {
      // prettier-ignore
      base_weight: 0,
      specular_weight: 0,
      emission_luminance: 1,
    },
  );
  const position = [2 * Math.sin(angle), 0, 2 * Math.cos(angle)] as const;
  scene.cameras.push(
    lookAt({ position, target: [0, 0, 0], up: [0, 1, 0], yfov_deg: 1e-4, lens_radius: 0, focus_distance: 1 }),
  );
  return scene;
}

const layer = (name: string, z0: number, z1: number): Mesh => box(name, [-20, -20, z1], [20, 20, z0]);

/** Mean and standard error of each channel. */
function measure(scene: Scene, samples: number, maxDepth = 200, seed = 1): [mean: number, error: number][] {
  const { mean, standardError } = imageMean(estimate(scene, { width: 4, height: 4, samples, maxDepth, seed }));
  return mean.map((value, k) => [value, standardError[k]!]);
}

const near = ([mean, error]: readonly [number, number], expected: number): void => {
  expect(Math.abs(mean - expected)).toBeLessThan(4 * error + 1e-12);
};

/** What a stack of layers, the first of them seen first, lets through and reflects, without interference. */
interface Stack {
  readonly through: number;
  readonly back: number;
  /** Reflectance from behind. */
  readonly behind: number;
}

const interfaceStack = (n1: number, n2: number, sine: number): Stack => {
  const { reflectance } = smoothInterface(n1, n2, Math.sqrt(1 - (sine / n1) ** 2));
  return { through: 1 - reflectance, back: reflectance, behind: reflectance };
};

/** A way of an optical depth. */
const way = (depth: number): Stack => ({ through: Math.exp(-depth), back: 0, behind: 0 });

/** Adding (Stokes 1862): all reflections between two stacks. */
const join = (a: Stack, b: Stack): Stack => {
  const between = 1 / (1 - a.behind * b.back);
  return {
    through: a.through * b.through * between,
    back: a.back + a.through ** 2 * b.back * between,
    behind: b.behind + b.through ** 2 * a.behind * between,
  };
};

describe('the optics of the estimator', () => {
  it('reflects as Fresnel says at angles that are known', () => {
    expect(smoothInterface(1, 1.5, 1).reflectance).toBeCloseTo(0.04, 12);
    // Brewster's angle: half of what is polarised across.
    const brewster = Math.atan(1.5);
    expect(smoothInterface(1, 1.5, Math.cos(brewster)).reflectance).toBeCloseTo(
      0.5 * ((1.5 ** 2 - 1) / (1.5 ** 2 + 1)) ** 2,
      12,
    );
    expect(smoothInterface(1.5, 1, Math.cos(Math.asin(1 / 1.5) + 1e-9)).reflectance).toBe(1);
    expect(smoothInterface(1, 1.5, 0).reflectance).toBe(1);
    // From either side alike.
    const { reflectance, cosine } = smoothInterface(1.33, 1.5, 0.4);
    expect(smoothInterface(1.5, 1.33, cosine).reflectance).toBeCloseTo(reflectance, 12);
    // A pane as the sum of a geometric series.
    const face = 0.1;
    let [sum, left] = [face, 0.9];
    for (let k = 0; k < 100; k++) [sum, left] = [sum + left * face * 0.9, left * face * face];
    expect(paneReflectance(face)).toBeCloseTo(sum, 12);
  });

  it('has the Abbe number and the index that are asked for', () => {
    const n = (wavelength: number) => cauchyIndex(1.7, 30, wavelength);
    expect(n(587.6)).toBeCloseTo(1.7, 12);
    expect((n(587.6) - 1) / (n(486.1) - n(656.3))).toBeCloseTo(30, 9);
    expect(cauchyIndex(1.7, Infinity, 400)).toBe(1.7);
  });

  it('draws wavelengths whose weights keep what the receptors see', () => {
    const random = uniforms(3);
    const count = 200_000;
    const curves: ((wavelength: number) => number)[] = [() => 1, (l) => l / 500, (l) => Math.cos(l / 40)];
    for (const curve of curves) {
      const expected = [0, 0, 0];
      for (let l = VIOLET_END + 0.05; l < RED_END; l += 0.1)
        receptors(l).forEach((value, k) => (expected[k]! += 0.1 * value * curve(l)));
      const [sum, squares] = [
        [0, 0, 0],
        [0, 0, 0],
      ];
      for (let i = 0; i < count; i++) {
        const { wavelength, weight } = drawWavelength(random());
        weight.forEach((value, k) => {
          sum[k]! += (value * curve(wavelength)) / count;
          squares[k]! += (value * curve(wavelength)) ** 2 / count;
        });
      }
      for (const k of [0, 1, 2])
        expect(Math.abs(sum[k]! - expected[k]!)).toBeLessThan(4 * Math.sqrt((squares[k]! - sum[k]! ** 2) / count));
      if (curve === curves[0]) for (const value of expected) expect(value).toBeCloseTo(1, 5);
    }
  });
});

describe('rays of the estimator', () => {
  it('meet the triangle that all of them tested one by one give', () => {
    const scene = createScene();
    add(scene, brilliant('gem'), {});
    add(scene, lathe('cone', [[0, -1], [0.7, -0.5], [0.2, 1.5], [0, 1.6]], 11), {}); // prettier-ignore
    const triangles = trianglesOf(scene);
    const nearest = nearestHit(triangles);
    const alone = triangles.map((one: Triangle) => nearestHit([one]));
    const random = uniforms(5);
    let hits = 0;
    for (let i = 0; i < 2000; i++) {
      const origin = [3 * random() - 1.5, 3 * random() - 1.5, 3 * random() - 1.5] as const;
      const [x, y, z] = [random() - 0.5, random() - 0.5, random() - 0.5] as const;
      const length = Math.hypot(x, y, z);
      const direction = [x / length, y / length, z / length] as const;
      const distances = alone.map((one) => one(origin, direction, -1)?.distance ?? Infinity);
      const first = Math.min(...distances);
      expect(nearest(origin, direction, -1)?.distance ?? Infinity).toBe(first);
      if (first < Infinity) hits++;
    }
    expect(hits).toBeGreaterThan(300);
  });

  it('come from shapes that are closed and face outwards', () => {
    const bottle = [[0, 0], [1, 0], [1, 2], [0.8, 2], [0.8, 0.2], [0, 0.2]] as const; // prettier-ignore
    for (const [mesh, volume] of [
      [box('box', [-1, -2, -3], [1, 2, 3]), 48],
      [lathe('bottle', bottle, 6), ((3 * Math.sqrt(3)) / 2) * (2 - 0.8 ** 2 * 1.8)],
      [brilliant('gem'), undefined],
    ] as const) {
      const edges = new Set<string>();
      let sum = 0;
      for (let t = 0; t < mesh.indices.length; t += 3) {
        const corners = [0, 1, 2].map((k) => mesh.indices[t + k]!);
        const [a, b, c] = corners.map((i) => mesh.positions.subarray(3 * i, 3 * i + 3)) as [
          Float32Array,
          Float32Array,
          Float32Array,
        ];
        for (let k = 0; k < 3; k++) {
          sum += (a[k]! * (b[(k + 1) % 3]! * c[(k + 2) % 3]! - b[(k + 2) % 3]! * c[(k + 1) % 3]!)) / 6;
          edges.add(`${corners[k]},${corners[(k + 1) % 3]}`);
        }
      }
      for (const edge of edges) expect(edges.has(edge.split(',').reverse().join(','))).toBe(true);
      if (volume !== undefined) expect(sum).toBeCloseTo(volume, 5);
      else expect(sum).toBeGreaterThan(0);
    }
  });
});

describe('the estimator', () => {
  it('absorbs along the way (Beer)', () => {
    const scene = wall(0.5);
    add(scene, layer('matter', 0, -1), clear(1, [0.2, 1, 3]));
    const seen = measure(scene, 2);
    [0.2, 1, 3].forEach((a, k) => expect(seen[k]![0]).toBeCloseTo(Math.exp(-a / Math.cos(0.5)), 5));
  });

  it.each([0, 0.6, 1.2])('lets through a slab what all reflections in it leave, at %f radians', (angle) => {
    const absorption = [0, 0.3, 2] as const;
    const scene = wall(angle);
    add(scene, layer('slab', 0, -0.5), clear(1.5, absorption));
    const seen = measure(scene, 2000);
    const sine = Math.sin(angle);
    absorption.forEach((a, k) => {
      const r = smoothInterface(1, 1.5, Math.cos(angle)).reflectance;
      const kept = Math.exp((-a * 0.5) / Math.sqrt(1 - (sine / 1.5) ** 2));
      near(seen[k]!, ((1 - r) ** 2 * kept) / (1 - (r * kept) ** 2));
    });
  });

  it('knows interiors that overlap: water in glass', () => {
    const angle = 0.7;
    const scene = wall(angle);
    // Glass, water and glass; the water reaches into the glass on both sides, which is there.
    add(scene, layer('front', 0, -0.2), clear(1.52, [0.5, 0, 1]), 1);
    add(scene, layer('back', -0.8, -1), clear(1.52, [0.5, 0, 1]), 1);
    add(scene, layer('water', -0.1, -0.9), clear(1.33, [0, 0.6, 2]));
    const seen = measure(scene, 3000);
    const sine = Math.sin(angle);
    const slope = (n: number) => 1 / Math.sqrt(1 - (sine / n) ** 2);
    for (const [k, glass, water] of [
      [0, 0.5, 0],
      [1, 0, 0.6],
      [2, 1, 2],
    ] as const) {
      const { through } = [
        interfaceStack(1, 1.52, sine),
        way(glass * 0.2 * slope(1.52)),
        interfaceStack(1.52, 1.33, sine),
        way(water * 0.6 * slope(1.33)),
        interfaceStack(1.33, 1.52, sine),
        way(glass * 0.2 * slope(1.52)),
        interfaceStack(1.52, 1, sine),
      ].reduce(join);
      near(seen[k]!, through);
    }
  });

  it('knows panes that are thin-walled', () => {
    const angle = 1;
    const scene = wall(angle);
    const color = [1, 0.8, 0.3] as const;
    add(
      scene,
      polygon('pane', [
        [-9, -9, 0],
        [9, -9, 0],
        [9, 9, 0],
        [-9, 9, 0],
      ]),
      {
        // prettier-ignore
        ...clear(1.5),
        geometry_thin_walled: true,
        transmission_color: color,
      },
    );
    const seen = measure(scene, 2000);
    const { reflectance, cosine } = smoothInterface(1, 1.5, Math.cos(angle));
    color.forEach((value, k) => near(seen[k]!, ((1 - reflectance) / (1 + reflectance)) * value ** (1 / cosine)));
  });

  it('counts edges as path tracers do', () => {
    const at = (maxDepth: number) => {
      const scene = wall(0);
      add(scene, layer('slab', 0, -0.5), clear(1.5));
      return measure(scene, 1000, maxDepth);
    };
    for (const [mean] of at(2)) expect(mean).toBe(0);
    for (const seen of at(3)) near(seen, 0.96 ** 2);
    for (const seen of at(5)) near(seen, 0.96 ** 2 * (1 + 0.04 ** 2));
  });

  it.each([
    ['glass', clear(1.5)],
    ['glass with dispersion', clear(1.7, [0, 0, 0], { transmission_dispersion_scale: 1 })],
  ] as const)('shows a ball of %s in a furnace as the furnace', (_, parameters) => {
    const scene = createScene();
    add(scene, icosphere(2), parameters);
    scene.environment = { type: 'constant', radiance: [1, 1, 1] };
    scene.cameras.push(
      lookAt({
        position: [0, 1, 4],
        target: [0, 0, 0],
        up: [0, 1, 0],
        yfov_deg: 20,
        lens_radius: 0,
        focus_distance: 1,
      }),
    );
    // Chains of total reflection are long, and few.
    for (const seen of measure(scene, 500, 10_000)) near(seen, 1);
  });

  it('lights a matt floor as the view factor of a panel says', () => {
    // A square above a place on the floor, parallel to it: four quarters, each with the known view factor of its corner.
    const scene = createScene();
    const [half, height] = [0.8, 0.7];
    add(
      scene,
      polygon('floor', [
        [-5, 0, 5],
        [5, 0, 5],
        [5, 0, -5],
        [-5, 0, -5],
      ]),
      {
        // prettier-ignore
        base_color: [0.9, 0.5, 0.1],
        specular_weight: 0,
      },
    );
    const corners = [[-half, height, half], [-half, height, -half], [half, height, -half], [half, height, half]] as const; // prettier-ignore
    add(scene, polygon('panel', corners), {
      base_weight: 0,
      specular_weight: 0,
      emission_luminance: 2,
      emission_color: [1, 0.5, 2],
    });
    scene.cameras.push(
      lookAt({ position: [1, 0.5, 0], target: [0, 0, 0], up: [0, 1, 0], yfov_deg: 1e-3, lens_radius: 0, focus_distance: 1 }), // prettier-ignore
    );
    const x = half / height;
    const factor = (4 * 2 * (x / Math.sqrt(1 + x * x)) * Math.atan(x / Math.sqrt(1 + x * x))) / (2 * Math.PI);
    const seen = measure(scene, 2000);
    [0.9 * 2, 0.5 * 1, 0.1 * 4].forEach((value, k) => near(seen[k]!, value * factor));
  });

  it('refuses what it does not know', () => {
    const refused = (change: (scene: Scene) => void) => {
      const scene = wall(0);
      change(scene);
      expect(() => measure(scene, 2)).toThrow(expect.objectContaining({ code: 'reference/unsupported' }));
    };
    for (const parameters of [
      { ...clear(1.5), specular_roughness: 0.2 },
      { ...clear(1.5), coat_weight: 1 },
      { ...clear(1.5), transmission_depth: 0, transmission_color: [1, 0.5, 1] },
      { ...clear(1.5), transmission_weight: 0.5 },
      { base_color: [1, 1, 1] },
      { emission_luminance: 1, specular_weight: 0 },
    ] satisfies Material['parameters'][])
      refused((scene) => add(scene, layer('slab', 0, -1), parameters));
    refused((scene) => (scene.cameras[0] = { type: 'orthographic', name: '', transform: IDENTITY, xmag: 1, ymag: 1 }));
    refused(
      (scene) =>
        (scene.environment = { type: 'latlong', width: 2, height: 1, data: new Float32Array(6) } as Environment),
    );
    refused((scene) =>
      scene.lights.push({ type: 'point', name: '', color: [1, 1, 1], intensity: 1, position: [0, 0, 0] }),
    );
  });
});
