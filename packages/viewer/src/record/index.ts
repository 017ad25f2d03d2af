export { renderFrames, type FrameOptions, type VideoImage, type VideoProgress } from './frames';
export {
  animation,
  keyframes,
  turntable,
  type AnimationOptions,
  type TurntableOptions,
  type VideoKeyframe,
  type VideoMotion,
  type VideoPath,
  type VideoStage,
} from './paths';
export type { VideoAnimations, VideoSource } from './source';
export { recordVideo, type VideoCodecName, type VideoOptions } from './record-video';
