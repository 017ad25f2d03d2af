import { createPushButton } from '@glanz/models';
import { createScene, type Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { createSpheres, sphere } from '../../examples/spheres';

/** The scenes that live images on the site show. */
export type LiveSceneName = 'push-button' | 'spheres' | 'sphere' | 'material';

/** One large sphere of material `sphere`, above a matt table: for turning parameters. */
function createSphere(): Scene {
  const scene = createScene('Sphere');
  scene.meshes = [
    sphere(64),
    {
      name: 'table',
      positions: Float32Array.of(-300, -1, 300, 300, -1, 300, 300, -1, -300, -300, -1, -300),
      indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
    },
  ];
  scene.materials = [
    { name: 'sphere', parameters: {} },
    { name: 'table', parameters: { base_color: [0.24, 0.24, 0.25], specular_roughness: 0.5 } },
  ];
  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  scene.instances = [0, 1].map((i) => ({
    name: ['sphere', 'table'][i] as string,
    mesh: i,
    material: i,
    transform: identity,
  }));
  scene.cameras = [
    {
      type: 'perspective',
      name: 'front',
      yfov: 0.42,
      transform: [1, 0, 0, 0, 0, 0.96, -0.28, 0, 0, 0.28, 0.96, 0, 0, 1.75, 6.4, 1],
    },
  ];
  scene.environment = studioEnvironment();
  return scene;
}

/** The same above a table of light and dark squares, which show how the sphere transmits and refracts light. */
function createMaterialScene(): Scene {
  const scene = createSphere();
  const [sphereMesh, table] = scene.meshes as [Scene['meshes'][number], Scene['meshes'][number]];
  scene.meshes = [sphereMesh, { ...table, uvs: [Float32Array.of(0, 600, 600, 600, 600, 0, 0, 0)] }];
  const [light, dark] = [150, 92];
  const square = (code: number) => [code, code, code, 255];
  scene.images = [
    { name: 'squares', width: 2, height: 2, data: Uint8Array.from([light, dark, dark, light].flatMap(square)) },
  ];
  scene.textures = [{ image: 0, color_space: 'srgb', filter: 'nearest' }];
  scene.materials[1] = {
    name: 'table',
    parameters: { base_color: [1, 1, 1], specular_roughness: 0.5 },
    textures: { base_color: { texture: 0, channels: 'rgb' } },
  };
  return scene;
}

/** A scene by name, made on the spot. */
export function createLiveScene(name: LiveSceneName): Scene {
  if (name === 'spheres') return createSpheres();
  if (name === 'sphere') return createSphere();
  if (name === 'material') return createMaterialScene();
  return { ...createPushButton({ level: 'low' }), environment: studioEnvironment() };
}
