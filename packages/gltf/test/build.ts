import { Document, WebIO } from '@gltf-transform/core';
import type { Extension } from '@gltf-transform/core';

/** Bytes of a GLB. Chunks are padded as the format asks. */
export function glb(json: object | string, binary?: ArrayBufferView, version = 2): Uint8Array<ArrayBuffer> {
  const text = new TextEncoder().encode(typeof json === 'string' ? json : JSON.stringify(json));
  const pad = (n: number) => Math.ceil(n / 4) * 4;
  const data = binary && new Uint8Array(binary.buffer, binary.byteOffset, binary.byteLength);
  const total = 12 + 8 + pad(text.length) + (data ? 8 + pad(data.length) : 0);
  const bytes = new Uint8Array(total);
  const view = new DataView(bytes.buffer);
  [0x46546c67, version, total, pad(text.length), 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.fill(0x20, 20, 20 + pad(text.length)).set(text, 20);
  if (data) {
    const at = 20 + pad(text.length);
    view.setUint32(at, pad(data.length), true);
    view.setUint32(at + 4, 0x004e4942, true);
    bytes.set(data, at + 8);
  }
  return bytes;
}

/** Writes a document of glTF-Transform, an implementation of the format that is not ours. */
export async function write(
  document: Document,
  extensions: (typeof Extension)[] = [],
): Promise<Uint8Array<ArrayBuffer>> {
  const bytes = await new WebIO().registerExtensions(extensions).writeBinary(document);
  return new Uint8Array(bytes);
}

/** A document with a buffer, a scene and helpers that make its accessors. */
export function start() {
  const document = new Document();
  const buffer = document.createBuffer();
  const scene = document.createScene();
  document.getRoot().setDefaultScene(scene);
  const accessor = (
    type: 'SCALAR' | 'VEC2' | 'VEC3' | 'VEC4' | 'MAT4',
    array: Parameters<ReturnType<Document['createAccessor']>['setArray']>[0],
    normalized = false,
  ) => document.createAccessor().setType(type).setArray(array).setNormalized(normalized).setBuffer(buffer);
  return { document, scene, accessor };
}

/** One triangle as JSON and bytes, for tests that spoil a document. Positions, then indices of 16 bits. */
export function triangle(): { json: TriangleJson; binary: Uint8Array<ArrayBuffer> } {
  const binary = new Uint8Array(44);
  new Float32Array(binary.buffer, 0, 9).set([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  new Uint16Array(binary.buffer, 36, 3).set([0, 1, 2]);
  const json: TriangleJson = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0, name: 'node' }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    buffers: [{ byteLength: 44 }],
    bufferViews: [
      { buffer: 0, byteLength: 36 },
      { buffer: 0, byteOffset: 36, byteLength: 6 },
    ],
    accessors: [
      { bufferView: 0, componentType: 5126, type: 'VEC3', count: 3 },
      { bufferView: 1, componentType: 5123, type: 'SCALAR', count: 3 },
    ],
  };
  return { json, binary };
}

// Tests spoil it in every way.
// eslint-disable-next-line @typescript-eslint/no-explicit-any
export type TriangleJson = Record<string, any>;

/** The triangle with its JSON changed. */
export function spoiled(change: (json: TriangleJson) => void): Uint8Array<ArrayBuffer> {
  const { json, binary } = triangle();
  change(json);
  return glb(json, binary);
}
