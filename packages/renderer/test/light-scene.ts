import { studioEnvironment } from '@glanz/scene/studio';
import { addQuad, addSphere, createScene, lambert } from './scenes';
import type { Scene } from '@glanz/scene';

const moved = (x: number, y: number, z: number) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1];

/** A floor, and a light of each kind: emissive meshes, one mirrored and one two-sided, the lights of a scene, an environment. */
export function allLights(environment = true): Scene {
  const scene = createScene();
  addQuad(scene, 2, -1, lambert(0.5));
  const glow = (name: string, emission_luminance: number, double_sided = false) => ({
    name,
    parameters: { base_weight: 0, specular_weight: 0, emission_luminance },
    ...(double_sided ? { double_sided } : {}),
  });
  addQuad(scene, 0.3, 0, glow('front', 9), { transform: moved(-1, 0, 1) });
  addQuad(scene, 0.2, 0, glow('both', 7, true), { transform: moved(1, 0.5, 1) });
  addQuad(scene, 0.3, 0, glow('mirrored', 8), { transform: [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5, -1, 1.2, 1] });
  addSphere(scene, 0.2, [0, 1.5, 1], glow('ball', 5), 8);
  const white = [1, 0.9, 0.8] as const;
  const direction = [0.1, 0.2, -1] as const;
  scene.lights.push(
    { type: 'point', name: 'point', position: [-1, 1, 1], color: white, intensity: 2 },
    {
      type: 'rectangle',
      name: 'rectangle',
      position: [1, 1, 2],
      direction,
      width: 0.5,
      height: 0.4,
      color: white,
      intensity: 3,
    },
    {
      type: 'spot',
      name: 'spot',
      position: [0, -1, 2],
      direction,
      color: white,
      intensity: 4,
      inner_cone_angle: 0.3,
      outer_cone_angle: 0.6,
    },
    { type: 'sphere', name: 'sphere', position: [-1.2, -1, 1.5], radius: 0.2, color: white, intensity: 5 },
    { type: 'directional', name: 'sun', direction: [0.3, 0.1, -1], color: white, intensity: 1 },
    { type: 'disk', name: 'disk', position: [0.5, 1.5, 1.5], direction, radius: 0.3, color: white, intensity: 2 },
    {
      type: 'profile',
      name: 'profile',
      position: [0, 0.5, 2],
      direction,
      color: white,
      intensity: 1,
      profile: {
        vertical: new Float32Array([0, 0.8, 1.6]),
        horizontal: new Float32Array([0]),
        intensities: new Float32Array([3, 2, 0]),
      },
    },
  );
  if (environment) scene.environment = studioEnvironment();
  return scene;
}
