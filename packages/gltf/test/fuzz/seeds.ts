import { readdirSync, readFileSync, statSync } from 'node:fs';
import {
  EXTMeshGPUInstancing,
  EXTMeshoptCompression,
  KHRDracoMeshCompression,
  KHRLightsPunctual,
  KHRMaterialsClearcoat,
  KHRMaterialsVariants,
  KHRMeshQuantization,
  KHRTextureTransform,
} from '@gltf-transform/extensions';
import { WebIO, type Document } from '@gltf-transform/core';
import draco3d from 'draco3dgltf';
import { MeshoptEncoder } from 'meshoptimizer/encoder';
import { MeshoptDecoder } from 'meshoptimizer/decoder';
import { start } from '../build';
import { sharedPath } from '../shared';
import { takeApart, type Parts } from './mutate';

/** One small document with nearly everything in it. */
function everything(): Document {
  const { document, scene, accessor } = start();
  const quad = accessor('VEC3', new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0]));
  const normals = accessor('VEC3', new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1]));
  const texture = document
    .createTexture('image')
    .setMimeType('image/png')
    .setImage(new Uint8Array([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13]));
  const material = document
    .createMaterial('m')
    .setBaseColorTexture(texture)
    .setNormalTexture(texture)
    .setAlphaMode('MASK');
  material
    .getBaseColorTextureInfo()!
    .setExtension(
      'KHR_texture_transform',
      document.createExtension(KHRTextureTransform).createTransform().setScale([2, 2]),
    );
  material.setExtension(
    'KHR_materials_clearcoat',
    document.createExtension(KHRMaterialsClearcoat).createClearcoat().setClearcoatFactor(1),
  );
  const other = document.createMaterial('other').setAlphaMode('BLEND');
  const primitive = () =>
    document
      .createPrimitive()
      .setAttribute('POSITION', quad)
      .setAttribute('NORMAL', normals)
      .setAttribute(
        'TEXCOORD_0',
        accessor(
          'VEC2',
          new Float32Array(8).map((_, i) => i / 8),
        ),
      )
      .setIndices(accessor('SCALAR', new Uint16Array([0, 1, 2, 2, 1, 3])))
      .setMaterial(material);
  const variants = document.createExtension(KHRMaterialsVariants);
  const looks = [variants.createVariant('a'), variants.createVariant('b')];
  const list = variants
    .createMappingList()
    .addMapping(variants.createMapping().setMaterial(other).addVariant(looks[1]!));
  const plain = document
    .createMesh('plain')
    .addPrimitive(primitive().setExtension('KHR_materials_variants', list))
    .addPrimitive(
      document
        .createPrimitive()
        .setMode(5)
        .setAttribute('POSITION', quad)
        .setAttribute('COLOR_0', accessor('VEC4', new Uint8Array(16).fill(200), true)),
    );
  const target = document
    .createPrimitiveTarget()
    .setAttribute('POSITION', accessor('VEC3', new Float32Array(12).fill(0.5)).setSparse(true))
    .setAttribute('NORMAL', accessor('VEC3', new Float32Array(12)));
  const morphing = document.createMesh('morphing').setWeights([0.5]).addPrimitive(primitive().addTarget(target));
  const joints = [
    document.createNode('joint').setTranslation([0, 0, 1]),
    document.createNode('tip').setScale([1, 2, 1]),
  ];
  joints[0]!.addChild(joints[1]!);
  const skin = document
    .createSkin()
    .addJoint(joints[0]!)
    .addJoint(joints[1]!)
    .setInverseBindMatrices(
      accessor(
        'MAT4',
        new Float32Array(32).map((_, i) => (i % 5 === 0 && i % 16 < 16 ? 1 : 0)),
      ),
    );
  const skinned = document.createMesh('skinned').addPrimitive(
    primitive()
      .setAttribute(
        'JOINTS_0',
        accessor(
          'VEC4',
          new Uint8Array(16).map((_, i) => i % 2),
        ),
      )
      .setAttribute('WEIGHTS_0', accessor('VEC4', new Float32Array(16).fill(0.25))),
  );
  const many = document
    .createExtension(EXTMeshGPUInstancing)
    .createInstancedMesh()
    .setAttribute(
      'TRANSLATION',
      accessor(
        'VEC3',
        new Float32Array(9).map((_, i) => i),
      ),
    )
    .setAttribute('ROTATION', accessor('VEC4', new Float32Array([0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0])));
  const light = document.createExtension(KHRLightsPunctual).createLight('l').setType('spot').setOuterConeAngle(0.5);
  const root = document
    .createNode('root')
    .setRotation([0, 0, 0.6, 0.8])
    .addChild(document.createNode('a').setMesh(plain).setExtension('KHR_lights_punctual', light))
    .addChild(document.createNode('b').setMesh(morphing))
    .addChild(joints[0]!);
  scene
    .addChild(root)
    .addChild(document.createNode('c').setMesh(skinned).setSkin(skin))
    .addChild(document.createNode('d').setMesh(plain).setExtension('EXT_mesh_gpu_instancing', many))
    .addChild(
      document.createNode('e').setCamera(document.createCamera().setType('perspective').setYFov(1).setZNear(0.1)),
    );
  const times = accessor('SCALAR', new Float32Array([0, 1]));
  const samplers = [
    document
      .createAnimationSampler()
      .setInput(times)
      .setOutput(accessor('VEC4', new Float32Array([0, 0, 0, 1, 0, 1, 0, 0]))),
    document
      .createAnimationSampler()
      .setInput(times)
      .setInterpolation('CUBICSPLINE')
      .setOutput(
        accessor(
          'VEC3',
          new Float32Array(18).map((_, i) => i / 9),
        ),
      ),
    document
      .createAnimationSampler()
      .setInput(times)
      .setInterpolation('STEP')
      .setOutput(accessor('SCALAR', new Float32Array([0, 1]))),
  ] as const;
  const animation = document.createAnimation('go');
  for (const [i, path, node] of [
    [0, 'rotation', joints[1]!],
    [1, 'translation', root],
    [2, 'weights', root.listChildren()[1]!],
  ] as const)
    animation
      .addSampler(samplers[i])
      .addChannel(document.createAnimationChannel().setTargetNode(node).setTargetPath(path).setSampler(samplers[i]));
  return document;
}

/** Documents to spoil: our own, plain and compressed, and the small ones beside the repository where there are any. */
export async function seeds(): Promise<Parts[]> {
  await MeshoptEncoder.ready;
  const extensions = [
    EXTMeshGPUInstancing,
    EXTMeshoptCompression,
    KHRDracoMeshCompression,
    KHRLightsPunctual,
    KHRMaterialsClearcoat,
    KHRMaterialsVariants,
    KHRMeshQuantization,
    KHRTextureTransform,
  ];
  const io = new WebIO().registerExtensions(extensions).registerDependencies({
    'meshopt.encoder': MeshoptEncoder,
    'meshopt.decoder': MeshoptDecoder,
    'draco3d.encoder': await draco3d.createEncoderModule(),
    'draco3d.decoder': await draco3d.createDecoderModule(),
  });
  const draco = start();
  draco.document.createExtension(KHRDracoMeshCompression).setRequired(true);
  draco.scene.addChild(
    draco.document.createNode().setMesh(
      draco.document.createMesh().addPrimitive(
        draco.document
          .createPrimitive()
          .setAttribute('POSITION', draco.accessor('VEC3', new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0])))
          .setIndices(draco.accessor('SCALAR', new Uint16Array([0, 1, 2, 2, 1, 3]))),
      ),
    ),
  );
  const meshopt = everything();
  meshopt.createExtension(EXTMeshoptCompression).setRequired(true);
  const made: Uint8Array[] = [];
  for (const document of [everything(), draco.document, meshopt]) made.push(await io.writeBinary(document));
  const found: Uint8Array[] = [];
  for (const folder of [
    'bad/gen',
    'assets/Box',
    'assets/BoxAnimated',
    'assets/AnimatedMorphCube',
    'assets/BoxTextured-meshopt',
    'assets/VertexColorTest',
    'assets/InstanceTest',
    'assets/AttenuationTest',
  ]) {
    let names: string[];
    try {
      names = readdirSync(sharedPath(folder))
        .filter((name) => name.endsWith('.glb'))
        .sort();
    } catch {
      continue;
    }
    for (const name of names)
      if (statSync(sharedPath(`${folder}/${name}`)).size < 64_000)
        found.push(new Uint8Array(readFileSync(sharedPath(`${folder}/${name}`))));
  }
  const parts: Parts[] = [];
  for (const bytes of [...made, ...made, ...made, ...found]) {
    try {
      parts.push(takeApart(new Uint8Array(bytes)));
    } catch {
      // Those that are broken already are no documents to take apart.
    }
  }
  return parts;
}
