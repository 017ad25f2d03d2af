import * as THREE from 'three';
import type { Instance, Mesh, Scene } from '@glanz/scene';
import { describe, expect, it } from 'vitest';
import { fromThree } from '../src/index';

/** World positions of all corners of an instance, in the order of its triangles. */
function corners(scene: Scene, instance: Instance): number[][] {
  const { positions, indices } = scene.meshes[instance.mesh] as Mesh;
  const m = new THREE.Matrix4().fromArray(Array.from(instance.transform));
  return Array.from(indices, (i) =>
    new THREE.Vector3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]).applyMatrix4(m).toArray(),
  );
}

const close = (a: number[][], b: number[][]) => {
  expect(a.length).toBe(b.length);
  a.forEach((point, i) => point.forEach((value, k) => expect(value).toBeCloseTo((b[i] as number[])[k] as number, 5)));
};

/** What three itself says of a mesh's corners. */
function truth(mesh: THREE.Mesh): number[][] {
  const { index, attributes } = mesh.geometry;
  const count = index ? index.count : attributes['position']!.count;
  return Array.from({ length: count }, (_, i) =>
    mesh
      .getVertexPosition(index ? index.getX(i) : i, new THREE.Vector3())
      .applyMatrix4(mesh.matrixWorld)
      .toArray(),
  );
}

describe('meshes', () => {
  it('stand where three has them, through parents, indexed and not', async () => {
    const group = new THREE.Group();
    group.position.set(1, 2, 3);
    group.rotation.set(0.3, 0.2, 0.1);
    group.scale.set(1, -2, 0.5);
    const box = new THREE.Mesh(new THREE.BoxGeometry(1, 2, 3), new THREE.MeshStandardMaterial());
    box.position.x = 4;
    const ball = new THREE.Mesh(new THREE.SphereGeometry(1, 8, 6).toNonIndexed(), new THREE.MeshStandardMaterial());
    group.add(box, ball);
    const root = new THREE.Scene().add(group);
    const scene = await fromThree(root);
    expect(scene.instances.length).toBe(2);
    close(corners(scene, scene.instances[0]!), truth(box));
    close(corners(scene, scene.instances[1]!), truth(ball));
    expect(scene.warnings).toEqual([]);
  });

  it('share a geometry, and leave out what is invisible', async () => {
    const geometry = new THREE.BoxGeometry();
    const root = new THREE.Scene();
    const hidden = new THREE.Group();
    hidden.visible = false;
    hidden.add(new THREE.Mesh(geometry, new THREE.MeshStandardMaterial()));
    root.add(
      new THREE.Mesh(geometry, new THREE.MeshStandardMaterial()),
      new THREE.Mesh(geometry, new THREE.MeshStandardMaterial()),
      hidden,
    );
    const scene = await fromThree(root);
    expect([scene.meshes.length, scene.instances.length, scene.materials.length]).toEqual([1, 2, 2]);
    await expect(fromThree(new THREE.Scene())).rejects.toMatchObject({ code: 'three/no-triangles' });
    await expect(fromThree({} as never)).rejects.toMatchObject({ code: 'three/not-three' });
  });

  it('split by groups, each with its material and no more vertices than it needs', async () => {
    const box = new THREE.Mesh(
      new THREE.BoxGeometry(),
      Array.from({ length: 6 }, (_, i) => new THREE.MeshStandardMaterial({ name: `side ${i}` })),
    );
    const scene = await fromThree(box);
    expect(scene.instances.map(({ material }) => scene.materials[material]!.name)).toEqual([
      'side 0',
      'side 1',
      'side 2',
      'side 3',
      'side 4',
      'side 5',
    ]);
    expect(scene.meshes.map(({ positions }) => positions.length / 3)).toEqual([4, 4, 4, 4, 4, 4]);
    close(
      scene.instances.flatMap((instance) => corners(scene, instance)),
      truth(box),
    );
  });

  it('keep to the draw range, and read interleaved and normalised attributes', async () => {
    const geometry = new THREE.PlaneGeometry(2, 2);
    geometry.setDrawRange(3, 3);
    const one = await fromThree(new THREE.Mesh(geometry, new THREE.MeshStandardMaterial()));
    expect(one.meshes[0]!.indices.length).toBe(3);
    const packed = new THREE.BufferGeometry();
    const buffer = new THREE.InterleavedBuffer(Float32Array.of(0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1), 5);
    packed.setAttribute('position', new THREE.InterleavedBufferAttribute(buffer, 3, 0));
    packed.setAttribute('uv', new THREE.InterleavedBufferAttribute(buffer, 2, 3));
    packed.setAttribute('color', new THREE.BufferAttribute(Uint8Array.of(255, 0, 51, 0, 255, 0, 0, 0, 255), 3, true));
    const scene = await fromThree(new THREE.Mesh(packed, new THREE.MeshStandardMaterial({ vertexColors: true })));
    const mesh = scene.meshes[0]!;
    expect(Array.from(mesh.positions)).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
    expect(mesh.colors?.slice(0, 4)).toEqual(Float32Array.of(1, 0, 0.2, 1));
    // Without normals a mesh is flat; without vertexColors colours do not count.
    expect(mesh.normals).toBeUndefined();
    const plain = await fromThree(new THREE.Mesh(packed, new THREE.MeshStandardMaterial()));
    expect(plain.meshes[0]!.colors).toBeUndefined();
  });
});

describe('instances', () => {
  it('of an InstancedMesh stand, and are tinted, one by one', async () => {
    const mesh = new THREE.InstancedMesh(
      new THREE.BoxGeometry(),
      new THREE.MeshStandardMaterial({ color: new THREE.Color(0.5, 0.5, 0.5) }),
      3,
    );
    mesh.position.y = 5;
    for (let i = 0; i < 3; i++) {
      mesh.setMatrixAt(i, new THREE.Matrix4().makeRotationZ(i).setPosition(i, 0, 0));
      mesh.setColorAt(i, new THREE.Color(i === 2 ? 1 : 0.5, 1, 1));
    }
    const scene = await fromThree(mesh);
    expect([scene.meshes.length, scene.instances.length, scene.materials.length]).toEqual([1, 3, 2]);
    scene.instances.forEach(({ transform }, i) => {
      const own = new THREE.Matrix4();
      mesh.getMatrixAt(i, own);
      const expected = mesh.matrixWorld.clone().multiply(own).elements;
      Array.from(transform).forEach((value, k) => expect(value).toBeCloseTo(expected[k] as number, 5));
    });
    expect(scene.materials[scene.instances[0]!.material]!.parameters.base_color).toEqual([0.25, 0.5, 0.5]);
    expect(scene.materials[scene.instances[2]!.material]!.parameters.base_color).toEqual([0.5, 0.5, 0.5]);
  });

  it('of a BatchedMesh too, each with its geometry', async () => {
    const mesh = new THREE.BatchedMesh(
      4,
      200,
      400,
      new THREE.MeshStandardMaterial({ color: new THREE.Color(0.5, 0.5, 0.5) }),
    );
    const [box, ball] = [
      mesh.addGeometry(new THREE.BoxGeometry()),
      mesh.addGeometry(new THREE.SphereGeometry(1, 6, 4)),
    ];
    const ids = [mesh.addInstance(box), mesh.addInstance(ball), mesh.addInstance(box), mesh.addInstance(ball)];
    ids.forEach((id, i) => mesh.setMatrixAt(id, new THREE.Matrix4().makeTranslation(i, 0, 0)));
    mesh.setColorAt(ids[1]!, new THREE.Color(0.5, 0.25, 1));
    mesh.setVisibleAt(ids[3]!, false);
    mesh.deleteInstance(ids[2]!);
    const scene = await fromThree(mesh);
    expect(
      scene.instances.map(({ mesh: index, transform }) => [scene.meshes[index]!.indices.length, transform[12]]),
    ).toEqual([
      [36, 0],
      [new THREE.SphereGeometry(1, 6, 4).index!.count, 1],
    ]);
    // Colours multiply that of the material; an instance that was given none is white.
    expect(scene.instances.map(({ material }) => scene.materials[material]!.parameters.base_color)).toEqual([
      [0.5, 0.5, 0.5],
      [0.25, 0.125, 0.5],
    ]);
  });
});

describe('poses', () => {
  it('by morph targets, relative and not', async () => {
    for (const relative of [true, false]) {
      const geometry = new THREE.BoxGeometry();
      const target = geometry.attributes['position']!.clone();
      for (let i = 0; i < target.count; i++) target.setXYZ(i, Math.sin(i), i / 10, 0.3);
      geometry.morphAttributes['position'] = [target];
      geometry.morphTargetsRelative = relative;
      const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial());
      mesh.updateMorphTargets();
      mesh.morphTargetInfluences![0] = 0.4;
      const scene = await fromThree(mesh);
      close(corners(scene, scene.instances[0]!), truth(mesh));
    }
  });

  it('by bones', async () => {
    const geometry = new THREE.CylinderGeometry(0.3, 0.3, 4, 6, 4);
    const count = geometry.attributes['position']!.count;
    const [indices, weights] = [new Uint16Array(4 * count), new Float32Array(4 * count)];
    for (let i = 0; i < count; i++) {
      const share = (geometry.attributes['position']!.getY(i) + 2) / 4;
      indices.set([0, 1, 0, 0], 4 * i);
      weights.set([1 - share, share, 0, 0], 4 * i);
    }
    geometry.setAttribute('skinIndex', new THREE.BufferAttribute(indices, 4));
    geometry.setAttribute('skinWeight', new THREE.BufferAttribute(weights, 4));
    const [root, tip] = [new THREE.Bone(), new THREE.Bone()];
    root.position.y = -2;
    tip.position.y = 4;
    root.add(tip);
    const mesh = new THREE.SkinnedMesh(geometry, new THREE.MeshStandardMaterial());
    mesh.add(root);
    mesh.updateMatrixWorld(true);
    mesh.bind(new THREE.Skeleton([root, tip]));
    mesh.position.set(1, 0, 0);
    tip.rotation.z = 0.8;
    root.rotation.x = 0.3;
    const scene = await fromThree(mesh);
    close(corners(scene, scene.instances[0]!), truth(mesh));
    // Normals stay at right angles to the posed wall: those of a triangle's corners are near its own.
    const { positions, normals, indices: order } = scene.meshes[0]!;
    const at = (data: Float32Array, i: number) => new THREE.Vector3(data[3 * i], data[3 * i + 1], data[3 * i + 2]);
    for (let t = 0; t < order.length; t += 3) {
      const [a, b, c] = [order[t]!, order[t + 1]!, order[t + 2]!].map((i) => at(positions, i)) as [
        THREE.Vector3,
        THREE.Vector3,
        THREE.Vector3,
      ];
      const face = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
      expect(at(normals!, order[t]!).dot(face)).toBeGreaterThan(0.7);
    }
  });
});
