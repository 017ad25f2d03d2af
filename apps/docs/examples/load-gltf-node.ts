import { loadGltfFile } from '@glanz/gltf/node';

const scene = await loadGltfFile('model.gltf');
console.log(
  `${scene.instances.length} parts, ${scene.materials.length} materials`,
);
