import { readObj, readStl } from '@glanz/formats';
import { decodeImageInBrowser, loadGltf } from '@glanz/gltf';
import { sendableScene, transferablesOf } from '@glanz/gltf/worker';
import { createCornellBox, createPushButton, createPushButtonKit } from '@glanz/models';
import type { Scene } from '@glanz/scene';
import { decoders } from './decoders';
import type { GroupedScene, LoadReply, LoadRequest } from './load-messages';

// Reading and making models takes seconds for large ones: here it does not stop the page, and can be stopped by it.

const noImage = () => Promise.resolve({ width: 1, height: 1, data: new Uint8ClampedArray(4) });

/** A scene with the groups that its file has. */
async function grouped(scene: Scene, file: Blob): Promise<GroupedScene> {
  try {
    const { groupsOf, readDocument } = await import('./part-groups');
    const nodes = (scene.animatedParts ?? []).map(([node]) => node);
    const groups = groupsOf(await readDocument(file), nodes);
    return groups.length > 0 ? { ...scene, groups } : scene;
  } catch {
    // Of a document that the loader has repaired, the parts are shown without groups.
    return scene;
  }
}

async function load(request: LoadRequest): Promise<GroupedScene> {
  if (request.kind === 'files') {
    const { files, entry } = request;
    const bytesOf = async (path: string) => {
      const file = files.get(path);
      return file && new Uint8Array(await file.arrayBuffer());
    };
    const name = entry.slice(entry.lastIndexOf('/') + 1);
    if (/\.stl$/i.test(entry)) return readStl((await bytesOf(entry)) ?? new Uint8Array(), { name });
    const folder = entry.slice(0, entry.length - name.length);
    const isUsd = /\.usd[acz]?$/i.test(entry);
    if (isUsd || /\.obj$/i.test(entry)) {
      const readModel = isUsd ? (await import('@glanz/formats/usd')).readUsd : readObj;
      return readModel((await bytesOf(entry)) ?? new Uint8Array(), {
        name,
        read: (path) => bytesOf(folder + path),
        decodeImage: request.shapesOnly ? noImage : (bytes) => decodeImageInBrowser(bytes, 'application/octet-stream'),
      });
    }
    const onProgress = ({ stage, done }: { stage: string; done: number }) => reply({ kind: 'progress', stage, done });
    const scene = await loadGltf(
      { files, entry },
      {
        decoders,
        onProgress,
        animation: request.animation,
        time: request.time,
        compressedFormats: request.compressedFormats,
        ...(request.shapesOnly ? { decodeImage: noImage } : { partNodes: true }),
      },
    );
    const file = files.get(entry);
    return request.shapesOnly || !file ? scene : grouped(scene, file);
  }
  if (request.kind === 'kit') return createPushButtonKit({ level: request.level });
  if (request.name === 'cornell-box') return createCornellBox();
  if (!request.name.startsWith('push-button')) {
    const { GALLERY_MODELS } = await import('@glanz/models/gallery');
    const create = GALLERY_MODELS[request.name];
    if (create) return create();
  }
  return createPushButton({
    level: request.name === 'push-button-high' ? 'high' : request.name === 'push-button-low' ? 'low' : 'medium',
  });
}

const reply = (message: LoadReply, transfer: Transferable[] = []) => self.postMessage(message, { transfer });

self.onmessage = async ({ data }: MessageEvent<LoadRequest>) => {
  try {
    const scene = sendableScene(await load(data));
    reply({ kind: 'scene', scene }, transferablesOf(scene));
  } catch (error) {
    const { message, code } = error as { message?: string; code?: unknown };
    reply({ kind: 'error', message: message ?? String(error), ...(typeof code === 'string' ? { code } : {}) });
  }
};
