import { GlanzError } from '@glanz/scene';

/**
 * Thrown for a scene of three.js that cannot be converted or rendered. Codes: `three/not-three`, `three/no-triangles`,
 * `three/camera`, `three/size`, `three/canvas`, `three/gpu`, `three/option`, `three/destroyed`.
 */
export class ThreeError extends GlanzError {}
