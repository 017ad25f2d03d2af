import { GlanzError, type GlanzErrorOptions } from '@glanz/scene';

/** Text on one line, at most 500 characters: names and URLs come from the file and may contain anything. */
export const oneLine = (text: string): string => {
  const line = text.slice(0, 600).replace(/[\p{Cc}\u2028\u2029]+/gu, ' ');
  return line.length > 500 ? `${line.slice(0, 500)}…` : line;
};

/**
 * Thrown by the loaders. Codes: `gltf/not-gltf` (neither a glTF document nor a GLB), `gltf/truncated` (the file ends
 * too early), `gltf/version` (not glTF 2.0), `gltf/malformed` (parts that contradict the specification),
 * `gltf/missing-resource` (a file that the document names does not exist), `gltf/unsupported-extension` (one that the
 * document requires), `gltf/missing-decoder` (an optional package is needed), `gltf/too-large` (more than the limits
 * allow), `gltf/no-such-part` (the requested scene or animation does not exist), `gltf/no-triangles` (nothing to
 * show), `gltf/option` (an option is out of its range), `gltf/ktx2` (from a KTX2 decoder: a load continues without the
 * image), `gltf/worker` (the worker of `loadGltfInWorker` cannot be started).
 */
export class GltfError extends GlanzError {
  constructor(code: string, message: string, options: GlanzErrorOptions = {}) {
    super(code, oneLine(message), options);
  }
}
