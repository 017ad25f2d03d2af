import { encodeExr } from '@glanz/image/exr';
import { PathTracer } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';

// #region mask
/** Mask of one part: 0 or 1 per pixel. */
export async function maskOf(
  tracer: PathTracer,
  name: string,
): Promise<Uint8Array> {
  const requested = new Set(
    tracer.scene.instances.flatMap((instance, index) =>
      instance.name === name ? [index] : [],
    ),
  );
  return Uint8Array.from(await tracer.read('objectId'), (id) =>
    requested.has(id) ? 1 : 0,
  );
}
// #endregion mask

// #region exr
const channel = (rgba: Float32Array, offset: number) =>
  Float32Array.from(
    { length: rgba.length / 4 },
    (_, i) => rgba[4 * i + offset]!,
  );

export async function toExr(tracer: PathTracer): Promise<Uint8Array> {
  const beauty = await tracer.read('beauty');
  const normal = await tracer.read('normal');
  return encodeExr({
    width: tracer.width,
    height: tracer.height,
    layers: [
      {
        name: '',
        channels: {
          R: channel(beauty, 0),
          G: channel(beauty, 1),
          B: channel(beauty, 2),
          A: channel(beauty, 3),
        },
      },
      {
        name: 'normal',
        channels: {
          X: channel(normal, 0),
          Y: channel(normal, 1),
          Z: channel(normal, 2),
        },
      },
      {
        name: 'depth',
        type: 'float',
        channels: { Z: await tracer.read('depth') },
      },
      {
        name: 'objectId',
        type: 'uint',
        channels: { id: await tracer.read('objectId') },
      },
    ],
  });
}
// #endregion exr

// #region aovs
export async function guidesOf(device: GPUDevice, scene: Scene) {
  const tracer = await PathTracer.create(device, scene, {
    width: 800,
    height: 600,
    aovs: ['albedo', 'normal'],
  });
  for await (const _ of tracer.render({ samples: 16 }));
  // Channel c of pixel i: buffer[stride * i + offset + c], 32-bit floats
  return [tracer.aov('albedo'), tracer.aov('normal')];
}
// #endregion aovs

// #region lights
export async function withLightGroups(device: GPUDevice, scene: Scene) {
  const tracer = await PathTracer.create(device, scene, {
    width: 800,
    height: 600,
    lightGroups: 'each',
  });
  for await (const _ of tracer.render({ samples: 256 }));
  // environment, lamp, screen, …
  for (const { name } of tracer.lightGroups) console.log(name);
  await tracer.setLightGroup('lamp', { intensity: 0.5, color: [1, 0.8, 0.6] });
  return tracer.readLightGroup('lamp'); // its light in the image, RGBA
}
// #endregion lights
