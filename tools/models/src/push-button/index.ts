import { createScene, type PerspectiveCamera, type Scene } from '@glanz/scene';
import { cross, subtract } from 'gl-matrix/esm/vec3.js';
import { MeshBuilder } from '../shapes/mesh-builder';
import type { Tessellation } from '../shapes/tessellation';
import { CONTACT_BLOCKS } from './contact-block';
import { FRONT } from './front';
import { MATERIALS, type MaterialName } from './materials';
import { MOUNT } from './mount';
import { placementMatrix, type Part } from './part';

/** How fine the push-button is: about 1,068,735, 106,873 or 10,687 triangles. */
export type PushButtonLevel = 'high' | 'medium' | 'low';

/** The tessellation behind each level, found by search so that the counts come within 1 % of the wanted ones. */
export const PUSH_BUTTON_LEVELS: Readonly<Record<PushButtonLevel, Tessellation>> = {
  high: { deviation: 0.00101, angle: 0.2 },
  medium: { deviation: 0.017, angle: 0.53 },
  low: { deviation: 0.1165, angle: 0.8 },
};

const PARTS: readonly Part[] = [...FRONT, ...MOUNT, ...CONTACT_BLOCKS];

/** A camera at `eye` that looks at `target`, metres. */
function lookAt(
  eye: readonly [number, number, number],
  target: readonly [number, number, number],
  yfov: number,
): PerspectiveCamera {
  const back = subtract([0, 0, 0], eye, target);
  const distance = Math.hypot(...back);
  const z = back.map((value) => value / distance) as [number, number, number];
  const flat = Math.hypot(z[0], z[2]);
  const x = [z[2] / flat, 0, -z[0] / flat] as const;
  const y = cross([0, 0, 0], z, x);
  return {
    type: 'perspective',
    name: 'Product view',
    transform: [...x, 0, ...y, 0, ...z, 0, ...eye, 1],
    yfov,
    focus_distance: distance,
  };
}

/** A scene of parts, one mesh each, with the product view. */
export function assemble(name: string, parts: readonly Part[], tessellation: Tessellation): Scene {
  const scene = createScene(name);
  const materials = new Map<MaterialName, number>();
  for (const part of parts) {
    const builder = new MeshBuilder();
    part.shape(builder, tessellation);
    let material = materials.get(part.material);
    if (material === undefined) {
      material = scene.materials.length;
      materials.set(part.material, material);
      scene.materials.push(structuredClone(MATERIALS[part.material]));
    }
    scene.instances.push({
      name: part.name,
      mesh: scene.meshes.length,
      material,
      transform: placementMatrix(part.placement),
    });
    scene.meshes.push(builder.build(part.name));
  }
  scene.cameras.push(lookAt([0.137, 0.075, 0.094], [0.002, 0.0005, -0.0215], (25.5 * Math.PI) / 180));
  return scene;
}

/** {@link createPushButton} with a tessellation of one's own. */
export const buildPushButton = (tessellation: Tessellation): Scene =>
  assemble('Illuminated push-button', PARTS, tessellation);

/**
 * An illuminated industrial push-button, 22 mm, taken apart into named solids: bezel, light ring, lens with its sign,
 * seal, mounting plate, threaded barrel, washer, collar nut, flange, latch, springs, three contact blocks with
 * terminals, screws with slots and threads, wires. Every part is a closed mesh of its own with normals, tessellated the
 * way CAD exporters do it: long triangles along straight runs, many where surfaces bend. Metres; the button faces +z.
 *
 * @example
 * const scene = createPushButton({ level: 'medium' });
 */
export function createPushButton(options: { readonly level?: PushButtonLevel } = {}): Scene {
  return buildPushButton(PUSH_BUTTON_LEVELS[options.level ?? 'medium']);
}
