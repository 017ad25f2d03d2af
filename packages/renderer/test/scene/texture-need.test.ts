import type { Camera, Scene } from '@glanz/scene';
import { inSlices } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { textureSizesOnScreen } from '../../src/scene/texture-need';
import { addQuad, addSphere, camera, createScene } from '../scenes';

const HEIGHT = 100;
const textured = (
  name: string,
  texture: number,
  transform?: readonly [number, number, number, number, number, number],
) => ({
  name,
  parameters: {},
  textures: { base_color: { texture, channels: 'rgb', ...(transform ? { transform } : {}) } as const },
});
const sizes = (scene: Scene, from: Camera = camera) => inSlices(textureSizesOnScreen(scene, from, HEIGHT));

describe('textureSizesOnScreen', () => {
  // The camera is 3 m away, and its image shows 2 m × 2 m there: 50 pixels a metre.
  it('is the size of a quad in pixels, where it faces the camera', async () => {
    const scene = createScene();
    addQuad(scene, 0.5, 0, textured('one metre', 0));
    addQuad(scene, 0.5, -3, textured('twice as far away', 1));
    addQuad(scene, 0.5, 0, textured('three times over', 2, [3, 0, 0, 3, 7, 7]));
    addQuad(scene, 0.5, 0, textured('twice as large', 3), {
      transform: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1],
    });
    const map = await sizes(scene);
    expect(map.get(0)).toBeCloseTo(50, 6);
    expect(map.get(1)).toBeCloseTo(25, 6);
    expect(map.get(2)).toBeCloseTo(50 / 3, 6);
    expect(map.get(3)).toBeCloseTo(100, 6);
  });

  it('depends on the distance in perspective alone', async () => {
    const scene = createScene();
    addQuad(scene, 0.5, -300, textured('far', 0));
    const parallel: Camera = { type: 'orthographic', name: 'o', transform: camera.transform, xmag: 1, ymag: 1 };
    expect((await sizes(scene, parallel)).get(0)).toBeCloseTo(50, 6);
    const panorama: Camera = { type: 'panorama', name: 'p', transform: camera.transform };
    expect((await sizes(scene, panorama)).get(0)).toBeCloseTo(HEIGHT / Math.PI / 303, 6);
  });

  it('is never smaller than where a large surface is close to the camera, and takes the closest of several', async () => {
    const scene = createScene();
    // A floor 1 m below the camera: its corners are 1 km away.
    addQuad(scene, 1000, 0, textured('floor', 0), { transform: [1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, -1, 3, 1] });
    addQuad(scene, 0.5, -97, textured('far', 1));
    addQuad(scene, 0.5, 0, textured('near', 1));
    const map = await sizes(scene);
    expect(map.get(0)).toBeGreaterThanOrEqual((2000 * 150) / 1.0001);
    expect(map.get(1)).toBeCloseTo(50, 6);
  });

  it('samples no more triangles where there are more instances and textures', async () => {
    const scene = createScene();
    addSphere(scene, 0.5, [0, 0, 0], textured('ball', 0), 32);
    const mesh = scene.meshes[0]!;
    let reads = 0;
    const indices = new Proxy(mesh.indices, {
      get: (target, key) => {
        reads++;
        return target[key as unknown as number];
      },
    });
    scene.meshes[0] = { ...mesh, indices, uvs: [mesh.normals!.filter((_, i) => i % 3 < 2)] };
    const binding = (texture: number) => ({ texture, channels: 'r' }) as const;
    const bindings = { specular_weight: binding(1), base_metalness: binding(2), coat_weight: binding(3) };
    scene.materials[0] = { ...textured('ball', 0), textures: { ...textured('ball', 0).textures, ...bindings } };
    const [instance] = scene.instances;
    scene.instances = Array.from({ length: 4000 }, () => instance!);
    const map = await sizes(scene);
    expect([...map.keys()].sort()).toEqual([0, 1, 2, 3]);
    expect(new Set(map.values()).size).toBe(1);
    // The corners of 2¹⁸ triangles, and the count of each instance.
    expect(reads).toBeLessThanOrEqual(3 * 2 ** 18 + 4000);
    // And enough of them.
    scene.instances = [instance!];
    const [few, many] = [map.get(0)!, (await sizes(scene)).get(0)!];
    expect(Math.abs(Math.log2(few / many))).toBeLessThan(0.5);
  });

  it('the poles of a sphere do not count, and what nothing shows is absent', async () => {
    const scene = createScene();
    addSphere(scene, 0.5, [0, 0, 0], textured('ball', 0), 64);
    const mesh = scene.meshes[0]!;
    const normals = mesh.normals!;
    const uv = new Float32Array((2 * normals.length) / 3);
    // An equal-area cylinder would have one density; a map by angles is far finer at the poles.
    for (let i = 0; i < uv.length / 2; i++) {
      const [x, y, z] = [normals[3 * i]!, normals[3 * i + 1]!, normals[3 * i + 2]!];
      uv.set([Math.atan2(z, x) / (2 * Math.PI), Math.acos(y) / Math.PI], 2 * i);
    }
    scene.meshes[0] = { ...mesh, uvs: [uv] };
    scene.materials.push(textured('unused', 1));
    const map = await sizes(scene);
    // Around the equator, π metres at 2.5 m: √(2π r · π r) × 60 pixels a metre.
    const expected = Math.sqrt(2 * Math.PI * 0.5 * Math.PI * 0.5) * 60;
    expect(map.get(0)! / expected).toBeGreaterThan(0.85);
    expect(map.get(0)! / expected).toBeLessThan(1.1);
    expect(map.has(1)).toBe(false);
  });
});
