import { createScene, type Mesh, type Scene } from '@glanz/scene';
import type { PathTracerOptions } from './options';
import { loadGpuTrees } from './geometry/hierarchies';
import { buildsOnGpu } from './geometry/hierarchy';
import { PathTracer } from './path-tracer';

/** Options for {@link warmUp}: those that later tracers will be created with, as far as they are known. */
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
function smallScene(): Scene {
  const place = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  return {
    ...createScene('warm-up'),
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
 * Does work in advance that only the first scene on a page or in a process needs, for example while a model loads. It
 * prepares a small scene and renders a sample, so that the JavaScript engine has compiled the code for meshes and
 * lights, and the device the kernels that most scenes share. Then it frees everything.
 *
 * It takes as much time of the thread as it saves, in slices of a few milliseconds; with `hierarchies` it warms up the
 * workers too. Not worth it on a software adapter, whose kernels are as slow as the work that they prepare.
 *
 * @param device The one that tracers will be made on.
 * @param options `signal` ends it at once: abort it when the model is there.
 * @returns When it is done or was aborted. Never rejects: `PathTracer.create` reports what is wrong with the device.
 * @example
 * const device = await requestDevice();
 * const warm = warmUp(device, { hierarchies });
 * const scene = await loadGltf(url);
 * await warm;
 * const tracer = await PathTracer.create(device, scene, { width, height, hierarchies });
 */
export async function warmUp(device: GPUDevice, options: WarmUpOptions = {}): Promise<void> {
  // JavaScript engines discard compiled code for typed arrays when the first buffer is detached, as transfers to workers
  // and reads from the GPU do. So one is detached before anything is compiled.
  const gone = new ArrayBuffer(8);
  structuredClone(gone, { transfer: [gone] });
  try {
    // The small scene is built on the CPU; the shaders that build large meshes compile meanwhile.
    if (buildsOnGpu(device, options.bvhBuilder))
      void loadGpuTrees()
        .then(({ gpuBuilder }) => gpuBuilder(device))
        .catch(() => {});
    const tracer = await PathTracer.create(device, smallScene(), {
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
  } catch {
    // Given up, or a device that nothing can be done with.
  }
}
