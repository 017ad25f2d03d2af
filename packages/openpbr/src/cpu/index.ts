export { albedoBsdf, emittedRadiance, evalBsdf, evalPdfBsdf, pdfBsdf, sampleBsdf, type BsdfSample } from './bsdf';
export { prepareBsdf, type Bsdf, type BsdfOptions } from './prepare';
export { coatDarkening, coatedBase, coatRoughening, coatTransmittance, type Coat, type CoatFrame } from './coat';
export { anisotropicEnergy } from './anisotropic';
export { refract, refractGgx, refractHalf, type BsdfSide, type Transmission } from './transmission';
export { subsurfaceAlbedo, subsurfaceMedium, type ThinSubsurface } from './subsurface';
export { filmReflectance, metalIndex, prepareFilm, type ComplexIndex, type Film } from './film';
export { fuzzAlbedo, fuzzDensity, fuzzSample, prepareFuzz, type Fuzz } from './fuzz';
export { dispersedIor, phaseEval, phaseSample, transmissionMedium, type Medium } from './medium';
export { dielectricEpsilon, fresnelDielectric, fresnelMetal, fresnelMetalMean } from './fresnel';
export {
  ggx,
  ggxAlpha,
  ggxBound,
  ggxDistribution,
  ggxMasking,
  ggxMaskingShadowing,
  ggxSample,
  halfVector,
  conductorCosine,
  isSmooth,
  SPIKE,
  viewRoughness,
  type Slopes,
} from './ggx';
export { cosineSample, eon } from './diffuse';
export {
  energyBounce,
  energyLost,
  energyLostMean,
  conductorLoss,
  conductorLossMean,
  energyAlbedo,
  energyAlbedoMean,
  anisotropicAlbedoMean,
  energyTotalLost,
  fresnelMean,
  tableLookup,
} from './energy';
