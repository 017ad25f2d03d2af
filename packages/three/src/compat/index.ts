export { WebGLPathTracer, type SetSceneOptions } from './webgl-path-tracer';
export { WebGPUPathTracer, type SampleCounts } from './webgpu-path-tracer';
export type { FilmTarget } from './film-target';
export { FullScreenQuad, type CompatRenderer } from './quad';
export { EquirectCamera, PhysicalCamera, PhysicalSpotLight, ShapedAreaLight } from './objects';
export { BlurredEnvMapGenerator, GradientEquirectTexture, ProceduralEquirectTexture } from './equirect-textures';
export { ThreeError } from '../error';
