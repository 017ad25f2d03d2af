import * as THREE from 'three';
import { describe, expect, it } from 'vitest';
import { fromThree } from '../src/index';
import { fromHalf } from '../src/half';
import { floatsOf } from '../src/textures';

/** An image whose texels say where they are. */
function image(flipY: boolean): THREE.DataTexture {
  const data = new Uint8Array(4 * 4 * 4);
  for (let y = 0; y < 4; y++) for (let x = 0; x < 4; x++) data.set([60 * x, 60 * y, 0, 255], 4 * (4 * y + x));
  const texture = new THREE.DataTexture(data, 4, 4);
  texture.flipY = flipY;
  return texture;
}

describe('textures', () => {
  it.each([
    [false, [0, 0], [1, 1], 0, [0, 0]],
    [true, [0, 0], [1, 1], 0, [0, 0]],
    [false, [0.3, 0.1], [2, -3], 0.7, [0.5, 0.5]],
    [true, [0.3, 0.1], [2, -3], 0.7, [0.5, 0.25]],
  ] as const)(
    'lie where three has them: flipY %s, offset %o, repeat %o, rotation %d, center %o',
    async (flipY, offset, repeat, rotation, center) => {
      const map = image(flipY);
      map.wrapS = map.wrapT = THREE.RepeatWrapping;
      map.offset.fromArray(offset);
      map.repeat.fromArray(repeat);
      map.rotation = rotation;
      map.center.fromArray(center);
      const geometry = new THREE.PlaneGeometry(1, 1, 3, 3);
      const scene = await fromThree(new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ map })));
      const binding = scene.materials[0]!.textures!.base_color!;
      const [a, b, c, d, x, y] = binding.transform ?? [1, 0, 0, 1, 0, 0];
      const { uvs, indices } = scene.meshes[0]!;
      const { attributes, index } = geometry;
      // Corner by corner, as vertices may have another order.
      for (let corner = 0; corner < indices.length; corner++) {
        const [u, v] = [uvs![0]![2 * indices[corner]!]!, uvs![0]![2 * indices[corner]! + 1]!];
        const i = index!.getX(corner);
        const expected = new THREE.Vector2(attributes['uv']!.getX(i), attributes['uv']!.getY(i)).applyMatrix3(
          map.matrix,
        );
        // Three's own image has its first row at v = 0, unless it is turned over.
        const row = flipY ? 1 - expected.y : expected.y;
        expect(a * u + c * v + x).toBeCloseTo(expected.x, 5);
        expect(b * u + d * v + y).toBeCloseTo(row, 5);
      }
      expect(scene.images[0]!.data).toEqual(map.image.data);
      expect(scene.textures[0]).toMatchObject({ color_space: 'srgb', wrap_u: 'repeat', wrap_v: 'repeat' });
    },
  );

  it('are each there once, whatever reads them', async () => {
    const map = image(false);
    const root = new THREE.Scene();
    root.add(
      new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial({ map })),
      new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial({ map, roughnessMap: map })),
    );
    const scene = await fromThree(root);
    expect([scene.images.length, scene.textures.length]).toEqual([1, 2]);
  });

  it('that cannot be read are left out, and reported', async () => {
    const scene = await fromThree(
      new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial({ map: new THREE.Texture() })),
    );
    expect(scene.materials[0]!.textures).toBeUndefined();
    expect(scene.warnings.map(({ code }) => code)).toEqual(['three/image']);
    const given = await fromThree(
      new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshStandardMaterial({ map: new THREE.Texture() })),
      undefined,
      { readImage: async () => ({ width: 1, height: 1, data: Uint8Array.of(1, 2, 3, 4) }) },
    );
    expect(given.images[0]!.data).toEqual(Uint8Array.of(1, 2, 3, 4));
  });

  it('reads half floats and few channels', () => {
    for (const value of [0, 1, -2, 0.5, 65504, 6.1e-5, 5.96e-8])
      expect(fromHalf(THREE.DataUtils.toHalfFloat(value))).toBe(
        THREE.DataUtils.fromHalfFloat(THREE.DataUtils.toHalfFloat(value)),
      );
    expect(Array.from(floatsOf({ data: Uint8Array.of(255, 51), width: 2, height: 1 }, THREE.UnsignedByteType))).toEqual(
      [1, 1, 1, 1, 0.2, 0.2, 0.2, 1].map(Math.fround),
    );
  });
});
