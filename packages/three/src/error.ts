import { GlanzError } from '@glanz/scene';

/** A THREE.Scene that cannot be converted. Codes: `three/not-three`, `three/no-triangles`, `three/image`. */
export class ThreeError extends GlanzError {}
