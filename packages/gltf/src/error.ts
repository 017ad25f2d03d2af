import { GlanzError } from '@glanz/scene';

/**
 * Thrown by the loaders. Codes: `gltf/not-gltf` (neither a glTF document nor a GLB), `gltf/truncated`, `gltf/version`,
 * `gltf/malformed` (parts that contradict the specification), `gltf/missing-resource` (a file that the document names is
 * not there), `gltf/unsupported-extension` (one that the document requires), `gltf/missing-decoder` (an optional package
 * is needed), `gltf/no-triangles`.
 */
export class GltfError extends GlanzError {}
