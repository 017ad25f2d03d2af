import type { Light, Scene } from '@glanz/scene';
import type { GltfLight } from './json';
import type { Matrix } from './matrix';

/** Adds a light of KHR_lights_punctual to the scene; an invalid one is left out, with a warning. */
export function readLight(light: GltfLight, nodeName: string, m: Matrix, scene: Scene): void {
  const { type, intensity, color = [1, 1, 1], spot } = light;
  const name = light.name || nodeName || `light ${scene.lights.length}`;
  const axis = [m[8], m[9], m[10]] as [number, number, number];
  const length = Math.hypot(...axis);
  if (!(intensity >= 0 && intensity < Infinity) || !color.every((c) => c >= 0 && c < Infinity) || !(length > 0)) {
    scene.warnings.push({
      code: 'gltf/light',
      message: `Light "${name}" has an invalid intensity, colour or direction; it is left out.`,
    });
    return;
  }
  const position = [m[12], m[13], m[14]] as [number, number, number];
  // Lights shine along their −Z.
  const direction = [-axis[0] / length, -axis[1] / length, -axis[2] / length] as const;
  let made: Light;
  if (type === 'point') made = { type, name, color, intensity, position };
  else if (type === 'directional') made = { type, name, color, intensity, direction };
  else {
    const outer_cone_angle = Math.min(Math.max(spot?.outerConeAngle ?? Math.PI / 4, 1e-4), Math.PI / 2);
    const inner_cone_angle = Math.min(Math.max(spot?.innerConeAngle ?? 0, 0), outer_cone_angle);
    made = { type: 'spot', name, color, intensity, position, direction, inner_cone_angle, outer_cone_angle };
  }
  scene.lights.push(made);
}
