export { GlanzError, loadPart, type ErrorLocation, type GlanzErrorOptions } from '@glanz/wgsl/error';
export { createScene, type Instance, type Scene, type SceneAnimation, type SceneWarning } from './scene';
export type { Mesh, MeshPose, MeshRig, MeshSkin, MorphTarget } from './mesh';
export type { Material, TextureBinding, TextureChannels, TexturedParameter } from './material';
export {
  compressedBytes,
  type CompressedFormat,
  type CompressedImage,
  type Image,
  type Texture,
  type WrapMode,
} from './texture';
export type {
  DirectionalLight,
  DiskLight,
  Light,
  LightProfile,
  PointLight,
  ProfileLight,
  RectangleLight,
  SphereLight,
  SpotLight,
} from './light';
export type { Camera, OrthographicCamera, PanoramaCamera, PerspectiveCamera } from './camera';
export type { ConstantEnvironment, Environment, LatLongEnvironment } from './environment';
export { sceneBounds, sceneBoundsSteps, type SceneBounds } from './bounds';
export { defaultMaterial } from './default-material';
export { SceneError } from './error';
export { frameCamera, frameCameraSteps, type FrameCameraOptions } from './frame-camera';
export { yieldToEventLoop, finish, inSlices, type SliceOptions, type Steps } from './slices';
export { checkScene, checkSceneSteps } from './check-scene';
export { validateScene, validationSteps } from './validate';
export { withVariant } from './variant';
export { untilAborted } from './until-aborted';
