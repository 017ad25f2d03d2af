import {
  sceneBounds,
  type Environment,
  type Image,
  type Material,
  type Mesh,
  type Scene,
  type SceneBounds,
  type Texture,
  type TexturedParameter,
} from '@glanz/scene';
import type { State } from '../state/state';
import { placedTransform } from './placement';

/** Half the floor's width in radii of the model: so far that its edge is out of the light's reach. */
const FLOOR_RADII = 40;

/** Name of the floor's mesh, material and instance. */
export const FLOOR = 'Floor (shadows only)';

/** What the floor is made of. */
export const FLOOR_PARAMETERS = { base_color: [0.5, 0.5, 0.5], specular_weight: 0 } as const;

/** A square under the model, normal up. @param bounds Of the model. */
export function floorMesh({ min, max }: SceneBounds): Mesh {
  const radius = 0.5 * Math.hypot(max[0] - min[0], max[1] - min[1], max[2] - min[2]) || 1;
  const [x, z] = [(min[0] + max[0]) / 2, (min[2] + max[2]) / 2];
  const half = FLOOR_RADII * radius;
  // A hair lower, so that what stands on it does not lie in it.
  const y = min[1] - radius * 1e-4;
  return {
    name: FLOOR,
    positions: Float32Array.of(
      x - half,
      y,
      z + half,
      x + half,
      y,
      z + half,
      x + half,
      y,
      z - half,
      x - half,
      y,
      z - half,
    ),
    indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
  };
}

/**
 * The scene as the state says: hidden parts, edited materials, images on parameters, the floor, the environment. What
 * the model brought is shared, not copied, and indices of its parts stay.
 *
 * @param scene As loaded.
 * @param bounds Of the model, where they are known: finding them reads all vertices.
 */
export function composeScene(
  scene: Scene,
  state: State,
  environment: Environment | undefined,
  bounds?: SceneBounds,
): Scene {
  const hidden = new Set(state.hidden);
  const images: Image[] = [...scene.images];
  const textures: Texture[] = [...scene.textures];
  const materials = scene.materials.map((material, index): Material => {
    const edit = state.materials[index];
    return edit ? { ...material, parameters: { ...material.parameters, ...edit } } : material;
  });
  for (const [key, slot] of Object.entries(state.slots)) {
    const [index, name] = key.split('/') as [string, TexturedParameter];
    const material = materials[Number(index)];
    if (!material) continue;
    const { [name]: _, ...others } = material.textures ?? {};
    if (!slot) materials[Number(index)] = { ...material, textures: others };
    else {
      textures.push({ name: slot.image.name, image: images.push(slot.image) - 1, color_space: slot.color_space });
      materials[Number(index)] = {
        ...material,
        textures: { ...others, [name]: { ...slot.binding, texture: textures.length - 1 } },
      };
    }
  }
  const composed: Scene = {
    ...scene,
    images,
    textures,
    materials,
    meshes: [...scene.meshes],
    instances: scene.instances.map((instance, index) =>
      hidden.has(index) || state.moves[index]
        ? {
            ...instance,
            transform: placedTransform(scene, index, state.moves),
            ...(hidden.has(index) ? { visible: false } : {}),
          }
        : instance,
    ),
  };
  delete composed.environment;
  if (environment) composed.environment = environment;
  if (state.floor) {
    composed.materials.push({ name: FLOOR, parameters: FLOOR_PARAMETERS });
    composed.meshes.push(floorMesh(bounds ?? sceneBounds(scene)));
    composed.instances.push({
      name: FLOOR,
      mesh: composed.meshes.length - 1,
      material: composed.materials.length - 1,
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
      catcher: true,
    });
  }
  return composed;
}

/** Changes in these call for a tracer of their own: the rest are edits. */
export const needsTracer = (next: State, before: State): boolean =>
  next.slots !== before.slots || next.floor !== before.floor || next.relight !== before.relight;
