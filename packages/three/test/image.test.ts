import { loadGltf } from '@glanz/gltf';
import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { createPushButton } from '@glanz/models';
import { sceneToGlb } from '@glanz/models/gltf';
import { PathTracer } from '@glanz/renderer';
import type { Scene } from '@glanz/scene';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';
import { afterAll, describe, expect, it } from 'vitest';
import { fromThree, type ThreeObject } from '../src/index';

afterAll(() => expectNoGpuErrors());

const SIZE = 64;

async function render(scene: Scene): Promise<Float32Array> {
  scene.environment = { type: 'constant', radiance: [1, 1, 1] };
  const tracer = await PathTracer.create(await testDevice(), scene, {
    width: SIZE,
    height: SIZE,
    maxDepth: 4,
    camera: {
      type: 'perspective',
      name: 'c',
      transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.01, 0.12, 1],
      yfov: 0.6,
    },
  });
  for await (const progress of tracer.render({ samples: 16 })) void progress;
  const pixels = await tracer.read('beauty');
  tracer.destroy();
  return pixels;
}

describe('the push-button by way of three.js', () => {
  it('has the materials and the image that our own loader gives', async () => {
    const bytes = new Uint8Array(await sceneToGlb(createPushButton({ level: 'low' })));
    const { scene: root } = await new GLTFLoader().parseAsync(bytes.slice().buffer, '');
    // The workspace declares a little of the loader for its own ends; here it gives what three's own types say.
    const [ours, theirs] = [await loadGltf(bytes), await fromThree(root as unknown as ThreeObject)];
    expect(theirs.warnings).toEqual([]);
    const triangles = (scene: Scene) =>
      scene.instances.reduce((sum, { mesh }) => sum + scene.meshes[mesh]!.indices.length / 3, 0);
    expect(triangles(theirs)).toBe(triangles(ours));
    const byName = new Map(ours.materials.map((material) => [material.name, material.parameters]));
    for (const { name, parameters } of theirs.materials) {
      for (const [key, value] of Object.entries(parameters)) {
        const expected = byName.get(name)?.[key as keyof typeof parameters];
        // Factors that glTF leaves out are their defaults.
        if (expected !== undefined)
          expect([value].flat().map(Number), `${name} ${key}`).toEqual(
            [expected].flat().map((number) => expect.closeTo(Number(number), 5) as number),
          );
      }
    }
    const [a, b] = [await render(ours), await render(theirs)];
    let [sum, difference] = [0, 0];
    for (let i = 0; i < a.length; i++) {
      if (i % 4 === 3) continue;
      sum += a[i]!;
      difference += Math.abs(a[i]! - b[i]!);
    }
    expect(sum / (SIZE * SIZE * 3)).toBeGreaterThan(0.1);
    // The same samples through the same geometry: what is left are rounded factors and the order of the triangles.
    expect(difference / sum).toBeLessThan(0.01);
  });
});
