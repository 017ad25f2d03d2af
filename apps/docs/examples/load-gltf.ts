import { loadGltf } from '@glanz/gltf';
import type { Scene } from '@glanz/scene';

// #region url
export async function fromUrl(
  url: string,
  signal: AbortSignal,
): Promise<Scene> {
  const scene = await loadGltf(url, { signal });
  for (const { code, message } of scene.warnings)
    console.warn(`${message} [${code}]`);
  return scene;
}
// #endregion url

// #region drop
export async function fromDrop(dropped: FileList): Promise<Scene> {
  const files = new Map(
    [...dropped].map(
      (file) => [file.webkitRelativePath || file.name, file] as const,
    ),
  );
  return loadGltf({ files });
}
// #endregion drop

// #region edit
export function withoutScrews(scene: Scene): Scene {
  return {
    ...scene,
    instances: scene.instances.filter(({ name }) => !name.startsWith('screw')),
  };
}
// #endregion edit
