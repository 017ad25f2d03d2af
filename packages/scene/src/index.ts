export { GlanzError, type ErrorLocation, type GlanzErrorOptions } from '@glanz/wgsl/error';
export { createScene, type Instance, type Scene, type SceneWarning } from './scene';
export type { Mesh } from './mesh';
export type { Material, TextureBinding, TextureChannels, TexturedParameter } from './material';
export type { Image, Texture, WrapMode } from './texture';
export type { DirectionalLight, Light, PointLight, SpotLight } from './light';
export type { Camera, OrthographicCamera, PerspectiveCamera } from './camera';
export type { ConstantEnvironment, Environment, LatLongEnvironment } from './environment';
