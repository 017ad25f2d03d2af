import { EXTMeshGPUInstancing, KHRLightsPunctual } from '@gltf-transform/extensions';
import { validateScene, withVariant, type Scene } from '@glanz/scene';
import { describe, expect, test } from 'vitest';
import { loadGltf } from '../src/index';
import { spoiled, start, write } from './build';

const TRIANGLE = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]);
const HALF = Math.SQRT1_2;

function place(scene: Scene, instance: number, point: readonly [number, number, number]): number[] {
  const m = scene.instances[instance]!.transform;
  return [0, 1, 2].map((r) => m[r]! * point[0] + m[4 + r]! * point[1] + m[8 + r]! * point[2] + m[12 + r]!);
}

const near = (actual: readonly number[], expected: readonly number[]) => {
  expect(actual.length).toBe(expected.length);
  expected.forEach((x, i) => expect(actual[i]).toBeCloseTo(x, 5));
};

describe('instances', () => {
  test('transforms go down the tree; a mesh in two places is one mesh', async () => {
    const { document, scene, accessor } = start();
    const mesh = document
      .createMesh('part')
      .addPrimitive(document.createPrimitive().setAttribute('POSITION', accessor('VEC3', TRIANGLE)));
    const child = document.createNode('child').setMesh(mesh).setTranslation([1, 0, 0]).setScale([2, 2, 2]);
    // A quarter turn about +z takes +x to +y.
    const parent = document
      .createNode('parent')
      .setMesh(mesh)
      .setRotation([0, 0, HALF, HALF])
      .setTranslation([0, 0, 5])
      .addChild(child);
    scene.addChild(parent);
    const loaded = await loadGltf(await write(document));
    expect(loaded.meshes.length).toBe(1);
    expect(loaded.instances.map(({ name }) => name)).toEqual(['parent', 'child']);
    near(place(loaded, 0, [1, 0, 0]), [0, 1, 5]);
    near(place(loaded, 1, [1, 0, 0]), [0, 3, 5]);
  });

  test('the node and the primitive of each instance, where they are asked for', async () => {
    const { document, scene, accessor } = start();
    const triangle = () => document.createPrimitive().setAttribute('POSITION', accessor('VEC3', TRIANGLE));
    const child = document.createNode('child').setMesh(document.createMesh().addPrimitive(triangle()));
    const two = document
      .createMesh()
      .addPrimitive(triangle().setMaterial(document.createMaterial()))
      .addPrimitive(triangle());
    scene.addChild(document.createNode('parent').setMesh(two).addChild(child));
    const bytes = await write(document);
    const names = document
      .getRoot()
      .listNodes()
      .map((node) => node.getName());
    const { animatedParts = [] } = await loadGltf(bytes, { partNodes: true });
    expect(animatedParts.map(([node, primitive]) => [names[node], primitive])).toEqual([
      ['parent', 0],
      ['parent', 1],
      ['child', 0],
    ]);
    expect((await loadGltf(bytes)).animatedParts).toBeUndefined();
  });

  test('a mesh of two primitives gives two meshes and two instances a node', async () => {
    const { document, scene, accessor } = start();
    const mesh = document.createMesh('part');
    for (const name of ['red', 'blue'])
      mesh.addPrimitive(
        document
          .createPrimitive()
          .setAttribute('POSITION', accessor('VEC3', TRIANGLE))
          .setMaterial(document.createMaterial(name)),
      );
    scene.addChild(document.createNode('a').setMesh(mesh)).addChild(document.createNode('b').setMesh(mesh));
    const { meshes, instances, materials } = await loadGltf(await write(document));
    expect(meshes.map(({ name }) => name)).toEqual(['part 0', 'part 1']);
    expect(instances.map(({ name, mesh: m, material }) => [name, m, materials[material]!.name])).toEqual([
      ['a', 0, 'red'],
      ['a', 1, 'blue'],
      ['b', 0, 'red'],
      ['b', 1, 'blue'],
    ]);
  });

  test('EXT_mesh_gpu_instancing', async () => {
    const { document, scene, accessor } = start();
    const extension = document.createExtension(EXTMeshGPUInstancing).setRequired(true);
    const instances = extension
      .createInstancedMesh()
      .setAttribute('TRANSLATION', accessor('VEC3', new Float32Array([1, 0, 0, 0, 2, 0])))
      .setAttribute('SCALE', accessor('VEC3', new Float32Array([3, 1, 1, 1, 1, 1])));
    const mesh = document
      .createMesh()
      .addPrimitive(document.createPrimitive().setAttribute('POSITION', accessor('VEC3', TRIANGLE)));
    scene.addChild(
      document
        .createNode('many')
        .setMesh(mesh)
        .setTranslation([0, 0, 7])
        .setExtension('EXT_mesh_gpu_instancing', instances),
    );
    const loaded = await loadGltf(await write(document, [EXTMeshGPUInstancing]));
    expect([loaded.meshes.length, loaded.instances.length]).toEqual([1, 2]);
    near(place(loaded, 0, [1, 0, 0]), [4, 0, 7]);
    near(place(loaded, 1, [1, 0, 0]), [1, 2, 7]);
  });

  test('attributes of instances that place nothing count them all the same', async () => {
    const { instances, warnings } = await loadGltf(
      spoiled((json) => {
        json['extensionsUsed'] = ['EXT_mesh_gpu_instancing'];
        json['nodes'][0].extensions = { EXT_mesh_gpu_instancing: { attributes: { _ID: 1 } } };
      }),
    );
    expect([instances.length, warnings]).toEqual([3, []]);
  });

  test('a skinned mesh stands where its joints are, wherever its own node is', async () => {
    const { document, scene, accessor } = start();
    const joints = [
      document.createNode('root').setTranslation([0, 0, 3]),
      document.createNode('tip').setTranslation([0, 2, 0]).setRotation([0, 0, HALF, HALF]),
    ];
    joints[0]!.addChild(joints[1]!);
    // The tip was bound at (1, 0, 0): its inverse bind matrix takes that point to the origin.
    const bind = new Float32Array([
      1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1,
    ]);
    const skin = document
      .createSkin()
      .addJoint(joints[0]!)
      .addJoint(joints[1]!)
      .setInverseBindMatrices(accessor('MAT4', bind));
    const mesh = document.createMesh().addPrimitive(
      document
        .createPrimitive()
        .setAttribute('POSITION', accessor('VEC3', TRIANGLE))
        .setAttribute('NORMAL', accessor('VEC3', new Float32Array([1, 0, 0, 1, 0, 0, 1, 0, 0])))
        .setAttribute('JOINTS_0', accessor('VEC4', new Uint8Array([0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0])))
        .setAttribute('WEIGHTS_0', accessor('VEC4', new Float32Array([1, 0, 0, 0, 0, 1, 0, 0, 0.5, 0.5, 0, 0]))),
    );
    scene
      .addChild(joints[0]!)
      .addChild(document.createNode('body').setTranslation([100, 100, 100]).setMesh(mesh).setSkin(skin));
    const loaded = await loadGltf(await write(document));
    near(Array.from(loaded.instances[0]!.transform), [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    // Computed on paper: vertex 0 by the root; vertex 1 at the tip's origin (0, 2, 3); vertex 2 halfway between (0, 1, 3) and the
    // tip's (-1, 1, 3).
    near(Array.from(loaded.meshes[0]!.positions), [0, 0, 3, 0, 2, 3, -0.5, 1, 3]);
    near(Array.from(loaded.meshes[0]!.normals!), [1, 0, 0, 0, 1, 0, HALF, HALF, 0]);
    expect(validateScene(loaded)).toEqual([]);
  });

  test('morph targets are blended by the weights at rest', async () => {
    const { document, scene, accessor } = start();
    const target = (z: number) =>
      document
        .createPrimitiveTarget()
        .setAttribute('POSITION', accessor('VEC3', new Float32Array([0, 0, z, 0, 0, z, 0, 0, z])));
    const mesh = document
      .createMesh()
      .setWeights([0.5, 0.25])
      .addPrimitive(
        document
          .createPrimitive()
          .setAttribute('POSITION', accessor('VEC3', TRIANGLE))
          .addTarget(target(4))
          .addTarget(target(8)),
      );
    scene
      .addChild(document.createNode('a').setMesh(mesh))
      .addChild(document.createNode('b').setMesh(mesh).setWeights([1, 0]));
    const { meshes, instances } = await loadGltf(await write(document));
    expect(instances.map(({ mesh: m }) => meshes[m]!.positions[2])).toEqual([4, 4]);
    expect(meshes[0]!.positions[5]).toBe(4);
  });
});

describe('cameras', () => {
  test('perspective and orthographic, in the world', async () => {
    const { document, scene, accessor } = start();
    const mesh = document
      .createMesh()
      .addPrimitive(document.createPrimitive().setAttribute('POSITION', accessor('VEC3', TRIANGLE)));
    scene.addChild(document.createNode().setMesh(mesh));
    scene.addChild(
      document
        .createNode('eye')
        .setTranslation([0, 1, 9])
        .setCamera(document.createCamera('wide').setType('perspective').setYFov(0.7).setAspectRatio(1.5).setZNear(0.1)),
    );
    scene.addChild(
      document
        .createNode('plan')
        .setCamera(document.createCamera().setType('orthographic').setXMag(2).setYMag(3).setZNear(0).setZFar(9)),
    );
    scene.addChild(
      document
        .createNode('flat')
        .setScale([0, 1, 1])
        .setCamera(document.createCamera().setType('perspective').setYFov(0.7).setZNear(0.1)),
    );
    const loaded = await loadGltf(await write(document));
    expect(loaded.cameras).toEqual([
      {
        type: 'perspective',
        name: 'wide',
        yfov: 0.7,
        aspect: 1.5,
        transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 9, 1],
      },
      {
        type: 'orthographic',
        name: 'plan',
        xmag: 2,
        ymag: 3,
        transform: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1],
      },
    ]);
    expect(loaded.warnings.map(({ code }) => code)).toEqual(['gltf/camera']);
    expect(validateScene(loaded)).toEqual([]);
  });
});

test('cameras that cannot be rendered with are left out', async () => {
  const scene = await loadGltf(
    spoiled((json) => {
      json['cameras'] = [
        { type: 'perspective', perspective: { yfov: 1, znear: 1 } },
        { type: 'orthographic', orthographic: { xmag: 1, ymag: 1e13, znear: 0, zfar: 1 } },
      ];
      json['nodes'].push(
        { name: 'far', camera: 0, translation: [0, 0, 1e30] },
        { name: 'wide', camera: 1 },
        { name: 'good', camera: 0, translation: [0, 1e12, 0] },
      );
      json['scenes'][0].nodes = [0, 1, 2, 3];
    }),
  );
  expect(scene.cameras.map(({ name }) => name)).toEqual(['good']);
  expect(scene.warnings.map(({ message }) => message)).toEqual([
    expect.stringMatching(/"far" is more than 1000000000000 m away/),
    expect.stringMatching(/"wide" has a view of 1 and 10000000000000 m/),
  ]);
  expect(validateScene(scene)).toEqual([]);
});

test("punctual lights shine along their −z, with glTF's numbers", async () => {
  const { document, scene, accessor } = start();
  const extension = document.createExtension(KHRLightsPunctual);
  scene.addChild(
    document
      .createNode()
      .setMesh(
        document
          .createMesh()
          .addPrimitive(document.createPrimitive().setAttribute('POSITION', accessor('VEC3', TRIANGLE))),
      ),
  );
  const add = (name: string, type: 'point' | 'spot' | 'directional', intensity: number) => {
    const light = extension.createLight(name).setType(type).setIntensity(intensity).setColor([1, 0.5, 0.25]);
    if (type === 'spot') light.setInnerConeAngle(0.2).setOuterConeAngle(0.4);
    // A quarter turn about +x takes −z to +y.
    scene.addChild(
      document
        .createNode()
        .setTranslation([1, 2, 3])
        .setRotation([HALF, 0, 0, HALF])
        .setExtension('KHR_lights_punctual', light),
    );
  };
  add('bulb', 'point', 3);
  add('cone', 'spot', 4);
  add('sun', 'directional', 5);
  const { lights } = await loadGltf(await write(document, [KHRLightsPunctual]));
  expect(lights.map(({ type, name, intensity, color }) => [type, name, intensity, color])).toEqual([
    ['point', 'bulb', 3, [1, 0.5, 0.25]],
    ['spot', 'cone', 4, [1, 0.5, 0.25]],
    ['directional', 'sun', 5, [1, 0.5, 0.25]],
  ]);
  const [point, spot, sun] = lights as [
    Extract<(typeof lights)[0], { type: 'point' }>,
    Extract<(typeof lights)[0], { type: 'spot' }>,
    Extract<(typeof lights)[0], { type: 'directional' }>,
  ];
  expect(point.position).toEqual([1, 2, 3]);
  near(spot.direction, [0, 1, 0]);
  near(sun.direction, [0, 1, 0]);
  near([spot.inner_cone_angle, spot.outer_cone_angle], [0.2, 0.4]);
});

describe('which nodes are shown', () => {
  const named = (json: Record<string, unknown>, names: string[]) =>
    (json['nodes'] = names.map((name) => ({ name, mesh: 0 })));

  test('those of the default scene', async () => {
    const { instances } = await loadGltf(
      spoiled((json) => {
        named(json, ['a', 'b']);
        json['scenes'] = [{ nodes: [0] }, { nodes: [1] }];
        json['scene'] = 1;
      }),
    );
    expect(instances.map(({ name }) => name)).toEqual(['b']);
  });

  test('those of the first scene if none is the default, all without scenes', async () => {
    const first = await loadGltf(
      spoiled((json) => {
        named(json, ['a', 'b']);
        json['scenes'] = [{ nodes: [0] }, { nodes: [1] }];
        delete json['scene'];
      }),
    );
    expect(first.instances.map(({ name }) => name)).toEqual(['a']);
    const all = await loadGltf(
      spoiled((json) => {
        named(json, ['a', 'b']);
        delete json['scenes'];
        delete json['scene'];
      }),
    );
    expect(all.instances.map(({ name }) => name)).toEqual(['a', 'b']);
  });
});

test('a scene by its name or index', async () => {
  const bytes = spoiled((json) => {
    json['nodes'] = ['a', 'b'].map((name) => ({ name, mesh: 0 }));
    json['scenes'] = [{ nodes: [0] }, { name: 'second', nodes: [1] }];
  });
  const shown = async (scene: number | string) => (await loadGltf(bytes, { scene })).instances.map(({ name }) => name);
  expect(await shown('second')).toEqual(['b']);
  expect(await shown(0)).toEqual(['a']);
  await expect(shown(2)).rejects.toMatchObject({ code: 'gltf/no-such-part' });
});

test('what KHR_node_visibility hides is hidden with all below it, and its lights are out', async () => {
  const scene = await loadGltf(
    spoiled((json) => {
      json['extensionsUsed'] = ['KHR_node_visibility', 'KHR_lights_punctual'];
      json['extensions'] = { KHR_lights_punctual: { lights: [{ type: 'point' }] } };
      json['nodes'] = [
        { name: 'a', mesh: 0, children: [1], extensions: { KHR_node_visibility: { visible: false } } },
        {
          name: 'b',
          mesh: 0,
          extensions: { KHR_node_visibility: { visible: true }, KHR_lights_punctual: { light: 0 } },
        },
        { name: 'c', mesh: 0 },
      ];
      json['scenes'] = [{ nodes: [0, 2] }];
    }),
  );
  expect(scene.instances.map(({ name, visible }) => [name, visible])).toEqual([
    ['a', false],
    ['b', false],
    ['c', undefined],
  ]);
  expect(scene.lights).toEqual([]);
  expect(scene.warnings).toEqual([]);
});

test('variants: names, the materials of each, and what of them names nothing', async () => {
  const mappings = [
    { material: 1, variants: [1] },
    { material: 9, variants: [0] },
    { material: 2, variants: [0, 7] },
  ];
  const scene = await loadGltf(
    spoiled((json) => {
      json['extensionsUsed'] = ['KHR_materials_variants'];
      json['extensions'] = { KHR_materials_variants: { variants: [{ name: 'day' }, { name: 'night' }] } };
      json['materials'] = [{ name: 'x' }, { name: 'y' }, { name: 'z' }];
      Object.assign(json['meshes'][0].primitives[0], {
        material: 0,
        extensions: { KHR_materials_variants: { mappings } },
      });
    }),
  );
  expect(scene.variants).toEqual(['day', 'night']);
  expect(scene.instances.map(({ material, variants }) => [material, variants])).toEqual([[0, { 1: 1 }]]);
  expect(withVariant(scene, 'night').instances[0]!.material).toBe(1);
  expect(scene.warnings.map(({ code, path }) => [code, path])).toEqual(
    [1, 2].map((m) => ['gltf/variant', `/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/${m}`]),
  );
  expect(validateScene(scene)).toEqual([]);
});

test('what the asset says of itself, and its XMP packet', async () => {
  const scene = await loadGltf(
    spoiled((json) => {
      json['extensionsUsed'] = ['KHR_xmp_json_ld'];
      json['extensions'] = { KHR_xmp_json_ld: { packets: [{ 'dc:title': 'none' }, { 'dc:title': 'Button' }] } };
      json['asset'] = { version: '2.0', copyright: '2026 A', extensions: { KHR_xmp_json_ld: { packet: 1 } } };
    }),
  );
  expect(scene.metadata).toEqual({ copyright: '2026 A', xmp: { 'dc:title': 'Button' } });
  expect(scene.warnings).toEqual([]);
});

test('a file that asks for more than the limits allow is refused, whatever it has', async () => {
  const { document, scene, accessor } = start();
  const mesh = document
    .createMesh()
    .addPrimitive(document.createPrimitive().setAttribute('POSITION', accessor('VEC3', TRIANGLE)));
  for (let i = 0; i < 10; i++) scene.addChild(document.createNode().setMesh(mesh));
  const bytes = await write(document);
  const refused = { code: 'gltf/too-large' };
  await expect(loadGltf(bytes, { limits: { instances: 9 } })).rejects.toMatchObject(refused);
  await expect(loadGltf(bytes, { limits: { geometryBytes: 30 } })).rejects.toMatchObject(refused);
  await expect(loadGltf(bytes, { limits: { fileBytes: 30 } })).rejects.toMatchObject(refused);
  expect((await loadGltf(bytes, { limits: { instances: 10 } })).instances.length).toBe(10);
});
