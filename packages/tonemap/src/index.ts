export { TONE_MAPS, ToneMapError, isToneMap, type Rgb, type ToneMap } from './names';
export {
  checkToneMapOptions,
  toneMap,
  toneMapPixels,
  type ToneMapOptions,
  type ToneMapPixelsOptions,
} from './tone-map';
export { cameraExposure, exposureValue, type CameraExposureSettings } from './exposure';
export { toneMapOperator, type ToneMapOperator } from './operators';
export { ToneMapPass, type ToneMapPassOptions, type ToneMapPassSettings } from './pass';
export { neutralToneMap, tonemapNeutral } from './neutral';
export { acesToneMap, tonemapAces } from './aces';
export { agxToneMap, tonemapAgx } from './agx';
export { reinhardToneMap, tonemapReinhard, REINHARD_WHITE } from './reinhard';
export { linearToneMap, tonemapLinear } from './linear';
export { srgbDecode, srgbEncode, tonemapSrgb } from './srgb';
export { tonemapFinite, TONEMAP_MAX } from './finite';
