import { GlanzError } from '@glanz/scene';

/**
 * Thrown for a scene of three.js that cannot be converted or rendered. Codes:
 *
 * - `three/not-three`: the argument is not a `THREE.Object3D`. Pass `gltf.scene`, not `gltf`.
 * - `three/no-triangles`: the scene has no visible triangles. Add a mesh, or make one visible.
 * - `three/camera`: the camera is neither perspective nor orthographic, or has a view offset. Use one of these two
 *   kinds.
 * - `three/size`: the film has no size. Pass a canvas that has one, or `width` and `height`.
 * - `three/canvas`: the canvas has a context of another kind, or there is none. Use a canvas of its own.
 * - `three/gpu`: the film cannot be read from the GPU. Create the tracer again, with fewer pixels where memory was
 *   the cause.
 * - `three/option`: a setting is not a number in its range. Pass one in the range of the message.
 * - `three/destroyed`: the tracer was used after `destroy()`. Create another one.
 */
export class ThreeError extends GlanzError {}
