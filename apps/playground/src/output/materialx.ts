import { readMaterialX, writeMaterialX, type MaterialXMaterial } from '@glanz/openpbr/materialx';
import type { Scene } from '@glanz/scene';
import { readImage } from '../input/image-file';
import type { Slot, State } from '../state/state';
import { composeScene } from '../viewer/compose';

/** A material as .mtlx text. Images are named as the model names them; their files are not written. */
export function materialAsMaterialX(scene: Scene, state: State, index: number): string {
  const composed = composeScene(scene, state, undefined);
  const material = composed.materials[index];
  if (!material) return '';
  const textures = Object.fromEntries(
    Object.entries(material.textures ?? {}).flatMap(([name, binding]) => {
      const texture = composed.textures[binding.texture];
      const file = texture && (composed.images[texture.image]?.name || `texture-${binding.texture}.png`);
      return texture && file
        ? [
            [
              name,
              {
                file,
                channels: binding.channels,
                colorSpace: texture.color_space,
                ...(binding.range ? { range: binding.range } : {}),
                ...(binding.scale === undefined ? {} : { scale: binding.scale }),
              },
            ],
          ]
        : [];
    }),
  ) as MaterialXMaterial['textures'];
  return writeMaterialX([
    { name: material.name || 'material', parameters: material.parameters, ...(textures ? { textures } : {}) },
  ]).document;
}

/** A .mtlx document's first material with those of its images that lie beside it. */
export async function materialFromFiles(
  file: File,
  beside: ReadonlyMap<string, File>,
): Promise<{
  readonly name: string;
  readonly parameters: MaterialXMaterial['parameters'];
  readonly slots: Readonly<Record<string, Slot>>;
  readonly notes: readonly string[];
}> {
  const { materials, warnings } = readMaterialX(await file.text());
  const [{ name, parameters, textures = {} }] = materials as [MaterialXMaterial];
  const notes = warnings.map(({ message }) => message);
  if (materials.length > 1)
    notes.unshift(`"${file.name}" has ${materials.length} materials: the first, "${name}", was taken.`);
  const slots: Record<string, Slot> = {};
  for (const [parameter, texture] of Object.entries(textures)) {
    const image = [...beside].find(([path]) => path.split('/').at(-1) === texture.file.split('/').at(-1))?.[1];
    if (!image) {
      notes.push(`"${texture.file}" is not among the files: drop it together with "${file.name}".`);
      continue;
    }
    slots[parameter] = {
      image: await readImage(image),
      color_space: texture.colorSpace,
      binding: {
        channels: texture.channels,
        ...(texture.uv === undefined ? {} : { uv: texture.uv }),
        ...(texture.transform ? { transform: texture.transform } : {}),
        ...(texture.scale === undefined ? {} : { scale: texture.scale }),
        ...(texture.range ? { range: texture.range } : {}),
      },
    } satisfies Slot;
  }
  return { name, parameters, slots, notes };
}
