import type { Instance, Scene } from './scene';
import type { Mesh } from './mesh';

/** An axis-aligned box in the world, metres. Empty: min is +∞ and max −∞. */
export interface SceneBounds {
  readonly min: readonly [number, number, number];
  readonly max: readonly [number, number, number];
}

/**
 * The box around all visible triangles, exact to their vertices under their transforms. Vertices that no triangle uses do
 * not count, nor do lights and cameras.
 */
export function sceneBounds(scene: Scene): SceneBounds {
  const min: [number, number, number] = [Infinity, Infinity, Infinity];
  const max: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (const instance of scene.instances) {
    const mesh = scene.meshes[instance.mesh];
    if (instance.visible !== false && mesh) growByMesh(mesh, instance, min, max);
  }
  return { min, max };
}

function growByMesh({ positions, indices }: Mesh, { transform: m }: Instance, min: [number, number, number], max: [number, number, number]): void {
  for (const r of [0, 1, 2] as const) {
    const a = m[r] as number, b = m[4 + r] as number, c = m[8 + r] as number, d = m[12 + r] as number;
    let low = min[r], high = max[r];
    for (let i = 0; i < indices.length; i++) {
      const v = 3 * (indices[i] as number);
      const x = a * (positions[v] as number) + b * (positions[v + 1] as number) + c * (positions[v + 2] as number) + d;
      if (x < low) low = x;
      if (x > high) high = x;
    }
    min[r] = low;
    max[r] = high;
  }
}
