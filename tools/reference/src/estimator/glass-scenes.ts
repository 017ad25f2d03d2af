import { createScene, type Material, type Mesh, type Scene } from '@glanz/scene';
import { lookAt } from '../camera';
import { box, brilliant, lathe, polygon } from './shapes';

/** A scene with what its image is rendered with. */
export interface GlassScene {
  readonly scene: Scene;
  /** Pixels. */
  readonly width: number;
  readonly height: number;
  /** Maximum number of edges of a path, see `PathTracerOptions.maxDepth`. */
  readonly maxDepth: number;
}

type Color = readonly [number, number, number];

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

const matt = (name: string, base_color: Color): Material => ({
  name,
  parameters: { base_color, specular_weight: 0 },
});

const emitter = (name: string, emission_color: Color, emission_luminance: number): Material => ({
  name,
  parameters: { base_weight: 0, specular_weight: 0, emission_color, emission_luminance },
});

const glass = (name: string, specular_ior: number, parameters: Material['parameters'], priority = 0): Material => ({
  name,
  parameters: { transmission_weight: 1, specular_roughness: 0, specular_ior, ...parameters },
  dielectric_priority: priority,
});

/** Adds a mesh with the material, which may be there already. */
function add(scene: Scene, mesh: Mesh, material: Material, transform: readonly number[] = IDENTITY): void {
  const found = scene.materials.indexOf(material);
  scene.instances.push({
    name: mesh.name,
    mesh: scene.meshes.push(mesh) - 1,
    material: found < 0 ? scene.materials.push(material) - 1 : found,
    transform,
  });
}

/** A rectangle whose front faces a point. */
function panel(name: string, [x, y, z]: Color, towards: Color, width: number, height: number): Mesh {
  const [dx, dy, dz] = [towards[0] - x, towards[1] - y, towards[2] - z];
  const [flat, length] = [Math.hypot(dx, dz), Math.hypot(dx, dy, dz)];
  const right = [dz / flat, 0, -dx / flat].map((value) => (value * width) / 2);
  const up = [(-dy * dx) / flat, flat, (-dy * dz) / flat].map((value) => (value * height) / 2 / length);
  const corner = (a: number, b: number): Color => [
    x + a * right[0]! + b * up[0]!,
    y + a * right[1]! + b * up[1]!,
    z + a * right[2]! + b * up[2]!,
  ];
  return polygon(name, [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)]);
}

const view = (position: Color, target: Color, yfov_deg: number) =>
  lookAt({ position, target, up: [0, 1, 0], yfov_deg, lens_radius: 0, focus_distance: 1 });

/**
 * A room that is lit through a window: an area light of 1.6 m outside in an even sky. The left half of the window has
 * two solid panes, tinted, the right one thin-walled pane.
 */
function windowScene(): GlassScene {
  const scene = createScene('window');
  const white = matt('white', [0.75, 0.75, 0.75]);
  const [near, far] = [1.5, -1.2];
  const wall = (name: string, x0: number, y0: number, x1: number, y1: number) =>
    add(scene, polygon(name, [[x0, y0, far], [x1, y0, far], [x1, y1, far], [x0, y1, far]]), white); // prettier-ignore
  add(scene, polygon('floor', [[-1, 0, near], [1, 0, near], [1, 0, far], [-1, 0, far]]), matt('wood', [0.7, 0.6, 0.5])); // prettier-ignore
  add(scene, polygon('ceiling', [[-1, 2, far], [1, 2, far], [1, 2, near], [-1, 2, near]]), white); // prettier-ignore
  add(scene, polygon('back', [[1, 0, near], [-1, 0, near], [-1, 2, near], [1, 2, near]]), white); // prettier-ignore
  add(scene, polygon('left', [[-1, 0, near], [-1, 0, far], [-1, 2, far], [-1, 2, near]]), matt('red', [0.6, 0.25, 0.2])); // prettier-ignore
  add(scene, polygon('right', [[1, 0, far], [1, 0, near], [1, 2, near], [1, 2, far]]), matt('green', [0.25, 0.5, 0.3])); // prettier-ignore
  wall('below', -1, 0, 1, 0.6);
  wall('above', -1, 1.8, 1, 2);
  wall('beside left', -1, 0.6, -0.8, 1.8);
  wall('beside right', 0.8, 0.6, 1, 1.8);
  wall('bar', -0.05, 0.6, 0.05, 1.8);
  const solid = glass('solid pane', 1.5, { transmission_color: [0.7, 0.9, 0.8], transmission_depth: 0.05 });
  add(scene, box('inner pane', [-0.85, 0.55, far - 0.05], [-0.01, 1.85, far - 0.03]), solid);
  add(scene, box('outer pane', [-0.85, 0.55, far - 0.11], [-0.01, 1.85, far - 0.09]), solid);
  const [x0, x1, z] = [0.01, 0.85, far - 0.04];
  add(
    scene,
    polygon('thin pane', [[x0, 0.55, z], [x1, 0.55, z], [x1, 1.85, z], [x0, 1.85, z]]), // prettier-ignore
    glass('thin pane', 1.5, { geometry_thin_walled: true, transmission_color: [0.95, 0.85, 0.7] }),
  );
  add(scene, panel('lamp', [0, 1.9, far - 0.85], [0, 0.6, 0.3], 1.6, 1.6), emitter('lamp', [1, 0.85, 0.6], 12));
  scene.environment = { type: 'constant', radiance: [0.5, 0.7, 1] };
  scene.cameras.push(view([0.35, 1.15, 1.35], [-0.1, 0.65, -1.2], 62));
  return { scene, width: 40, height: 24, maxDepth: 14 };
}

/** A bottle of tinted glass, half full of a coloured liquid whose body overlaps the glass, before a bright panel. */
function bottleScene(): GlassScene {
  const scene = createScene('bottle');
  add(scene, polygon('table', [[-2, 0, 1], [2, 0, 1], [2, 0, -1.2], [-2, 0, -1.2]]), matt('table', [0.6, 0.6, 0.6])); // prettier-ignore
  const sides = 20;
  add(
    scene,
    lathe(
      'bottle',
      [
        [0, 0.001],
        [0.2, 0.001],
        [0.2, 0.5],
        [0.07, 0.68],
        [0.07, 0.85],
        [0.05, 0.85],
        [0.05, 0.67],
        [0.17, 0.49],
        [0.17, 0.05],
        [0, 0.05],
      ],
      sides,
    ),
    glass('glass', 1.52, { transmission_color: [0.8, 0.95, 0.85], transmission_depth: 0.1 }, 1),
  );
  add(
    scene,
    lathe('liquid', [[0, 0.03], [0.185, 0.03], [0.185, 0.4], [0, 0.4]], sides), // prettier-ignore
    glass('liquid', 1.36, { transmission_color: [0.85, 0.45, 0.15], transmission_depth: 0.2 }),
  );
  add(scene, panel('panel', [1.5, 1, -0.3], [0, 0.3, 0], 1.2, 1.4), emitter('panel', [1, 0.95, 0.9], 6));
  scene.environment = { type: 'constant', radiance: [0.3, 0.35, 0.4] };
  scene.cameras.push(view([-0.35, 0.75, 1.7], [0.02, 0.38, 0], 34));
  return { scene, width: 32, height: 32, maxDepth: 24 };
}

/** A cut stone of index 2.4 with strong dispersion, tilted over a table, under two panels. */
function gemScene(): GlassScene {
  const scene = createScene('gem');
  add(scene, polygon('table', [[-4, 0, 3], [4, 0, 3], [4, 0, -4], [-4, 0, -4]]), matt('table', [0.5, 0.5, 0.5])); // prettier-ignore
  const [c, s] = [Math.cos(0.6), Math.sin(0.6)];
  const [turn, back] = [Math.cos(0.15), Math.sin(0.15)];
  // Turned around y, then tilted around x towards the camera.
  add(
    scene,
    brilliant('gem'),
    glass('gem', 2.4, { transmission_dispersion_scale: 1, transmission_dispersion_abbe_number: 15 }),
    [turn, -s * -back, c * -back, 0, 0, c, s, 0, back, -s * turn, c * turn, 0, 0, 1, 0, 1],
  );
  add(scene, panel('left', [-2.2, 1.9, 0.3], [0, 0.8, 0], 2.2, 2.2), emitter('left', [1, 0.95, 0.85], 3));
  add(scene, panel('right', [1.9, 2.4, 0.5], [0, 0.8, 0], 1.6, 1.6), emitter('right', [0.8, 0.9, 1], 5));
  scene.environment = { type: 'constant', radiance: [0.15, 0.15, 0.2] };
  scene.cameras.push(view([0.3, 3, 4.2], [0, 0.75, 0], 30));
  return { scene, width: 32, height: 32, maxDepth: 32 };
}

const SCENES = { window: windowScene, bottle: bottleScene, gem: gemScene } as const;

/** Names of the scenes of {@link glassScene}. */
export type GlassSceneName = keyof typeof SCENES;

/** See {@link glassScene}. */
export const GLASS_SCENES = Object.keys(SCENES) as readonly GlassSceneName[];

/**
 * A scene whose reference is an image of `estimate`:
 * - `window`: a room lit through panes, solid and thin-walled, by an area light outside;
 * - `bottle`: glass with a liquid in it, which overlaps the glass (nested dielectrics);
 * - `gem`: a cut stone with dispersion.
 */
export const glassScene = (name: GlassSceneName): GlassScene => SCENES[name]();
