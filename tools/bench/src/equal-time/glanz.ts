import { PathTracer } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import type { Contestant, Task } from './contestant';
import { loadGltfBytes } from './load';

/** The scene of a task, with its environment. */
export async function taskScene({ glb, textures, environment }: Task): Promise<Scene> {
  const scene = await loadGltfBytes(glb, textures);
  if (environment) scene.environment = environment;
  return scene;
}

/** Glanz, as its users get it. */
export async function createGlanz(device: GPUDevice, task: Task): Promise<Contestant> {
  const scene = await taskScene(task);
  const { width, height, maxDepth, camera, multipleScattering } = task;
  const create = (seed: number) =>
    PathTracer.create(device, scene, { width, height, maxDepth, camera, multipleScattering, seed });
  let tracer = await create(0);
  return {
    unit: 'samples',
    async restart(seed) {
      tracer.destroy();
      tracer = await create(seed);
    },
    async advance(units) {
      for await (const progress of tracer.render({ samples: tracer.samples + units })) void progress;
      await device.queue.onSubmittedWorkDone();
    },
    samples: () => Promise.resolve(tracer.samples),
    async read() {
      const beauty = await tracer.read('beauty');
      const image = new Float32Array((beauty.length / 4) * 3);
      for (let i = 0; i < beauty.length / 4; i++) for (let c = 0; c < 3; c++) image[3 * i + c] = beauty[4 * i + c]!;
      return image;
    },
    destroy: () => tracer.destroy(),
  };
}
