import { expectNoGpuErrors, testDevice } from '@glanz/gpu';
import { PathTracer } from '@glanz/renderer';
import * as THREE from 'three';
import { afterAll, afterEach, beforeAll, describe, expect, it, vi } from 'vitest';
import { fromThree, ThreePathTracer } from '../src/index';

const EDITS = [
  'setCamera',
  'setMaterial',
  'setLight',
  'setEnvironment',
  'adjustEnvironment',
  'setInstanceTransforms',
  'setInstanceMaterial',
  'setVisibility',
  'replaceMesh',
] as const;

/** An environment of one colour below and another above. */
function sky(): THREE.DataTexture {
  const data = new Float32Array(4 * 4 * 2);
  for (let i = 0; i < 8; i++) data.set(i < 4 ? [0.2, 0.3, 0.1, 1] : [0.5, 0.7, 1, 1], 4 * i);
  const texture = new THREE.DataTexture(data, 4, 2, THREE.RGBAFormat, THREE.FloatType);
  texture.mapping = THREE.EquirectangularReflectionMapping;
  texture.needsUpdate = true;
  return texture;
}

function build() {
  const scene = new THREE.Scene();
  scene.environment = sky();
  const red = new THREE.MeshPhysicalMaterial({ color: 0xc03010, roughness: 0.4, clearcoat: 0.5 });
  const grey = new THREE.MeshStandardMaterial({ color: 0x808080 });
  const ball = new THREE.SphereGeometry(0.5, 12, 8);
  const balls = [-1, 0, 1].map((x) => {
    const mesh = new THREE.Mesh(ball, red);
    mesh.name = `ball ${x}`;
    mesh.position.x = x * 1.2;
    return mesh;
  });
  const floor = new THREE.Mesh(new THREE.PlaneGeometry(6, 6), grey);
  floor.name = 'floor';
  floor.rotation.x = -Math.PI / 2;
  floor.position.y = -0.5;
  const crowd = new THREE.InstancedMesh(new THREE.BoxGeometry(0.2, 0.2, 0.2), grey, 4);
  for (let i = 0; i < 4; i++) crowd.setMatrixAt(i, new THREE.Matrix4().makeTranslation(i * 0.4 - 0.6, -0.4, 0.9));
  const spot = new THREE.SpotLight(0xffffff, 30, 0, 0.5, 0.3);
  spot.position.set(0, 4, 2);
  spot.castShadow = true;
  const area = new THREE.RectAreaLight(0xffeedd, 5, 1, 1);
  area.position.set(2, 2, 0);
  area.lookAt(0, 0, 0);
  scene.add(...balls, floor, crowd, spot, spot.target, area);
  const camera = new THREE.PerspectiveCamera(40, 1);
  camera.position.set(0, 1, 5);
  camera.lookAt(0, 0, 0);
  return { scene, camera, balls, floor, crowd, spot, area, red, grey };
}

let device: GPUDevice;
beforeAll(async () => void (device = await testDevice({ driver: 'swiftshader' })));
afterAll(() => expectNoGpuErrors());
afterEach(() => void vi.restoreAllMocks());

const size = { width: 16, height: 16 } as const;

/** Calls of edits since the last time it was asked. */
function counted(tracer: PathTracer) {
  const spies = EDITS.map((name) => [name, vi.spyOn(tracer, name)] as const);
  return () => {
    const calls = Object.fromEntries(
      spies.flatMap(([name, spy]) => {
        // A list of no moves is no edit.
        const count = spy.mock.calls.filter(([what]) => !Array.isArray(what) || what.length > 0).length;
        return count > 0 ? [[name, count]] : [];
      }),
    );
    for (const [, spy] of spies) spy.mockClear();
    return calls;
  };
}

describe('ThreePathTracer', () => {
  it('makes edits for what has changed, and no others', async () => {
    const { scene, camera, balls, floor, crowd, spot, area, red, grey } = build();
    const follower = await ThreePathTracer.create(scene, camera, { device, ...size, tracer: { maxDepth: 3 } });
    const calls = counted(follower.tracer);
    const create = vi.spyOn(PathTracer, 'create');
    const changed = async () => {
      const changes = await follower.update();
      return { changes, calls: calls() };
    };

    await follower.sample({ samples: 2 });
    expect(follower.samples).toBe(2);
    expect((await changed()).calls).toEqual({});
    expect(follower.samples).toBe(2);

    camera.position.x = 0.5;
    expect(await changed()).toMatchObject({ changes: { camera: true, instances: 0 }, calls: { setCamera: 1 } });
    expect(follower.samples).toBe(0);

    balls[1]!.position.y = 0.3;
    expect((await changed()).calls).toEqual({ setInstanceTransforms: 1 });
    crowd.setMatrixAt(2, new THREE.Matrix4().makeTranslation(0.2, 0, 0.9));
    crowd.instanceMatrix.needsUpdate = true;
    expect((await changed()).calls).toEqual({ setInstanceTransforms: 1 });

    red.color.setRGB(0, 1, 0);
    red.clearcoat = 0;
    expect(await changed()).toMatchObject({ changes: { materials: 1 }, calls: { setMaterial: 1 } });
    const expected = (await fromThree(scene, camera)).materials[0]!.parameters;
    const parameters = follower.tracer.scene.materials[0]!.parameters;
    expect(parameters).toMatchObject(expected);
    expect(parameters.coat_weight).toBe(0);

    balls[0]!.material = grey as unknown as typeof red;
    expect((await changed()).calls).toEqual({ setInstanceMaterial: 1 });

    spot.intensity = 10;
    area.width = 2;
    expect(await changed()).toMatchObject({ changes: { lights: 2 }, calls: { setLight: 2 } });
    scene.remove(spot);
    expect((await changed()).calls).toEqual({ setLight: 1 });
    expect(follower.tracer.scene.lights[0]).toMatchObject({ intensity: 0 });
    scene.add(spot);
    expect((await changed()).calls).toEqual({ setLight: 1 });
    // The order is that of the objects, which has changed.
    const byType = ({ type }: { type: string }, other: { type: string }) => type.localeCompare(other.type);
    expect([...follower.tracer.scene.lights].sort(byType)).toEqual(
      (await fromThree(scene, camera)).lights.sort(byType),
    );

    scene.environmentIntensity = 0.5;
    scene.environmentRotation.y = 1;
    expect((await changed()).calls).toEqual({ adjustEnvironment: 1 });
    scene.environment = sky();
    expect((await changed()).calls).toEqual({ setEnvironment: 1 });

    balls[2]!.visible = false;
    scene.remove(balls[1]!);
    expect(await changed()).toMatchObject({ changes: { instances: 2 }, calls: { setVisibility: 1 } });
    balls[2]!.visible = true;
    scene.add(balls[1]!);
    expect((await changed()).calls).toEqual({ setVisibility: 1 });

    const { position } = floor.geometry.attributes;
    position!.setZ(0, 0.4);
    position!.needsUpdate = true;
    expect(await changed()).toMatchObject({ changes: { meshes: 1 }, calls: { replaceMesh: 1 } });

    expect(create).not.toHaveBeenCalled();
    // After all of these edits the scene is that of a conversion now.
    const fresh = await fromThree(scene, camera);
    const shown = follower.tracer.scene;
    for (const name of ['ball -1', 'ball 0', 'ball 1', 'floor']) {
      const [ours, theirs] = [shown, fresh].map(({ instances, meshes, materials }) => {
        const instance = instances.find((one) => one.name === name)!;
        return {
          transform: Array.from(instance.transform),
          positions: meshes[instance.mesh]!.positions,
          material: materials[instance.material]!.parameters.base_color,
        };
      });
      expect(ours).toEqual(theirs);
    }
    expect(shown.environment).toMatchObject({ intensity: 0.5, rotation: 1 });
    follower.destroy();
  });

  it('prepares the scene again for what is new, and shows the old one until then', async () => {
    const { scene, camera, balls } = build();
    const follower = await ThreePathTracer.create(scene, camera, { device, ...size, tracer: { maxDepth: 2 } });
    const before = follower.tracer;
    const added = new THREE.Mesh(new THREE.BoxGeometry(0.3, 0.3, 0.3), balls[0]!.material);
    scene.add(added);
    const update = follower.update();
    // A camera that moves meanwhile does not wait.
    expect(follower.tracer).toBe(before);
    camera.position.y = 2;
    expect(await follower.updateCamera()).toBe(true);
    expect((await update).rebuilt).toContain('is new');
    expect(follower.tracer).not.toBe(before);
    expect(follower.tracer.scene.instances).toHaveLength(9);
    expect(follower.tracer.camera.transform[13]).toBe(2);
    expect((await follower.update()).rebuilt).toBeUndefined();
    expect(await follower.sample()).toBe(1);
    expect(() => before.reset()).toThrow(/destroyed/);
    follower.destroy();
    follower.destroy();
    await expect(follower.update()).rejects.toMatchObject({ code: 'three/destroyed' });
  });

  it('renders the film that fromThree and PathTracer render', async () => {
    const { scene, camera } = build();
    const options = { ...size, maxDepth: 3, seed: 7, background: 'transparent' } as const;
    const follower = await ThreePathTracer.create(scene, camera, { device, ...size, tracer: { maxDepth: 3, seed: 7 } });
    // Edited and edited back.
    camera.position.x += 1;
    await follower.update();
    camera.position.x -= 1;
    await follower.update();
    await follower.sample({ samples: 4 });
    const ours = await follower.tracer.read('beauty');
    follower.destroy();
    const direct = await PathTracer.create(device, await fromThree(scene, camera), options);
    for await (const progress of direct.render({ samples: 4 })) void progress;
    expect(ours).toEqual(await direct.read('beauty'));
    expect(ours.some((value) => value > 0)).toBe(true);
    direct.destroy();
  });

  it('refuses what it cannot make', async () => {
    const { scene, camera } = build();
    await expect(ThreePathTracer.create(scene, camera, { device })).rejects.toMatchObject({ code: 'three/size' });
    await expect(
      ThreePathTracer.create(scene, new THREE.CubeCamera(1, 2, null as never) as never, { device, ...size }),
    ).rejects.toMatchObject({
      code: 'three/camera',
    });
    const signal = AbortSignal.abort(new Error('no more'));
    await expect(ThreePathTracer.create(scene, camera, { device, ...size, signal })).rejects.toThrow('no more');
    const follower = await ThreePathTracer.create(scene, camera, { device, ...size, tracer: { maxDepth: 2 } });
    expect(() => follower.render()).toThrow(/no canvas/);
    follower.destroy();
  });
});
