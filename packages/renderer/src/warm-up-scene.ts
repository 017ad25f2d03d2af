import type { Mesh, Scene } from '@glanz/scene';
import type { PathTracerOptions } from './options';
import type { PathTracer } from './path-tracer';

/** Options for `warmUp()`: those that later tracers will be created with, as far as they are known. */
export type WarmUpOptions = Omit<
  Partial<PathTracerOptions>,
  'width' | 'height' | 'camera' | 'pathsInFlight' | 'onProgress' | 'onFirstLight'
>;

/** Quads on a side: enough triangles for the engine to compile the loops that go over them. */
const LIT = 72;
const GLOWING = 56;

/** A wavy square of 2 × 2 m around a place on the z axis. */
function waves(quads: number, z: number): Mesh {
  const side = quads + 1;
  const positions = new Float32Array(3 * side * side);
  const normals = new Float32Array(3 * side * side);
  const indices = new Uint32Array(6 * quads * quads);
  for (let y = 0, vertex = 0; y < side; y++) {
    for (let x = 0; x < side; x++, vertex++) {
      positions.set(
        [(2 * x) / quads - 1, (2 * y) / quads - 1, z + 0.1 * Math.sin(0.7 * x) * Math.cos(0.9 * y)],
        3 * vertex,
      );
      normals[3 * vertex + 2] = 1;
    }
  }
  for (let y = 0, at = 0; y < quads; y++) {
    for (let x = 0; x < quads; x++, at += 6) {
      const a = y * side + x;
      indices.set([a, a + 1, a + side, a + 1, a + side + 1, a + side], at);
    }
  }
  return { name: 'waves', positions, normals, indices };
}

/** A small scene with what most have: surfaces, some that emit light, an environment. */
function smallScene(empty: Scene): Scene {
  const place = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  return {
    ...empty,
    meshes: [waves(LIT, -3), waves(GLOWING, -4)],
    materials: [
      { name: 'lit', parameters: { base_color: [0.5, 0.5, 0.5] } },
      { name: 'glowing', parameters: { emission_luminance: 1 } },
    ],
    instances: [
      { name: 'lit', mesh: 0, material: 0, transform: place },
      { name: 'glowing', mesh: 1, material: 1, transform: place },
    ],
    environment: { type: 'constant', radiance: [1, 1, 1] },
    cameras: [{ type: 'perspective', name: 'front', transform: place, yfov: 1 }],
  };
}

/**
 * Prepares a small scene, renders a sample of it and frees everything, see `warmUp()`. What it needs of the renderer is
 * passed, so that this file contains nothing that the caller has.
 *
 * @param empty From `createScene()`.
 */
export async function renderSample(
  tracers: typeof PathTracer,
  device: GPUDevice,
  empty: Scene,
  options: WarmUpOptions,
): Promise<void> {
  const tracer = await tracers.create(device, smallScene(empty), {
    ...options,
    width: 8,
    height: 8,
    pathsInFlight: 64,
    onFirstLight: () => {},
  });
  try {
    for await (const progress of tracer.render({ samples: 1, ...(options.signal ? { signal: options.signal } : {}) }))
      void progress;
  } finally {
    tracer.destroy();
  }
}
