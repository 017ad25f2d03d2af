import { encodePng } from '@glanz/image/png';
import { PathTracer } from '@glanz/renderer';
import { frameCamera, sceneBounds, type Scene } from '@glanz/scene';
import { studioEnvironment } from '@glanz/scene/studio';
import { toneMapPixels } from '@glanz/tonemap';

// #region floor
/** The scene on an invisible floor that catches shadows and reflections. */
export function onFloor(scene: Scene): Scene {
  const { min, max } = sceneBounds(scene);
  const size =
    20 * Math.hypot(max[0]! - min[0]!, max[1]! - min[1]!, max[2]! - min[2]!);
  const y = min[1]! - 1e-4 * size;
  const floor = {
    name: 'floor',
    positions: Float32Array.of(
      -size,
      y,
      size,
      size,
      y,
      size,
      size,
      y,
      -size,
      -size,
      y,
      -size,
    ),
    indices: Uint32Array.of(0, 1, 2, 0, 2, 3),
  };
  return {
    ...scene,
    meshes: [...scene.meshes, floor],
    materials: [
      ...scene.materials,
      {
        name: 'floor',
        parameters: { base_color: [0.6, 0.6, 0.6], specular_roughness: 0.35 },
      },
    ],
    instances: [
      ...scene.instances,
      {
        name: 'floor',
        mesh: scene.meshes.length,
        material: scene.materials.length,
        transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
        catcher: true,
      },
    ],
    environment: scene.environment ?? studioEnvironment(),
  };
}
// #endregion floor

// #region shot
/** The product with its shadow as a PNG with alpha, for any background. */
export async function productShot(
  device: GPUDevice,
  scene: Scene,
  [width, height]: readonly [number, number],
  noise = 0.01,
): Promise<Uint8Array> {
  const camera = frameCamera(scene, {
    aspect: width / height,
    yfov: (20 * Math.PI) / 180,
    margin: 0.15,
  }); // framed without the floor
  const tracer = await PathTracer.create(device, onFloor(scene), {
    width,
    height,
    camera,
    background: 'transparent',
    filter: 'blackman-harris',
  });
  try {
    for await (const _ of tracer.render({ noise, samples: 4096 }));
    const data = toneMapPixels(await tracer.read('beauty'), width, height, {
      toneMap: 'neutral',
      output: 'uint8',
    });
    return encodePng({ width, height, data });
  } finally {
    tracer.destroy();
  }
}
// #endregion shot
