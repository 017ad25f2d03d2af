export { createRig, type RigOptions } from './rig';
export { poseMesh, type Pose } from './pose-mesh';
export { applySkin, blendTargets } from './evaluate';
export { makeUnit, unitNormals } from './normals';
